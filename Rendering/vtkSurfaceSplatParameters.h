// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSplatParameters
 * @brief   what the steps of vtkSurfaceSplatMapper need to know of a frame, by both back ends
 *
 * A splat is the projection of a point's disc, an ellipse: a pixel at the offset d from its centre,
 * in pixels, lies in it where e = d^T V^-1 d < 1, V being the disc's second moment on the screen
 * plus that of a low-pass filter. The depth is linear in d, the plane's where that is not seen
 * edge-on.
 */
#ifndef vtkSurfaceSplatParameters_h
#define vtkSurfaceSplatParameters_h

#include "vtkPointSurfaceView.h"

struct vtkSurfaceSplatOptions
{
  double BlendRadius = 1.25;
  double DepthTolerance = 2.0;
  bool ThinPoints = true;
};

struct vtkSurfaceSplatParameters
{
  /// Variance of the low-pass filter, in square pixels: half of one costs 2 dB.
  static constexpr float LowPassVariance = 0.05f;
  /// Where e is below this a pixel is covered: a little inside of the disc, which reaches over the
  /// outline of what is curved.
  static constexpr float CoreLimit = 0.75f;
  /// The rest of a splat of the front, as far as it is blended, covers too where else a back would
  /// be seen, as that is a gap between discs; and where nothing would be seen, which may be one or
  /// an outline, if the cosine between normal and view is above this: outlines are not seen
  /// face-on.
  static constexpr float MarginCosine = 0.9f;
  /// Pixels' sizes that DepthTolerance is added to: the slope of what a pixel sees is unknown.
  static constexpr float TolerancePixels = 2.0f;
  /// How far discs may reach in depth in a perspective, as a share of their own: as far as their
  /// projections are nearly ellipses.
  static constexpr float LargestShareOfDepth = 0.5f;

  vtkSurfaceSplatParameters(const vtkPointSurfaceView& view, const vtkSurfaceSplatOptions& options);

  vtkPointSurfaceView View;
  vtkSurfaceSplatOptions Options;
  int Thinning = 1; ///< the points of a group, see vtkPointThinning

  /// Of a pixel, in eye units, times w.
  float GetPixelSize() const;
};

#endif
