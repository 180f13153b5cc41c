// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDirectParameters.h"

#include "vtkEyeRays.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace
{
/// Equations 2 and 3 of the paper.
double GetPublishedStep(const vtkPointSurfaceView& view)
{
  const auto& m = view.VCDC;
  const double nearest = m[14] / (m[10] - 1.0);
  const double farthest = m[14] / (m[10] + 1.0);
  const double distance = vtkMath::Norm(view.Center.data());
  const double lambda = farthest * nearest / (farthest - nearest) * distance + 1.0;
  return view.MeanRadius * m[5] / lambda * view.Size[0];
}

/// The sampling distance in pixels at the middle of what of the cloud is before the eye.
double GetProjectedStep(const vtkPointSurfaceView& view)
{
  const auto& m = view.VCDC;
  const double middle = 0.5 * (std::max(view.DepthRange[0], 0.0) + view.DepthRange[1]);
  const double w = m[15] - m[11] * middle;
  return w > 0.0 ? 0.5 * view.MeanRadius * view.Size[1] * std::abs(m[5]) / w : 1.0;
}

std::vector<vtkDirectParameters::Level> MakeLevels(const vtkPointSurfaceView& view, int coarsest)
{
  const auto& r = view.Rectangle;
  std::vector<vtkDirectParameters::Level> levels = { { view.Size[0], view.Size[1],
    { r[0], r[1], r[0] + r[2], r[1] + r[3] }, { 0, 0 } } };
  int right = 0; // level 0 lies below, all others in a row above it
  while (static_cast<int>(levels.size()) <= coarsest)
  {
    const auto fine = levels.back();
    const auto& f = fine.Rectangle;
    levels.push_back({ (fine.Width + 1) / 2, (fine.Height + 1) / 2,
      { f[0] / 2, f[1] / 2, (f[2] + 1) / 2, (f[3] + 1) / 2 }, { right, view.Size[1] } });
    right += levels.back().Width;
  }
  return levels;
}
}

vtkDirectParameters::vtkDirectParameters(
  const vtkPointSurfaceView& view, const vtkDirectOptions& options)
  : Options(options)
  , ImageView(view)
  , Size(view.Size)
{
  const double step = options.PublishedResolution && !view.IsParallel() ? GetPublishedStep(view)
                                                                        : GetProjectedStep(view);
  const int longest = std::max(view.Size[0], view.Size[1]);
  // no finer than the picture; at least one cell
  this->ImageStep = step > 1.0 ? std::min<double>(step, longest) : 1.0;
  const auto& r = view.Rectangle;
  this->Rectangle = { r[0], r[1], r[0] + r[2], r[1] + r[3] };
  for (int k = 0; k < 2; ++k)
  {
    const int size = std::max(1, static_cast<int>(std::lround(view.Size[k] / this->ImageStep)));
    const double scale = static_cast<double>(size) / view.Size[k];
    const int begin = static_cast<int>(std::floor(r[k] * scale));
    const int end = static_cast<int>(std::ceil((r[k] + r[2 + k]) * scale));
    this->ImageView.Size[k] = size;
    this->ImageView.Rectangle[k] = begin;
    this->ImageView.Rectangle[2 + k] = std::min(end, size) - begin;
    this->PixelToCell[k] = static_cast<float>(scale);
  }
  this->Levels = MakeLevels(this->ImageView, options.AdaptiveResolution ? MaximumLevel : 0);
  for (const Level& level : this->Levels)
  {
    this->SplatsSize[0] = std::max(this->SplatsSize[0], level.Offset[0] + level.Width);
    this->SplatsSize[1] = std::max(this->SplatsSize[1], level.Offset[1] + level.Height);
  }
  this->Gamma = static_cast<float>(options.DepthTolerance * view.Diagonal);

  const vtkEyeRays rays(this->ImageView);
  this->EyeRay = vtkEyeRays::ToFloats(rays.First);
  this->EyeRayStep = vtkEyeRays::ToFloats(rays.Step);
  this->Shear = static_cast<float>(rays.Shear);
  const auto& m = view.VCDC;
  for (int k = 0; k < 2; ++k)
  {
    this->CellToEye[k] = static_cast<float>(2.0 / (this->ImageView.Size[k] * std::abs(m[5 * k])));
  }
  this->CellToEye[2] = static_cast<float>(-m[11]);
  this->CellToEye[3] = static_cast<float>(m[15]);
}
