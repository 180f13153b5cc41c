// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDiscFillOptions
 * @brief   how pixels are filled that lie within the discs of the points around them
 *
 * A pixel on which no point fell, or one of a surface that another one hides, takes the values of a
 * point next to it in whose disc it lies, of the surface in front the one in whose disc it is
 * nearest to the centre; so that a lone point does not grow, it must be near the disc of a second
 * one too. Discs have RadiusShare of the points' radii, which is about the distance between points.
 *
 * A disc's projection is an ellipse: at the offset e from its centre, in eye units across the view,
 * a pixel lies in it where q = e^T V^-1 e <= 1, V being the disc's second moment as projected, plus
 * that of a low-pass filter. What lies beyond a clipping plane is not filled.
 */
#ifndef vtkDiscFillOptions_h
#define vtkDiscFillOptions_h

#include <array>

struct vtkPointSurfaceView;

struct vtkDiscFillOptions
{
  /// Of the points' radii. More fills holes better and widens outlines, less leaves outlines open.
  static constexpr float RadiusShare = 0.6f;
  /// Variance of the low-pass filter, in square pixels, for discs that are seen edge-on.
  static constexpr float LowPassVariance = 0.25f;
  /// The limit of q for the second point.
  static constexpr float NearLimit = 4.0f;
  /// Pixels that discs are looked for at most; the method is for dense clouds.
  static constexpr int LargestReach = 3;

  vtkDiscFillOptions() = default;
  /// `radius`: of the points, in pixels, where they are nearest; `layerDistance` in eye units.
  vtkDiscFillOptions(const vtkPointSurfaceView& view, double radius, double layerDistance);

  int Reach = 0; ///< pixels to each side; 0: nothing is filled
  float LayerDistance = 0.0f;
  // See vtkEyeRays.
  std::array<float, 4> EyeRay{};
  std::array<float, 4> EyeRayStep{};
  float Shear = 0.0f;
  /// In eye coordinates.
  std::array<std::array<float, 4>, 6> ClippingPlanes{};
  int NumberOfClippingPlanes = 0;
};

#endif
