// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAlgebraicSplatTransform
 * @brief   the view as rays that meet splats want it
 *
 * What limits a ray, the clipping range and clipping planes, are planes in eye coordinates.
 */
#ifndef vtkAlgebraicSplatTransform_h
#define vtkAlgebraicSplatTransform_h

#include "vtkEyeRays.h"
#include "vtkPointSurfaceView.h"

#include <array>
#include <vector>

struct vtkAlgebraicSplatTransform
{
  vtkEyeRays Rays;
  std::vector<std::array<double, 4>> Planes;
  std::array<double, 9> ToEye{};  ///< from model to eye vectors: row i is the image of axis i
  std::array<double, 3> Origin{}; ///< the splats' origin in eye coordinates

  vtkAlgebraicSplatTransform(const vtkPointSurfaceView& view, const std::array<double, 3>& origin)
    : Rays(view)
  {
    const auto& m = view.VCDC;
    for (int side : { 1, -1 })
    {
      std::array<double, 4> plane;
      for (int row = 0; row < 4; ++row)
      {
        plane[row] = m[4 * row + 3] + side * m[4 * row + 2];
      }
      this->Planes.push_back(plane);
    }
    this->Planes.insert(this->Planes.end(), view.ClippingPlanes.begin(),
      view.ClippingPlanes.begin() + view.NumberOfClippingPlanes);
    for (int i = 0; i < 3; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->ToEye[3 * i + k] = view.MCVC[4 * i + k];
      }
    }
    for (int k = 0; k < 3; ++k)
    {
      this->Origin[k] = origin[0] * view.MCVC[k] + origin[1] * view.MCVC[4 + k] +
        origin[2] * view.MCVC[8 + k] + view.MCVC[12 + k];
    }
  }
};

#endif
