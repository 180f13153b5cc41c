// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointNormals
 * @brief   a unit normal for each point from the plane of its neighbours, oriented
 *
 * vtkPointNormals adds `Normals` (float, unit, the active normals) to a shallow copy of a point
 * set: the direction in which the nearest neighbours vary least, by vtkPCANormalEstimation. Such a
 * direction has no sign; NormalOrientation tells how it gets one.
 *
 * Points at the same position count once and get the same normal. Points that are not finite get a
 * zero normal, with one warning. Where the neighbours lie on a line or in a point, the normal is
 * some unit vector across it. With no more than NumberOfNeighbors distinct positions, all are
 * neighbours.
 *
 * The estimation is one step of VTK's, threaded but for the traversal: progress is reported and
 * AbortExecute is honoured before and after it. The output of an aborted filter has no new array.
 *
 * @sa
 * vtkPCANormalEstimation vtkPointSpacing vtkIsosurfacePoints
 */

#ifndef vtkPointNormals_h
#define vtkPointNormals_h

#include "vtkPointSetAlgorithm.h"
#include "vtkPointSurfaceModule.h" // For export macro

class VTKPOINTSURFACE_EXPORT vtkPointNormals : public vtkPointSetAlgorithm
{
public:
  static vtkPointNormals* New();
  vtkTypeMacro(vtkPointNormals, vtkPointSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number of nearest points, the point itself among them, that the plane is laid through; 3
   * or more. More are steadier against noise and rounder at edges. Default: 16.
   */
  vtkSetClampMacro(NumberOfNeighbors, int, 3, VTK_INT_MAX);
  vtkGetMacro(NumberOfNeighbors, int);
  ///@}

  enum Orientation
  {
    GRAPH_TRAVERSAL = 0,
    POINT = 1
  };

  ///@{
  /**
   * How normals get their sign. GRAPH_TRAVERSAL (the default): from neighbour to neighbour, so that
   * they agree; then all are turned, if need be, so that on the whole they point away from the
   * middle of the points, which is outward on a closed surface. POINT: each towards
   * OrientationPoint, which suits a scan with a known viewpoint.
   */
  vtkSetClampMacro(NormalOrientation, int, GRAPH_TRAVERSAL, POINT);
  vtkGetMacro(NormalOrientation, int);
  void SetNormalOrientationToGraphTraversal() { this->SetNormalOrientation(GRAPH_TRAVERSAL); }
  void SetNormalOrientationToPoint() { this->SetNormalOrientation(POINT); }
  ///@}

  ///@{
  /**
   * The point that normals turn to under POINT, in the coordinates of the input. Default: (0, 0,
   * 0).
   */
  vtkSetVector3Macro(OrientationPoint, double);
  vtkGetVector3Macro(OrientationPoint, double);
  ///@}

  ///@{
  /**
   * Turn all normals round. Default: off.
   */
  vtkSetMacro(FlipNormals, bool);
  vtkGetMacro(FlipNormals, bool);
  vtkBooleanMacro(FlipNormals, bool);
  ///@}

protected:
  vtkPointNormals() = default;
  ~vtkPointNormals() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPointNormals(const vtkPointNormals&) = delete;
  void operator=(const vtkPointNormals&) = delete;

  int NumberOfNeighbors = 16;
  int NormalOrientation = GRAPH_TRAVERSAL;
  double OrientationPoint[3] = { 0.0, 0.0, 0.0 };
  bool FlipNormals = false;
};

#endif
