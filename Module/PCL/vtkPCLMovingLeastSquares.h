// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPCLMovingLeastSquares
 * @brief   noisy points moved onto the smooth surface of their neighbours, with its normals, by PCL
 *
 * pcl::MovingLeastSquares in a pipeline: each point is projected onto a polynomial that is fitted
 * to the points around it. The output is a shallow copy of the point set with the points moved
 * (their number, order and precision stay), `Normals` (float, unit, the active normals) and
 * `curvature` (float, as in vtkPCLNormalEstimation).
 *
 * Normals take the side of the input's where it has some, else that of the sensor: the field data
 * `viewpoint` (as vtkPCDReader gives), if there are any, else Viewpoint.
 *
 * Points that are not finite, or have fewer than 3 neighbours, stay where they are, and get a zero
 * normal and curvature, with one warning. Positions are taken about the middle of the cloud, so
 * that PCL's single precision does for coordinates of any size.
 *
 * Threads are those of vtkSMPTools. Progress is reported and AbortExecute is honoured in between;
 * the output of an aborted filter is its input.
 *
 * @sa
 * vtkPCLNormalEstimation vtkAlgebraicSplats
 */

#ifndef vtkPCLMovingLeastSquares_h
#define vtkPCLMovingLeastSquares_h

#include "vtkPointSetAlgorithm.h"
#include "vtkPointSurfacePCLModule.h" // For export macro

class VTKPOINTSURFACEPCL_EXPORT vtkPCLMovingLeastSquares : public vtkPointSetAlgorithm
{
public:
  static vtkPCLMovingLeastSquares* New();
  vtkTypeMacro(vtkPCLMovingLeastSquares, vtkPointSetAlgorithm);
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

  ///@{
  /**
   * The point that normals are turned to, in the coordinates of the input, where it has neither
   * normals nor field data `viewpoint`. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(Viewpoint, double);
  vtkGetVector3Macro(Viewpoint, double);
  ///@}

protected:
  vtkPCLMovingLeastSquares() = default;
  ~vtkPCLMovingLeastSquares() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPCLMovingLeastSquares(const vtkPCLMovingLeastSquares&) = delete;
  void operator=(const vtkPCLMovingLeastSquares&) = delete;

  double SearchRadius = 0.0;
  int PolynomialOrder = 2;
  double Viewpoint[3] = { 0.0, 0.0, 0.0 };
};

#endif
