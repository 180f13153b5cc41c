// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAlgebraicSplats
 * @brief   represents a point cloud by few polynomial patches, fitted by moving least squares
 *
 * After: N. K. Bolla, P. J. Narayanan, Algebraic Splats Representation for Point Based Models. A
 * splat is a polynomial of order 1 to 4 over a disc of the local plane. Its coefficients are fitted
 * to the nearest points; which points get a splat is told by Selection.
 *
 * The first output is the set of splats, a vtkPolyData that vtkAlgebraicSplatMapper draws, and that
 * can be saved as any other. Its points are the centres of the discs, without cells; its point data
 * are the input's, of the point that a splat was made for (the nearest one with FIXED_COUNT), and:
 *   - `Normals` (float, 3 components, unit, the active normals): n, on the side of the input's;
 *   - `SplatAxes` (float, 3 components, unit): u, across n; the third axis v is n x u;
 *   - `radius` (float): the radius R of the disc in world units;
 *   - `SplatCoefficients` (float, 3, 6, 10 or 15 components, for the highest order in the set): of
 *     the terms 1, u, v, u^2, uv, v^2, u^3, ... in units of R, so that the surface is n = g(u, v)
 *     where u^2 + v^2 <= 1; 0 beyond the splat's order;
 *   - `SplatOrder` (unsigned char): 1 to 4;
 *   - `FeatureSize` (float): h, the mean distance of the neighbours within the plane;
 *   - `Residual` (float): the root of the weighted mean square of the neighbours' distances from
 *     the patch along n, in world units;
 *   - `InputPointIds` (vtkIdType): the point of the input that the splat was made for.
 *
 * The second output has the points and the point data of the input; with ComputeErrors also the
 * array `ApproximationError` (float), the paper's equation 3: the sum, over the splats whose disc a
 * point is in, of its distance from the patch along n times exp(-d^2 / h^2), d being its distance
 * from the splat's centre.
 *
 * Normals of the input tell the two sides of thin parts apart (see RejectOppositeNormals); where
 * there are none they are estimated (vtkPointNormals). Points at the same position count once.
 * Points that are not finite are left out, with a warning. Where the neighbours do not determine a
 * polynomial of the order wanted, a lower one is taken, with one warning that tells how often. What
 * they differ by in the rounding of their coordinates, or by a millionth of the disc's radius,
 * determines nothing: the disc of points on a line lies in some plane through it.
 *
 * The filter is threaded by vtkSMPTools; its output is the same for any backend and number of
 * threads. It reports progress and can be aborted; the output then has no points.
 *
 * @sa
 * vtkAlgebraicSplatMapper vtkLocallyOptimalProjection vtkPointNormals
 */

#ifndef vtkAlgebraicSplats_h
#define vtkAlgebraicSplats_h

