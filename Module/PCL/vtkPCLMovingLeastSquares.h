// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPCLMovingLeastSquares
 * @brief   noisy points moved onto the smooth surface of their neighbours, with its normals, by PCL
 *
 * pcl::MovingLeastSquares in a pipeline: each point is projected onto a polynomial that is fitted
 * to the points around it. The output is a shallow copy of the point set with the points moved
 * (their number, order and precision stay), and with the normals and curvature that
 * vtkPCLSurfaceEstimation tells of; but normals take the side of the input's where it has some.
 * Points without a surface stay where they are.
 *
 * @sa
 * vtkPCLNormalEstimation vtkAlgebraicSplats
 */

#ifndef vtkPCLMovingLeastSquares_h
#define vtkPCLMovingLeastSquares_h

#include "vtkPCLSurfaceEstimation.h"
#include "vtkPointSurfacePCLModule.h" // For export macro

class VTKPOINTSURFACEPCL_EXPORT vtkPCLMovingLeastSquares : public vtkPCLSurfaceEstimation
{
public:
  static vtkPCLMovingLeastSquares* New();
  vtkTypeMacro(vtkPCLMovingLeastSquares, vtkPCLSurfaceEstimation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The distance within which points count, in units of the input, 0 or more; those at it weigh 1/e
   * of the nearest. Default: 0, which stands for 4 times the mean spacing by vtkPointSpacing.
   */
  vtkSetClampMacro(SearchRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SearchRadius, double);
  ///@}

  ///@{
  /**
   * The order of the polynomial, 1 (a plane) to 4. Where there are fewer neighbours than it has
   * coefficients it is a plane. Default: 2.
   */
  vtkSetClampMacro(PolynomialOrder, int, 1, 4);
  vtkGetMacro(PolynomialOrder, int);
  ///@}

protected:
  vtkPCLMovingLeastSquares() = default;
  ~vtkPCLMovingLeastSquares() override = default;

  vtkIdType Estimate(const vtkPCLLocalCloud& local, const double viewpoint[3], vtkPointSet* output,
    vtkFloatArray* normals, vtkFloatArray* curvature) override;

private:
  vtkPCLMovingLeastSquares(const vtkPCLMovingLeastSquares&) = delete;
  void operator=(const vtkPCLMovingLeastSquares&) = delete;

  double SearchRadius = 0.0;
  int PolynomialOrder = 2;
};

#endif
