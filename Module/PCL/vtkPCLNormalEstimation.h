// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPCLNormalEstimation
 * @brief   normals and curvature from neighbours, turned towards the sensor, by PCL
 *
 * pcl::NormalEstimationOMP in a pipeline. What it adds to a point set, which side normals point to,
 * and what becomes of points without a surface is told by vtkPCLSurfaceEstimation. The side suits
 * what one sensor saw; for a closed surface take vtkPointNormals, and also for points on lines, to
 * which PCL gives any normal, or a zero one.
 *
 * @sa
 * vtkPointNormals vtkPCLMovingLeastSquares
 */

#ifndef vtkPCLNormalEstimation_h
#define vtkPCLNormalEstimation_h

#include "vtkPCLSurfaceEstimation.h"
#include "vtkPointSurfacePCLModule.h" // For export macro

class VTKPOINTSURFACEPCL_EXPORT vtkPCLNormalEstimation : public vtkPCLSurfaceEstimation
{
public:
  static vtkPCLNormalEstimation* New();
  vtkTypeMacro(vtkPCLNormalEstimation, vtkPCLSurfaceEstimation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of nearest points, the point itself among them, that the plane is laid through; 3
   * or more. Not used where SearchRadius is above 0. Default: 16.
   */
  vtkSetClampMacro(NumberOfNeighbors, int, 3, VTK_INT_MAX);
  vtkGetMacro(NumberOfNeighbors, int);
  ///@}

  ///@{
  /**
   * The plane is laid through all points within this distance, in units of the input, 0 or more.
   * Default: 0, which stands for NumberOfNeighbors.
   */
  vtkSetClampMacro(SearchRadius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(SearchRadius, double);
  ///@}

protected:
  vtkPCLNormalEstimation() = default;
  ~vtkPCLNormalEstimation() override = default;

  vtkIdType Estimate(const vtkPCLLocalCloud& local, const double viewpoint[3], vtkPointSet* output,
    vtkFloatArray* normals, vtkFloatArray* curvature) override;

private:
  vtkPCLNormalEstimation(const vtkPCLNormalEstimation&) = delete;
  void operator=(const vtkPCLNormalEstimation&) = delete;

  int NumberOfNeighbors = 16;
  double SearchRadius = 0.0;
};

#endif
