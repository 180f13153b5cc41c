// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceSmoothingOpenGL.h"

#include "vtkSurfaceSmoothingFS.h"
#include "vtkSurfaceSmoothingOptions.h"

#include "vtkShaderProgram.h"

vtkSurfaceSmoothingOpenGL::vtkSurfaceSmoothingOpenGL()
  : Step(vtkSurfaceSmoothingFS)
{
}

void vtkSurfaceSmoothingOpenGL::Run(vtkOpenGLRenderWindow* window,
  const vtkSurfaceSmoothingOptions& options, const std::array<int, 4>& rectangle,
  vtkSurfaceTarget& surface, vtkSurfaceTarget& smoothed)
{
  this->Step.Run(window, surface, smoothed, rectangle,
    [&options](vtkShaderProgram* program)
    {
      const float weights[3] = { options.Center, options.Side, options.Corner };
      program->SetUniform3f("weights", weights);
      program->SetUniform2f("depthStep", options.DepthStep.GetData());
      program->SetUniformi("twoSided", options.TwoSided);
    });
}

void vtkSurfaceSmoothingOpenGL::ReleaseGraphicsResources()
{
  this->Step.ReleaseGraphicsResources();
}
