// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLocallyOptimalProjection
 * @brief   spreads a given number of points evenly over a point cloud
 *
 * The LOP operator: Y. Lipman, D. Cohen-Or, D. Levin, H. Tal-Ezer, Parameterization-free Projection
 * for Geometry Reconstruction, 2007. Points drawn at random from the input move, again and again,
 * to the locally weighted median of the input (attraction, theta(r) = exp(-r^2 / (h/4)^2)), and
 * away from each other (repulsion, eta(r) = 1 / (3 r^3), weighted by Mu), until they stay.
 *
 * The output is a vtkPolyData of points without cells, with the point data of the nearest point of
 * the input, and `InputPointIds` (vtkIdType), which tells that point. Points of the input that are
 * not finite are left out, with a warning; points at the same position count once.
 *
 * The filter is threaded by vtkSMPTools; its output is the same for any backend and number of
 * threads. It reports progress and can be aborted; the output then has no points.
 *
 * @sa
 * vtkAlgebraicSplats
 */

#ifndef vtkLocallyOptimalProjection_h
#define vtkLocallyOptimalProjection_h

#include "vtkPointSurfaceModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKPOINTSURFACE_EXPORT vtkLocallyOptimalProjection : public vtkPolyDataAlgorithm
{
public:
  static vtkLocallyOptimalProjection* New();
  vtkTypeMacro(vtkLocallyOptimalProjection, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of points of the output, 1 or more; where the input has no more distinct points,
   * these are the output as they are. Default: 1000.
   */
  vtkSetClampMacro(NumberOfPoints, vtkIdType, 1, VTK_ID_MAX);
  vtkGetMacro(NumberOfPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * The seed of the random start. Default: 1.
   */
  vtkSetMacro(Seed, unsigned int);
  vtkGetMacro(Seed, unsigned int);
  ///@}

  ///@{
  /**
   * The support h of the weights, in world units; 0 (the default) takes four times the spacing that
   * the points of the output will have, from the input's vtkPointSpacing.
   */
  vtkSetClampMacro(Support, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Support, double);
  ///@}

  ///@{
  /**
   * The weight of the repulsion, 0 to below 0.5, where the operator is known to converge. Default:
   * 0.45.
   */
  vtkSetClampMacro(Mu, double, 0.0, 0.499);
  vtkGetMacro(Mu, double);
  ///@}

  ///@{
  /**
   * The points have converged when they move by less than this share of h, on average. Default:
   * 1e-3.
   */
  vtkSetClampMacro(Convergence, double, 0.0, 1.0);
  vtkGetMacro(Convergence, double);
  ///@}

  ///@{
  /**
   * The most iterations, 1 or more. Default: 100.
   */
  vtkSetClampMacro(MaximumNumberOfIterations, int, 1, VTK_INT_MAX);
  vtkGetMacro(MaximumNumberOfIterations, int);
  ///@}

  /**
   * The iterations of the last run.
   */
  vtkGetMacro(NumberOfIterations, int);

protected:
  vtkLocallyOptimalProjection() = default;
  ~vtkLocallyOptimalProjection() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkLocallyOptimalProjection(const vtkLocallyOptimalProjection&) = delete;
  void operator=(const vtkLocallyOptimalProjection&) = delete;

  double ChooseSupport(vtkPolyData* cloud, vtkIdType count);

  vtkIdType NumberOfPoints = 1000;
  unsigned int Seed = 1;
  double Support = 0.0;
  double Mu = 0.45;
  double Convergence = 1e-3;
  int MaximumNumberOfIterations = 100;
  int NumberOfIterations = 0;
};

#endif
