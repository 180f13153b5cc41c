// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouettePass.h"

#include "vtkDepthStep.h"
#include "vtkSilhouetteFS.h"
#include "vtkSurfaceStepOpenGL.h"

#include "vtkObjectFactory.h"
#include "vtkShaderProgram.h"

#include <algorithm>

class vtkSilhouettePass::vtkInternals
{
public:
  vtkSurfaceStepOpenGL Find{ vtkSilhouetteFS };
};

vtkStandardNewMacro(vtkSilhouettePass);

vtkSilhouettePass::vtkSilhouettePass()
  : Internals(new vtkInternals)
{
}

vtkSilhouettePass::~vtkSilhouettePass() = default;

void vtkSilhouettePass::FindLines(
  vtkOpenGLRenderWindow* window, vtkSurfaceTarget& image, vtkSurfaceTarget& lines)
{
  const vtkDepthStep step =
    this->GetDepthStep(std::min<double>(this->Threshold, 0.5 * VTK_FLOAT_MAX));
  this->Internals->Find.Run(window, image, lines, this->GetRectangle(),
    [&step](vtkShaderProgram* program) { program->SetUniform2f("threshold", step.GetData()); });
}

void vtkSilhouettePass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  this->Internals->Find.ReleaseGraphicsResources();
}

void vtkSilhouettePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threshold: " << this->Threshold << "\n";
}
