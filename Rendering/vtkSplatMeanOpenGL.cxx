// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSplatMeanOpenGL.h"

#include "vtkScreenPass.h"
#include "vtkSplatMeanFS.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

vtkSplatMeanOpenGL::vtkSplatMeanOpenGL() = default;
vtkSplatMeanOpenGL::~vtkSplatMeanOpenGL() = default;

void vtkSplatMeanOpenGL::ReleaseGraphicsResources()
{
  for (auto& entry : this->Passes)
  {
    entry.second->ReleaseGraphicsResources();
  }
}

void vtkSplatMeanOpenGL::Run(vtkOpenGLRenderWindow* window, const std::array<int, 4>& rectangle,
  vtkSurfaceTarget& sums, vtkSurfaceTarget& ids, vtkSurfaceTarget& surface)
{
  const bool withIds = surface.Has(vtkSurfaceTarget::Id);
  std::unique_ptr<vtkScreenPass>& pass = this->Passes[surface.GetLayers()];
  if (!pass)
  {
    pass.reset(new vtkScreenPass("//VTK::System::Dec\n" +
      vtkSurfaceTarget::GetInputDeclarations(sums.GetLayers(), "in") +
      (withIds ? vtkSurfaceTarget::GetInputDeclarations(ids.GetLayers(), "heaviest") : "") +
      vtkSurfaceTarget::GetOutputDeclarations(surface.GetLayers()) + vtkSplatMeanFS));
  }
  vtkShaderProgram* program = pass->Ready(window);
  if (!program)
  {
    return;
  }
  sums.Activate();
  sums.SetSamplers(program, "in");
  if (withIds)
  {
    ids.Activate();
    ids.SetSamplers(program, "heaviest");
  }
  surface.BindForWriting(window);
  pass->Draw(window, rectangle[0], rectangle[1], rectangle[2], rectangle[3]);
  sums.Deactivate();
  if (withIds)
  {
    ids.Deactivate();
  }
}
