// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceSplatParameters.h"

#include "vtkPointThinning.h"

#include <cmath>

vtkSurfaceSplatParameters::vtkSurfaceSplatParameters(
  const vtkPointSurfaceView& view, const vtkSurfaceSplatOptions& options)
  : View(view)
  , Options(options)
{
  if (options.ThinPoints)
  {
    constexpr double LargestRadius = 1.1;
    this->Thinning = vtkPointThinning::GetGroupSize(view, LargestRadius);
  }
}

float vtkSurfaceSplatParameters::GetPixelSize() const
{
  return static_cast<float>(2.0 / (this->View.Size[1] * std::abs(this->View.VCDC[5])));
}
