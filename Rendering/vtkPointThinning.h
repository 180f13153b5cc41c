// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointThinning
 * @brief   which of 2^level points that follow each other stands for all of them
 *
 * One is chosen at random from each such group, so that no pattern in the order of the points (rows
 * of a grid, scan lines) comes through; where the order is one of space the rest is spread evenly.
 * What is chosen at a level is chosen at all levels below it, so that points only come or go while
 * a camera moves. What is drawn has to be gathered for it. An order of which the first points of
 * each chunk are such a sample would do without, but is slower: all points, whose order is no
 * longer that of space within chunks, and also some of them, as those of a chunk alone follow each
 * other; the errors are the same.
 */
#ifndef vtkPointThinning_h
#define vtkPointThinning_h

#include "vtkType.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

struct vtkPointSurfaceView;

namespace vtkPointThinning
{
/// The level at which projected radii have so many pixels at most, amid the cloud; the nearest ones
/// may have twice as many. 0 if they have more as it is, or some of the cloud is beside the eye.
int GetLevel(const vtkPointSurfaceView& view, double largestRadius);

/// The level of which so many points have 1000 groups at least, so that it does not matter if the
/// last ones are left out.
int GetLargestLevel(vtkIdType points);

/// The point that stands for the points from group << level on.
inline std::uint32_t GetPoint(std::uint32_t group, int level)
{
  for (int below = level; below > 0; --below)
  {
    const std::uint32_t mixed =
      (group ^ (group >> 15)) * 2654435761u + static_cast<std::uint32_t>(below) * 2246822519u;
    group = 2 * group + ((mixed ^ (mixed >> 16)) >> 7 & 1u);
  }
  return group;
}

/// The groups, from one to the one past the last, whose points are in ranges of points.
std::vector<std::array<vtkIdType, 2>> GetGroups(
  const std::vector<std::array<vtkIdType, 2>>& ranges, int level);

/// How many groups so many points make; of the last one the point may be beyond them.
inline vtkIdType GetNumberOfGroups(vtkIdType points, int level)
{
  return (points + (vtkIdType(1) << level) - 1) >> level;
}

/// What the radius of a point that stands for a group is larger by.
inline double GetRadiusFactor(int level)
{
  return std::sqrt(static_cast<double>(vtkIdType(1) << level));
}
}

#endif
