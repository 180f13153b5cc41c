// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDepthAntialiasingPass.h"

#include "vtkDepthAntialiasingFS.h"
#include "vtkDepthStep.h"
#include "vtkSurfaceStepOpenGL.h"

#include "vtkObjectFactory.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <utility>

class vtkDepthAntialiasingPass::vtkInternals
{
public:
  vtkSurfaceStepOpenGL Blend{ vtkDepthAntialiasingFS };
};

vtkStandardNewMacro(vtkDepthAntialiasingPass);

vtkDepthAntialiasingPass::vtkDepthAntialiasingPass()
  : Internals(new vtkInternals)
{
}

vtkDepthAntialiasingPass::~vtkDepthAntialiasingPass() = default;

void vtkDepthAntialiasingPass::Filter(
  vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare)
{
  const vtkDepthStep step = this->GetDepthStep(std::min<double>(this->Threshold, VTK_FLOAT_MAX));
  this->Internals->Blend.Run(window, *image, *spare, this->GetRectangle(),
    [&step](vtkShaderProgram* program) { program->SetUniform2f("threshold", step.GetData()); });
  std::swap(image, spare);
}

void vtkDepthAntialiasingPass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  this->Internals->Blend.ReleaseGraphicsResources();
}

void vtkDepthAntialiasingPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threshold: " << this->Threshold << "\n";
}
