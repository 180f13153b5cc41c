// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDiscFillOpenGL.h"

#include "vtkDiscFillFS.h"
#include "vtkDiscFillOptions.h"

#include "vtkShaderProgram.h"

#include <algorithm>

vtkDiscFillOpenGL::vtkDiscFillOpenGL()
  : Step(vtkDiscFillFS)
{
}

void vtkDiscFillOpenGL::Run(vtkOpenGLRenderWindow* window, const vtkDiscFillOptions& options,
  const std::array<int, 4>& rectangle, vtkSurfaceTarget& projected, vtkSurfaceTarget& surface)
{
  this->Step.Run(window, projected, surface, rectangle,
    [&options](vtkShaderProgram* program)
    {
      program->SetUniformi("reach", options.Reach);
      program->SetUniformf("layerDistance", options.LayerDistance);
      program->SetUniformf("radiusShare", vtkDiscFillOptions::RadiusShare);
      program->SetUniformf("lowPassVariance", vtkDiscFillOptions::LowPassVariance);
      program->SetUniformf("nearLimit", vtkDiscFillOptions::NearLimit);
      program->SetUniform4f("eyeRay", options.EyeRay.data());
      program->SetUniform4f("eyeRayStep", options.EyeRayStep.data());
      program->SetUniformf("shear", options.Shear);
      program->SetUniformi("numberOfClippingPlanes", options.NumberOfClippingPlanes);
      float planes[6][4];
      for (int i = 0; i < 6; ++i)
      {
        std::copy_n(options.ClippingPlanes[i].data(), 4, planes[i]);
      }
      program->SetUniform4fv("clippingPlanes", 6, planes);
    });
}

void vtkDiscFillOpenGL::ReleaseGraphicsResources()
{
  this->Step.ReleaseGraphicsResources();
}