#include "vtkPointSurfaceModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKPOINTSURFACE_EXPORT vtkAlgebraicSplats : public vtkPolyDataAlgorithm
{
public:
  static vtkAlgebraicSplats* New();
  vtkTypeMacro(vtkAlgebraicSplats, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The order m of the polynomials, 1 to 4: 3, 6, 10 or 15 coefficients. With Tolerance, the
   * highest order. Default: 3.
   */
  vtkSetClampMacro(Order, int, 1, 4);
  vtkGetMacro(Order, int);
  ///@}

  ///@{
  /**
   * If over 0, each splat has the lowest order whose `Residual` is not above this, in world units
   * (not in the paper). Normals, and shading with them, differ between orders before depth does: a
   * picture stays the same within 0.2 grey levels of 255 where this is about 0.4% of the discs'
   * radius or less (the bunny, by 100,000 and 1,000,000 points). Default: 0, all splats have the
   * same order.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The number k of nearest points that a splat is fitted to, the point itself among them, 4 or
   * more (section 2.3.1, which does not say how many). More neighbours make larger and fewer
   * splats, that follow details less closely. Default: 64.
   */
  vtkSetClampMacro(NumberOfNeighbors, int, 4, VTK_INT_MAX);
  vtkGetMacro(NumberOfNeighbors, int);
  ///@}

  enum SelectionType
  {
    ALL_POINTS = 0,
    HOLE_FREE = 1,
    FIXED_COUNT = 2
  };

  ///@{
  /**
   * Which points get a splat. ALL_POINTS: each. HOLE_FREE (the default, section 2.3.2): a point
   * chosen at random, which discards the points within Quality times h of it, and so on until none
   * is left. FIXED_COUNT (section 2.3.3): NumberOfSplats points, spread by
   * vtkLocallyOptimalProjection; h is then the mean distance of the eight nearest of them.
   */
  vtkSetClampMacro(Selection, int, ALL_POINTS, FIXED_COUNT);
  vtkGetMacro(Selection, int);
  void SetSelectionToAllPoints() { this->SetSelection(ALL_POINTS); }
  void SetSelectionToHoleFree() { this->SetSelection(HOLE_FREE); }
  void SetSelectionToFixedCount() { this->SetSelection(FIXED_COUNT); }
  ///@}

  ///@{
  /**
   * The factor s on h within which a splat stands for the points around it, over 0: the smaller,
   * the more splats. Default: 1.
   */
  vtkSetClampMacro(Quality, double, 1e-3, 1e3);
  vtkGetMacro(Quality, double);
  ///@}

  ///@{
  /**
   * The radius of a splat's disc is Overlap (1 to 10) times Quality times h; the paper has 1
   * (section 2.3.2), which leaves holes of the size of the points' spacing. Over 1, a disc of
   * HOLE_FREE is large enough to cover these, too: Quality times h and three quarters of the
   * spacing, which is more where Quality is small, or the neighbours that a splat is fitted to are
   * few. Default: 1.3.
   */
  vtkSetClampMacro(Overlap, double, 1.0, 10.0);
  vtkGetMacro(Overlap, double);
  ///@}

  ///@{
  /**
   * The number of splats of FIXED_COUNT, 1 or more; no more than there are points. Default: 1000.
   */
  vtkSetClampMacro(NumberOfSplats, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(NumberOfSplats, vtkIdType);
  ///@}

  ///@{
  /**
   * The seed of the random choices of HOLE_FREE and FIXED_COUNT. Default: 1.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  ///@{
  /**
   * Leave out neighbours whose normal is turned away from the point's by more than a right angle,
   * and do not discard them: they belong to the other side of a thin part (not in the paper). Where
   * fewer than an eighth of the neighbours share a point's side its normal is taken for wrong, and
   * the nearest neighbour's that they do share stands in for it. Default: on.
   */
  vtkSetMacro(RejectOppositeNormals, bool);
  vtkGetMacro(RejectOppositeNormals, bool);
  vtkBooleanMacro(RejectOppositeNormals, bool);
  ///@}

  ///@{
  /**
   * Where the neighbours lie to one side, as at a border or an edge of a thin part, a polynomial of
   * higher order runs wild on the other one. A splat gets the highest order that amplifies an error
   * of its neighbours by no more than this factor at Overlap times Quality times h from its centre,
   * which is the rim of its disc where that is no larger; 0: no limit (the paper).
   * Where that is lower than wanted, the farther half of the neighbours is first left out, and
   * again while 16 or more are left, and the disc moves away from the border as long as it covers
   * what the splat stands for: so it is less far over the border (both not for FIXED_COUNT).
   * Neighbours all around give a factor of 0.5 to 4, those of a half-plane 6 and more. Default: 5.
   */
  vtkSetClampMacro(ExtrapolationLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ExtrapolationLimit, double);
  ///@}

  ///@{
  /**
   * Compute `ApproximationError` of the second output and GetTotalError(). Default: off.
   */
  vtkSetMacro(ComputeErrors, bool);
  vtkGetMacro(ComputeErrors, bool);
  vtkBooleanMacro(ComputeErrors, bool);
  ///@}

  /**
   * The paper's equation 4, in world units: the sum of all `ApproximationError`; 0 if these were
   * not computed.
   */
  vtkGetMacro(TotalError, double);

protected:
  vtkAlgebraicSplats();
  ~vtkAlgebraicSplats() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkAlgebraicSplats(const vtkAlgebraicSplats&) = delete;
  void operator=(const vtkAlgebraicSplats&) = delete;

  class Worker;

  int Order = 3;
  double Tolerance = 0.0;
  int NumberOfNeighbors = 64;
  int Selection = HOLE_FREE;
  double Quality = 1.0;
  double Overlap = 1.3;
  vtkIdType NumberOfSplats = 1000;
  unsigned int Seed = 1;
  bool RejectOppositeNormals = true;
  double ExtrapolationLimit = 5.0;
  bool ComputeErrors = false;
  double TotalError = 0.0;
};

#endif
