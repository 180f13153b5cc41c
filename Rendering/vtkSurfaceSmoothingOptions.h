// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSmoothingOptions
 * @brief   how a surface buffer is smoothed
 */
#ifndef vtkSurfaceSmoothingOptions_h
#define vtkSurfaceSmoothingOptions_h

#include "vtkDepthStep.h"

struct vtkSurfaceSmoothingOptions
{
  /// Weights of the pixel itself and of its neighbours along a side and over a corner.
  float Center = 16.0f;
  float Side = 2.0f;
  float Corner = 1.0f;
  /// Neighbours that are farther off in depth are not of this surface.
  vtkDepthStep DepthStep = { 0.0f, 3.4e38f };
  bool TwoSided = false; ///< normals may point to either side

  /// With the weights of a kernel of table 1: box, Gaussian, alleviated Gaussian.
  static vtkSurfaceSmoothingOptions FromKernel(int kernel)
  {
    const float weights[3][3] = { { 1.0f, 1.0f, 1.0f }, { 4.0f, 2.0f, 1.0f },
      { 16.0f, 2.0f, 1.0f } };
    vtkSurfaceSmoothingOptions options;
    options.Center = weights[kernel][0];
    options.Side = weights[kernel][1];
    options.Corner = weights[kernel][2];
    return options;
  }
};

#endif
