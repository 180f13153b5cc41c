// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointThinning
 * @brief   how many points that follow each other are drawn as one, and which they are
 *
 * Where the order of points is one of space, so many make a group: 1, 2, 3, 4, 6, 8, 12, ... What
 * is drawn of them are their means, see vtkThinnedPoints. An order of which the first points of
 * each chunk are a fair sample would do without copies, but is slower: all points, whose order is
 * no longer that of space within chunks, and also some of them, as those of a chunk alone follow
 * each other; and some of the points are a poorer picture of all than their means.
 */
#ifndef vtkPointThinning_h
#define vtkPointThinning_h

#include "vtkType.h"

#include <cmath>

struct vtkPointSurfaceView;

namespace vtkPointThinning
{
/// No cloud is thinned to fewer groups.
constexpr vtkIdType FewestGroups = 1000;

/// The points of a group where projected radii of what stands for them have so many pixels at most,
/// amid the cloud; the nearest ones may have twice as many. 1 if they have more as it is, or some
/// of the cloud is beside the eye.
int GetGroupSize(
  const vtkPointSurfaceView& view, double largestRadius, vtkIdType fewest = FewestGroups);

/// For a cloud of so many points that is drawn jointly with others, which are thinned to groups of
/// a size: the same, or the largest one that leaves enough groups of it, with discs that are no
/// larger than those of all on average. Alone it is the same.
int GetSizeFor(
  const vtkPointSurfaceView& own, vtkIdType points, const vtkPointSurfaceView& joint, int size);

/// What the radius of the mean of a group is larger by: less than the root of the size, as means
/// lie more evenly than points at random do.
inline double GetRadiusFactor(int size)
{
  return 1.0 + 0.4 * (std::sqrt(static_cast<double>(size)) - 1.0);
}
}

#endif
