// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFeatureLinePass.h"

#include "vtkDepthStep.h"
#include "vtkFeatureLineFS.h"
#include "vtkSurfaceStepOpenGL.h"

#include "vtkObjectFactory.h"
#include "vtkShaderProgram.h"

#include <algorithm>

class vtkFeatureLinePass::vtkInternals
{
public:
  vtkSurfaceStepOpenGL Find{ vtkFeatureLineFS };
};

vtkStandardNewMacro(vtkFeatureLinePass);

vtkFeatureLinePass::vtkFeatureLinePass()
  : Internals(new vtkInternals)
{
}

vtkFeatureLinePass::~vtkFeatureLinePass() = default;

void vtkFeatureLinePass::FindLines(
  vtkOpenGLRenderWindow* window, vtkSurfaceTarget& image, vtkSurfaceTarget& lines)
{
  const vtkDepthStep step =
    this->GetDepthStep(std::min<double>(this->LayerDistance, VTK_FLOAT_MAX));
  this->Internals->Find.Run(window, image, lines, this->GetRectangle(),
    [&](vtkShaderProgram* program)
    {
      program->SetUniformf("threshold", static_cast<float>(this->Threshold));
      program->SetUniform2f("depthStep", step.GetData());
    });
}

void vtkFeatureLinePass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  this->Internals->Find.ReleaseGraphicsResources();
}

void vtkFeatureLinePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent << "LayerDistance: " << this->LayerDistance << "\n";
}
