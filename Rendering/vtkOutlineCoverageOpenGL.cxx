// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOutlineCoverageOpenGL.h"

#include "vtkOutlineCoverageFS.h"

#include "vtkShaderProgram.h"

vtkOutlineCoverageOpenGL::vtkOutlineCoverageOpenGL()
  : Step(vtkOutlineCoverageFS)
{
}

void vtkOutlineCoverageOpenGL::Run(vtkOpenGLRenderWindow* window,
  const std::array<int, 4>& rectangle, vtkSurfaceTarget& surface, vtkSurfaceTarget& result)
{
  this->Step.Run(window, surface, result, rectangle, [](vtkShaderProgram*) {});
}

void vtkOutlineCoverageOpenGL::ReleaseGraphicsResources()
{
  this->Step.ReleaseGraphicsResources();
}
