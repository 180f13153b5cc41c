// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceSplatParameters.h"

#include <algorithm>
#include <cmath>

namespace
{
/// The binary logarithm of how many of the points may be one, where they have `radius` pixels.
int GetThinning(double radius, vtkIdType points)
{
  constexpr vtkIdType Fewest = 1000; // so that it does not matter if the last ones are left out
  int thinning = 0;
  while (radius * std::sqrt(2.0) <= vtkSurfaceSplatParameters::ThinnedRadius &&
    points >> (thinning + 1) >= Fewest)
  {
    radius *= std::sqrt(2.0);
    ++thinning;
  }
  return thinning;
}
}

vtkSurfaceSplatParameters::vtkSurfaceSplatParameters(
  const vtkPointSurfaceView& view, const vtkSurfaceSplatOptions& options)
  : View(view)
  , Options(options)
{
  const auto& m = view.VCDC;
  const double nearestW = m[15] - m[11] * view.DepthRange[0];
  const bool allInFront = nearestW > 0.0;
  if (options.ThinPoints && allInFront)
  {
    const double nearest = 0.5 * view.MeanRadius * view.Size[1] * std::abs(m[5]) / nearestW;
    this->Thinning =
      GetThinning(std::max(view.TypicalRadius, 0.5 * nearest), view.GetNumberOfPoints());
  }
}

float vtkSurfaceSplatParameters::GetPixelSize() const
{
  return static_cast<float>(2.0 / (this->View.Size[1] * std::abs(this->View.VCDC[5])));
}
