// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkThinnedPoints
 * @brief   what is drawn in place of groups of points, see vtkPointThinning: their means
 *
 * Points that follow each other in the order of space make a group as far as they are one surface:
 * no farther from the first one than the disc of the mean reaches, with normals like its own. Each
 * point is in one group, of the size wanted at most, so that no stretch of surface is left out; and
 * none reaches over the end of a chunk, so that what is left out by chunks is whole groups. Ids are
 * those of the first points, and so are texture coordinates: means of these may be anywhere in the
 * texture. Colours in bytes are averaged.
 */
#ifndef vtkThinnedPoints_h
#define vtkThinnedPoints_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <vector>

class vtkDataArray;
class vtkDrawablePoints;

struct vtkThinnedPoints
{
  /// How positions are stored: less an origin, times a scale.
  struct Frame
  {
    std::array<double, 3> Origin{};
    std::array<double, 3> Scale{ 1.0, 1.0, 1.0 };
  };

  /// When the arrays that they are made of were last changed, and what else they depend on: what is
  /// made of equal sources is equal.
  using Source = std::vector<double>;
  static Source GetSource(
    const vtkDrawablePoints& points, vtkDataArray* colors, const Frame& frame);

  /// Of the points, in their order of space; `colors`, nullptr for none, has a tuple for each of
  /// them: unsigned chars, or texture coordinates of any other type.
  vtkThinnedPoints(
    const vtkDrawablePoints& points, vtkDataArray* colors, const Frame& frame, int size);

  std::vector<unsigned int> Firsts; ///< places of the groups' first points in the order
  std::vector<unsigned int> Ids;
  std::vector<float> Positions;
  std::vector<float> Normals; ///< empty where the points have none
  std::vector<float> Radii;   ///< the means, not yet larger; empty where all have the same
  vtkSmartPointer<vtkDataArray> Colors; ///< unsigned chars or floats; nullptr for none

  /// The groups, from one to the one past the last, of ranges of points that end with chunks.
  static std::vector<std::array<vtkIdType, 2>> GetGroups(
    const std::vector<unsigned int>& firsts, const std::vector<std::array<vtkIdType, 2>>& ranges);
};

#endif
