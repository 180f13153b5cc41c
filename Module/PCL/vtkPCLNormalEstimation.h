// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPCLNormalEstimation
 * @brief   normals and curvature from neighbours, turned towards the sensor, by PCL
 *
 * pcl::NormalEstimationOMP in a pipeline. Adds `Normals` (float, unit, the active normals) and
 * `curvature` (float, 0 in a plane to 1/3: the least eigenvalue of the neighbours' covariance over
 * the sum of all) to a shallow copy of a point set.
 *
 * Each normal points to the half space of the sensor: that of the field data `viewpoint` (as
 * vtkPCDReader gives), if there are any, else Viewpoint. That suits what one sensor saw; for a
 * closed surface take vtkPointNormals.
 *
 * Points that are not finite, or have fewer than 3 neighbours, get a zero normal and curvature,
 * with one warning. Positions are taken about the middle of the cloud, so that PCL's single
 * precision does for coordinates of any size.
 *
 * Threads are those of vtkSMPTools. Progress is reported and AbortExecute is honoured in between;
 * the output of an aborted filter has no new arrays.
 *
 * @sa
 * vtkPointNormals vtkPCLMovingLeastSquares
 */

#ifndef vtkPCLNormalEstimation_h
#define vtkPCLNormalEstimation_h

#include "vtkPointSetAlgorithm.h"
#include "vtkPointSurfacePCLModule.h" // For export macro

class VTKPOINTSURFACEPCL_EXPORT vtkPCLNormalEstimation : public vtkPointSetAlgorithm
{
public:
  static vtkPCLNormalEstimation* New();
  vtkTypeMacro(vtkPCLNormalEstimation, vtkPointSetAlgorithm);
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

  ///@{
  /**
   * The point that normals are turned to, in the coordinates of the input, where there are no field
   * data `viewpoint`. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(Viewpoint, double);
  vtkGetVector3Macro(Viewpoint, double);
  ///@}

protected:
  vtkPCLNormalEstimation() = default;
  ~vtkPCLNormalEstimation() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPCLNormalEstimation(const vtkPCLNormalEstimation&) = delete;
  void operator=(const vtkPCLNormalEstimation&) = delete;

  int NumberOfNeighbors = 16;
  double SearchRadius = 0.0;
  double Viewpoint[3] = { 0.0, 0.0, 0.0 };
};

#endif
