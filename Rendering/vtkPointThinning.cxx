// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointThinning.h"

#include "vtkPointSurfaceView.h"

#include <algorithm>

namespace
{
/// The next larger of 1, 2, 3, 4, 6, 8, 12, ...
int GetNextSize(int size)
{
  const bool isPowerOfTwo = (size & (size - 1)) == 0;
  return size == 1 ? 2 : isPowerOfTwo ? size / 2 * 3 : size / 3 * 4;
}

/// The largest one that leaves enough groups, with radii that are not too large.
int GetLargestSize(vtkIdType points, vtkIdType fewest, double radius, double largestRadius)
{
  int size = 1;
  for (int next = 2;
       points / next >= fewest && radius * vtkPointThinning::GetRadiusFactor(next) <= largestRadius;
       next = GetNextSize(next))
  {
    size = next;
  }
  return size;
}
}

int vtkPointThinning::GetGroupSize(
  const vtkPointSurfaceView& view, double largestRadius, vtkIdType fewest)
{
  const auto& m = view.VCDC;
  const double nearestW = m[15] - m[11] * view.DepthRange[0];
  if (nearestW <= 0.0)
  {
    return 1; // some of the cloud is beside or behind the eye
  }
  const double nearest = 0.5 * view.MeanRadius * view.Size[1] * std::abs(m[5]) / nearestW;
  const double radius = std::max(view.TypicalRadius, 0.5 * nearest);
  return GetLargestSize(view.GetNumberOfPoints(), fewest, radius, largestRadius);
}

int vtkPointThinning::GetSizeFor(
  const vtkPointSurfaceView& own, vtkIdType points, const vtkPointSurfaceView& joint, int size)
{
  const double largestRadius = joint.TypicalRadius * GetRadiusFactor(size);
  return std::min(size, GetLargestSize(points, FewestGroups, own.TypicalRadius, largestRadius));
}
