// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMovingLeastSquares
 * @brief   fits a polynomial over a local plane to the neighbours of a point
 *
 * Bolla and Narayanan, section 2.1, with the weights exp(-d^2 / h^2). First the plane: its normal
 * and offset minimise the weighted squares of the distances of the neighbours, the weights being
 * taken about the point's projection onto the plane itself; so plane and weights are found in turn
 * until they stay. Then the polynomial: least squares of the neighbours' heights over the plane,
 * with weights about the point, by QR with column pivoting of centred and scaled columns. Where
 * the neighbours do not determine all coefficients the order is lowered.
 *
 * Not wrapped, not installed: it serves vtkAlgebraicSplats.
 */
#ifndef vtkMovingLeastSquares_h
#define vtkMovingLeastSquares_h

#include "vtkAlgebraicSplat.h"

#include <array>
#include <vector>

class vtkMovingLeastSquares
{
public:
  using Vector = std::array<double, 3>;

  int Order = 3;                   ///< highest order of the polynomial, 1 to 4
  double Tolerance = 0.0;          ///< over 0: the lowest order whose residual is not above it
  double ExtrapolationLimit = 0.0; ///< see vtkAlgebraicSplats; 0: none
  double LimitedShare = 1.0;       ///< of the disc's radius, up to which that limit holds
  double Rounding = 0.0;           ///< of the neighbours' coordinates, which determines nothing

  /**
   * What is fitted, relative to the point; the neighbours of one point.
   */
  std::vector<Vector> Neighbors;

  /**
   * Fits a patch to the neighbours of the point `center`. `featureSize` is h; 0 takes the mean
   * distance of the neighbours within the plane. The normal is on the side of `hint` (zero: any).
   * The patch's Radius, the unit of its coefficients, is `radiusFactor` times h.
   */
  vtkAlgebraicSplat Fit(
    const Vector& center, const Vector& hint, double featureSize, double radiusFactor);

private:
  void FitPlane(const Vector& hint, double featureSize, vtkAlgebraicSplat& splat);
  void FitPolynomial(vtkAlgebraicSplat& splat) const;
  double GetMeanDistanceInPlane(const Vector& normal) const;

  double Offset = 0.0; // of the plane from the point along the normal
};

#endif
