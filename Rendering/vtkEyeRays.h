// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEyeRays
 * @brief   the rays through the pixels of a view, in eye coordinates
 *
 * Linear functions of the place in pixels: eye xy = origin + depth * direction. In a picture that a
 * camera's transform shears, x is less than that by Shear times y.
 */
#ifndef vtkEyeRays_h
#define vtkEyeRays_h

#include "vtkPointSurfaceView.h"

#include <algorithm>
#include <array>

struct vtkEyeRays
{
  std::array<double, 4> First{}; ///< xy: direction through the place (0, 0); zw: origin
  std::array<double, 4> Step{};  ///< change of these a pixel
  double Shear = 0.0;

  explicit vtkEyeRays(const vtkPointSurfaceView& view)
  {
    const auto& m = view.VCDC;
    for (int k = 0; k < 2; ++k)
    {
      const double scale = m[5 * k];
      const double size = view.Size[k];
      this->First[k] = (m[11] + m[8 + k]) / scale;
      this->First[2 + k] = (-m[15] - m[12 + k]) / scale;
      this->Step[k] = -2.0 * m[11] / (size * scale);
      this->Step[2 + k] = 2.0 * m[15] / (size * scale);
    }
    this->Shear = m[4] / m[0];
  }

  static std::array<float, 4> ToFloats(const std::array<double, 4>& values)
  {
    std::array<float, 4> floats;
    std::transform(values.begin(), values.end(), floats.begin(),
      [](double value) { return static_cast<float>(value); });
    return floats;
  }
};

#endif
