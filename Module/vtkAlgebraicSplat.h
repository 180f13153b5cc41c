// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAlgebraicSplat
 * @brief   a polynomial over a disc: one patch of a surface
 *
 * In the frame (u, v, n) at Origin, in units of Radius: the points (u, v, g(u, v)) with
 * u^2 + v^2 <= 1 (Bolla and Narayanan, section 2.2). The coefficient of u^a v^b is at
 * Index(a, b), so that those of a lower order are the first of those of a higher one.
 *
 * @sa vtkAlgebraicSplats, which has the names of the arrays that splats are stored in
 */
#ifndef vtkAlgebraicSplat_h
#define vtkAlgebraicSplat_h

#include <array>

struct vtkAlgebraicSplat
{
  static constexpr int MaximumOrder = 4;
  static constexpr int MaximumNumberOfCoefficients = 15;

  static constexpr int GetNumberOfCoefficients(int order) { return (order + 1) * (order + 2) / 2; }
  static constexpr int Index(int a, int b) { return (a + b) * (a + b + 1) / 2 + b; }

  /// g(u, v).
  template <typename Real>
  static double Evaluate(const Real* coefficients, int order, double u, double v)
  {
    double sum = 0.0;
    for (int a = order; a >= 0; --a)
    {
      double inner = 0.0;
      for (int b = order - a; b >= 0; --b)
      {
        inner = inner * v + coefficients[Index(a, b)];
      }
      sum = sum * u + inner;
    }
    return sum;
  }

  std::array<double, 3> Origin{};
  std::array<double, 3> U{};
  std::array<double, 3> V{};
  std::array<double, 3> Normal{};
  double Radius = 0.0;      ///< of the disc, in world units, as all below
  double FeatureSize = 0.0; ///< h
  double Residual = 0.0;    ///< weighted root mean square of the points' heights over the patch
  int Order = 1;
  bool RankDeficient = false; ///< the order is lower than wanted, for want of points
  bool Extrapolates = false;  ///< it is, since the points lie to one side
  std::array<double, MaximumNumberOfCoefficients> Coefficients{};
};

#endif
