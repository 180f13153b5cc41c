// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageSpaceLinePass.h"

#include "vtkLineDrawingFS.h"
#include "vtkSurfaceStepOpenGL.h"

#include "vtkShaderProgram.h"

#include <utility>

class vtkImageSpaceLinePass::vtkInternals
{
public:
  vtkSurfaceTarget Lines;
  vtkSurfaceStepOpenGL Draw{ std::string("uniform sampler2D lineShape;\n") + vtkLineDrawingFS };
};

vtkImageSpaceLinePass::vtkImageSpaceLinePass()
  : Internals(new vtkInternals)
{
}

vtkImageSpaceLinePass::~vtkImageSpaceLinePass() = default;

void vtkImageSpaceLinePass::Filter(
  vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare)
{
  vtkSurfaceTarget& lines = this->Internals->Lines;
  lines.Allocate(window, image->GetWidth(), image->GetHeight(), { vtkSurfaceTarget::Shape });
  this->FindLines(window, *image, lines);
  this->Internals->Draw.Run(window, *image, *spare, this->GetRectangle(),
    [&](vtkShaderProgram* program)
    {
      lines.Activate();
      lines.SetSamplers(program, "line");
      const float color[3] = { static_cast<float>(this->Color[0]),
        static_cast<float>(this->Color[1]), static_cast<float>(this->Color[2]) };
      program->SetUniform3f("lineColor", color);
      program->SetUniformf(
        "reach", static_cast<float>(0.5 * (this->Thickness - this->GetFoundThickness())));
    });
  lines.Deactivate();
  std::swap(image, spare);
}

void vtkImageSpaceLinePass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  this->Internals->Lines.ReleaseGraphicsResources(w);
  this->Internals->Draw.ReleaseGraphicsResources();
}

void vtkImageSpaceLinePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Color: " << this->Color[0] << " " << this->Color[1] << " " << this->Color[2]
     << "\n";
  os << indent << "Thickness: " << this->Thickness << "\n";
}
