// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointProjectionOptions
 * @brief   what a projected point leaves in its pixel's layer Interval
 */
#ifndef vtkPointProjectionOptions_h
#define vtkPointProjectionOptions_h

struct vtkPointProjectionOptions
{
  /// The displacement is from the pixel's centre to where the point falls, not 0.
  bool SubpixelCenters = false;
  /// Depth is the centre's depth and half of the span around it, not the least and the largest one.
  bool CenterDepths = false;
  /// How far behind the nearest point the farthest one of a pixel may be, in eye units, where these
  /// are drawn.
  float DepthTolerance = 0.0f;
};

#endif
