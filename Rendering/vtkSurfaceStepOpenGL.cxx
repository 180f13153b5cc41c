// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceStepOpenGL.h"

#include "vtkScreenPass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

vtkSurfaceStepOpenGL::vtkSurfaceStepOpenGL(const std::string& fragmentShader)
  : FragmentShader(fragmentShader)
{
}

vtkSurfaceStepOpenGL::~vtkSurfaceStepOpenGL() = default;

void vtkSurfaceStepOpenGL::Run(vtkOpenGLRenderWindow* window, vtkSurfaceTarget& input,
  vtkSurfaceTarget& output, const std::array<int, 4>& rectangle,
  const std::function<void(vtkShaderProgram*)>& setUniforms)
{
  std::unique_ptr<vtkScreenPass>& pass = this->Passes[{ input.GetLayers(), output.GetLayers() }];
  if (!pass)
  {
    pass.reset(new vtkScreenPass("//VTK::System::Dec\n" +
      vtkSurfaceTarget::GetInputDeclarations(input.GetLayers(), "in") +
      vtkSurfaceTarget::GetOutputDeclarations(output.GetLayers()) + this->FragmentShader));
  }
  vtkShaderProgram* program = pass->Ready(window);
  if (!program)
  {
    return;
  }
  input.Activate();
  input.SetSamplers(program, "in");
  program->SetUniform2i("begin", rectangle.data());
  program->SetUniform2i("end", rectangle.data() + 2);
  setUniforms(program);
  output.BindForWriting(window);
  pass->Draw(
    window, rectangle[0], rectangle[1], rectangle[2] - rectangle[0], rectangle[3] - rectangle[1]);
  input.Deactivate();
}

void vtkSurfaceStepOpenGL::ReleaseGraphicsResources()
{
  for (auto& entry : this->Passes)
  {
    entry.second->ReleaseGraphicsResources();
  }
}
