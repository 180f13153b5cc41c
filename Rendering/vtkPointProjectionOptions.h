// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointProjectionOptions
 * @brief   what projected points leave in a pixel
 */
#ifndef vtkPointProjectionOptions_h
#define vtkPointProjectionOptions_h

struct vtkPointProjectionOptions
{
  /// The displacement is from the pixel's centre to where the point falls, not 0.
  bool SubpixelCenters = false;
  /// Depth is the centre's depth and half of the span around it, not the least and the largest one.
  bool CenterDepths = false;
  /// The means of the points that fall in the pixel, not the nearest one alone: of those that are
  /// behind it by its radius at most, or by what its plane is within a pixel. The id stays that of
  /// the nearest one.
  bool AveragePoints = false;
  /// How far behind the nearest point averaged ones may be at most, in its radii, where its plane
  /// falls by so much within the pixel. 1: by its radius.
  float LargestReach = 1.0f;
  /// The points of a group that are drawn as one; see vtkPointThinning.
  int Thinning = 1;
  /// How far behind the nearest point the farthest one of a pixel may be, in eye units, where these
  /// are drawn.
  float DepthTolerance = 0.0f;
};

#endif
