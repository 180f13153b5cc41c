// SPDX-License-Identifier: BSD-3-Clause
#include "vtkResolveOpenGL.h"

#include "vtkPointSurfaceView.h"
#include "vtkResolveFS.h"
#include "vtkScreenPass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <string>

vtkResolveOpenGL::vtkResolveOpenGL() = default;
vtkResolveOpenGL::~vtkResolveOpenGL() = default;

void vtkResolveOpenGL::Run(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
  vtkSurfaceTarget& samples, vtkSurfaceTarget& surface, bool lesser)
{
  std::unique_ptr<vtkScreenPass>& pass = this->Passes[{ surface.GetLayers(), view.Supersampling }];
  if (!pass)
  {
    pass.reset(new vtkScreenPass("//VTK::System::Dec\n#define SAMPLES " +
      std::to_string(view.Supersampling) + "\n" +
      vtkSurfaceTarget::GetInputDeclarations(samples.GetLayers(), "in") +
      vtkSurfaceTarget::GetOutputDeclarations(surface.GetLayers()) + vtkResolveFS));
  }
  vtkShaderProgram* program = pass->Ready(window);
  if (!program)
  {
    return;
  }
  samples.Activate();
  samples.SetSamplers(program, "in");
  const auto& r = view.Rectangle;
  const int end[2] = { r[0] + r[2], r[1] + r[3] };
  program->SetUniform2i("begin", r.data());
  program->SetUniform2i("end", end);
  program->SetUniformf("depthStep", static_cast<float>(2.0 * view.MeanRadius));
  program->SetUniformi("isLesser", lesser);
  surface.BindForWriting(window);
  const auto pixels = view.GetPixelRectangle();
  pass->Draw(window, pixels[0], pixels[1], pixels[2], pixels[3]);
  samples.Deactivate();
}

void vtkResolveOpenGL::ReleaseGraphicsResources()
{
  for (auto& entry : this->Passes)
  {
    entry.second->ReleaseGraphicsResources();
  }
}
