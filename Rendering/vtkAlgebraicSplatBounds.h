// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAlgebraicSplatBounds
 * @brief   the rectangle on the screen around the cylinder that a patch lies in
 *
 * The cylinder is around the discs at its two ends. A disc's x / w is least and largest where a
 * line of constant x / w touches it. vtkAlgebraicSplatVS.glsl does the same.
 */
#ifndef vtkAlgebraicSplatBounds_h
#define vtkAlgebraicSplatBounds_h

#include <algorithm>
#include <array>
#include <cmath>

namespace vtkAlgebraicSplatBounds
{
/**
 * Sets `bounds` to the least x and y and the largest ones in normalised device coordinates.
 * `vcdc` is the view's matrix, transposed as VTK gives it to OpenGL; the rest is in eye
 * coordinates: the disc's centre, its radius along u and v, and n, of which `heights` are to the
 * ends. Returns false where the cylinder reaches the plane of the eye, or is behind it.
 */
template <typename Matrix, typename Heights>
bool Get(const Matrix& vcdc, const std::array<double, 3>& center, const std::array<double, 3>& u,
  const std::array<double, 3>& v, const std::array<double, 3>& n, const Heights& heights,
  std::array<double, 4>& bounds)
{
  bounds = { 1e300, 1e300, -1e300, -1e300 };
  for (const double height : heights)
  {
    // row 3 of the transposed matrix is w
    auto clip = [&](const std::array<double, 3>& p, int k)
    { return vcdc[k] * p[0] + vcdc[4 + k] * p[1] + vcdc[8 + k] * p[2]; };
    const std::array<double, 3> c = { center[0] + height * n[0], center[1] + height * n[1],
      center[2] + height * n[2] };
    const double w = clip(c, 3) + vcdc[15];
    const double wu = clip(u, 3);
    const double wv = clip(v, 3);
    if (w <= 1.0001 * std::hypot(wu, wv))
    {
      return false;
    }
    const double a = w * w - wu * wu - wv * wv;
    for (int k = 0; k < 2; ++k)
    {
      const double x = clip(c, k) + vcdc[12 + k];
      const double xu = clip(u, k);
      const double xv = clip(v, k);
      const double b = x * w - xu * wu - xv * wv;
      const double root = std::sqrt(std::max(b * b - a * (x * x - xu * xu - xv * xv), 0.0));
      bounds[k] = std::min(bounds[k], (b - root) / a);
      bounds[2 + k] = std::max(bounds[2 + k], (b + root) / a);
    }
  }
  return true;
}
}

#endif
