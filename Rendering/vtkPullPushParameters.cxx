// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPullPushParameters.h"

#include "vtkEyeRays.h"
#include "vtkPointSurfaceView.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace
{
/// Pixels that are larger than this many of the largest disc's radii would be pushed nowhere, as no
/// disc reaches from one to the next; or, as unions of discs far apart, to where there is nothing.
constexpr double LargestPixel = 8.0;

/// In pixels; what is saved below it is too little to count.
constexpr double LeastSize = 16.0;

std::vector<vtkPullPushParameters::Level> MakeLevels(const vtkPointSurfaceView& view)
{
  const double largestSize =
    std::max(LargestPixel * std::max(view.LargestDisc[0], view.LargestDisc[1]), LeastSize);
  const auto& r = view.Rectangle;
  std::vector<vtkPullPushParameters::Level> levels = { { view.Size[0], view.Size[1],
    { r[0], r[1], r[0] + r[2], r[1] + r[3] } } };
  do // once at least, so that there is always a push
  {
    const auto fine = levels.back();
    const auto& f = fine.Rectangle;
    levels.push_back({ (fine.Width + 1) / 2, (fine.Height + 1) / 2,
      { f[0] / 2, f[1] / 2, (f[2] + 1) / 2, (f[3] + 1) / 2 } });
  } while (std::max(levels.back().Width, levels.back().Height) > 1 &&
    std::ldexp(1.0, static_cast<int>(levels.size()) - 1) < largestSize);
  return levels;
}
}

vtkPullPushParameters::vtkPullPushParameters(
  const vtkPointSurfaceView& view, const vtkPullPushOptions& options)
  : Options(options)
  , Levels(MakeLevels(view))
  , OutlineSlack(static_cast<float>(std::max(0.7 - 0.2 * view.TypicalRadius, 0.2)))
  , BlendsPixels(options.BlendPixels && view.TypicalRadius < 2.5)
  , DepthStep(static_cast<float>(view.MeanRadius))
  , TwoSided(view.Cull == vtkPointSurfaceView::NoCulling)
  , NumberOfClippingPlanes(view.NumberOfClippingPlanes)
{
  for (int i = 0; i < this->NumberOfClippingPlanes; ++i)
  {
    const auto& plane = view.ClippingPlanes[i];
    const double size = vtkMath::Norm(plane.data());
    for (int k = 0; k < 4; ++k)
    {
      this->ClippingPlanes[i][k] = static_cast<float>(plane[k] / size);
    }
  }
  const vtkEyeRays rays(view);
  this->EyeRay = vtkEyeRays::ToFloats(rays.First);
  this->EyeRayStep = vtkEyeRays::ToFloats(rays.Step);
  this->Shear = static_cast<float>(rays.Shear);
  const auto& m = view.VCDC;
  for (int k = 0; k < 2; ++k)
  {
    this->PixelToEye[k] = static_cast<float>(2.0 / (view.Size[k] * m[5 * k]));
  }
  this->PixelToEye[2] = static_cast<float>(-m[11]);
  this->PixelToEye[3] = static_cast<float>(m[15]);
  // The corners of a stepped outline have four: where discs are large, so have gaps between them.
  if (view.TypicalRadius < 8.0)
  {
    this->OpenRun = 4;
  }
  if (options.TrimOutlines && options.AveragePoints)
  {
    this->LargestOffset = static_cast<float>(0.5 - 0.25 * GetShareOfDense(view));
  }
  if (options.UnionRadii)
  {
    // all the way where radii are below 1.5 pixels
    this->UnionShare = static_cast<float>(std::min(std::max(2.5 - view.TypicalRadius, 0.0), 1.0));
  }
}

double vtkPullPushParameters::GetShareOfDense(const vtkPointSurfaceView& view)
{
  return std::min(std::max((1.4 - view.TypicalRadius) / 0.5, 0.0), 1.0);
}
