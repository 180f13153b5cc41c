// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPCLSurfaceEstimation
 * @brief   what PCL's filters have in common that estimate a surface around each point
 *
 * The output is a shallow copy of the point set with `Normals` (float, unit, the active normals)
 * and `curvature` (float, 0 in a plane to 1/3: the least eigenvalue of the neighbours' covariance
 * over the sum of all). Normals point to the half space of the sensor: that of the field data
 * `viewpoint` (7 numbers, as vtkPCDReader gives), if there are any, else Viewpoint.
 *
 * Points that are not finite, or have fewer than 3 neighbours, get a zero normal and curvature,
 * with one warning that tells their number. Positions are taken about the middle of the cloud, so
 * that PCL's single precision does for coordinates of any size.
 *
 * Threads are those of vtkSMPTools. Progress is reported and AbortExecute is honoured in between;
 * the output of an aborted filter is its input.
 *
 * @sa
 * vtkPCLNormalEstimation vtkPCLMovingLeastSquares
 */

#ifndef vtkPCLSurfaceEstimation_h
#define vtkPCLSurfaceEstimation_h

#include "vtkPointSetAlgorithm.h"
#include "vtkPointSurfacePCLModule.h" // For export macro

class vtkFloatArray;
class vtkPCLLocalCloud;

class VTKPOINTSURFACEPCL_EXPORT vtkPCLSurfaceEstimation : public vtkPointSetAlgorithm
{
public:
  vtkTypeMacro(vtkPCLSurfaceEstimation, vtkPointSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The point that normals are turned to, in the coordinates of the input, where there are no field
   * data `viewpoint`. Default: (0, 0, 0).
   */
  vtkSetVector3Macro(Viewpoint, double);
  vtkGetVector3Macro(Viewpoint, double);
  ///@}

protected:
  vtkPCLSurfaceEstimation() = default;
  ~vtkPCLSurfaceEstimation() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /**
   * Sets normals and curvature, which are 0, of the points that have some, towards the viewpoint
   * where nothing else tells their side. Returns their number, which does not matter once the
   * filter is aborted. `output` has the points and arrays of the input, which is not empty.
   */
  virtual vtkIdType Estimate(const vtkPCLLocalCloud& local, const double viewpoint[3],
    vtkPointSet* output, vtkFloatArray* normals, vtkFloatArray* curvature) = 0;

private:
  vtkPCLSurfaceEstimation(const vtkPCLSurfaceEstimation&) = delete;
  void operator=(const vtkPCLSurfaceEstimation&) = delete;

  double Viewpoint[3] = { 0.0, 0.0, 0.0 };
};

#endif
