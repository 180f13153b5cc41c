// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDiscFillOptions.h"

#include "vtkEyeRays.h"
#include "vtkPointSurfaceView.h"

#include <algorithm>
#include <cmath>

vtkDiscFillOptions::vtkDiscFillOptions(
  const vtkPointSurfaceView& view, double radius, double layerDistance)
  : LayerDistance(static_cast<float>(layerDistance))
  , NumberOfClippingPlanes(view.NumberOfClippingPlanes)
{
  // from a pixel's centre to the pixel of a point within the disc
  const double reach = std::hypot(RadiusShare * radius, std::sqrt(LowPassVariance)) + 0.5;
  this->Reach = std::max(static_cast<int>(std::min<double>(reach, LargestReach)), 1);
  const vtkEyeRays rays(view);
  this->EyeRay = vtkEyeRays::ToFloats(rays.First);
  this->EyeRayStep = vtkEyeRays::ToFloats(rays.Step);
  this->Shear = static_cast<float>(rays.Shear);
  for (int i = 0; i < this->NumberOfClippingPlanes; ++i)
  {
    this->ClippingPlanes[i] = vtkEyeRays::ToFloats(view.ClippingPlanes[i]);
  }
}
