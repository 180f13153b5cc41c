// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointThinning.h"

#include "vtkPointSurfaceView.h"

#include <algorithm>

int vtkPointThinning::GetLevel(const vtkPointSurfaceView& view, double largestRadius)
{
  const auto& m = view.VCDC;
  const double nearestW = m[15] - m[11] * view.DepthRange[0];
  if (nearestW <= 0.0)
  {
    return 0; // some of the cloud is beside or behind the eye
  }
  const double nearest = 0.5 * view.MeanRadius * view.Size[1] * std::abs(m[5]) / nearestW;
  double radius = std::max(view.TypicalRadius, 0.5 * nearest);
  const int largest = GetLargestLevel(view.GetNumberOfPoints());
  int level = 0;
  while (level < largest && radius * std::sqrt(2.0) <= largestRadius)
  {
    radius *= std::sqrt(2.0);
    ++level;
  }
  return level;
}

int vtkPointThinning::GetLargestLevel(vtkIdType points)
{
  constexpr vtkIdType Fewest = 1000;
  int level = 0;
  while (points >> (level + 1) >= Fewest)
  {
    ++level;
  }
  return level;
}

std::vector<std::array<vtkIdType, 2>> vtkPointThinning::GetGroups(
  const std::vector<std::array<vtkIdType, 2>>& ranges, int level)
{
  const auto getFirst = [level](vtkIdType point) // whose point is not before that one
  {
    const vtkIdType group = point >> level;
    return GetPoint(static_cast<std::uint32_t>(group), level) < point ? group + 1 : group;
  };
  std::vector<std::array<vtkIdType, 2>> groups;
  for (const auto& range : ranges)
  {
    const std::array<vtkIdType, 2> own = { getFirst(range[0]), getFirst(range[1]) };
    if (own[0] < own[1])
    {
      groups.push_back(own);
    }
  }
  return groups;
}
