// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSpacing
 * @brief   a radius for each point from the distances of its neighbours
 *
 * vtkPointSpacing adds a point data array of radii (float, in the units of the coordinates) to a
 * shallow copy of a point set. The radius of a point is Scale times the spacing there. The spacing
 * is the side of the square that each point has to itself on the surface, estimated from the
 * distance d to the k-th nearest neighbour as d sqrt(pi / k): the disc of radius d holds k points.
 *
 * Points at the same position are one neighbour and get the same radius. A spacing above
 * MaximumSpacing times the median is an outlier and is cut to that. Points that are not finite get
 * the radius of the median spacing, with one warning. If there are no more than k distinct
 * positions, all of them are neighbours. If there is one only, the spacing is unknown and the
 * radius 0, with one warning.
 *
 * The filter is threaded by vtkSMPTools; its output is the same for any backend and number of
 * threads. It reports progress and can be aborted; the output then has no new array.
 *
 * @sa
 * vtkIsosurfacePoints vtkPointNormals vtkStaticPointLocator
 */

#ifndef vtkPointSpacing_h
#define vtkPointSpacing_h

#include "vtkPointSetAlgorithm.h"
#include "vtkPointSurfaceModule.h" // For export macro

#include <string> // For std::string

class VTKPOINTSURFACE_EXPORT vtkPointSpacing : public vtkPointSetAlgorithm
{
public:
  static vtkPointSpacing* New();
  vtkTypeMacro(vtkPointSpacing, vtkPointSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The number k of neighbours, 1 or more. Fewer follow changes of density more closely, more are
   * steadier. Default: 12.
   */
  vtkSetClampMacro(NumberOfNeighbors, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfNeighbors, int);
  ///@}

  ///@{
  /**
   * What the spacing is multiplied by to give the radius, 0 or more. Default: 1.5, which closes
   * randomly sampled surfaces but for a hole in a thousand.
   */
  vtkSetClampMacro(Scale, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /**
   * The largest spacing, as a multiple of the median of all points, 1 or more. Default: 10.
   */
  vtkSetClampMacro(MaximumSpacing, double, 1.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumSpacing, double);
  ///@}

  ///@{
  /**
   * The name of the array of radii. Default: "radius".
   */
  vtkSetMacro(RadiusArrayName, std::string);
  vtkGetMacro(RadiusArrayName, std::string);
  ///@}

protected:
  vtkPointSpacing() = default;
  ~vtkPointSpacing() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPointSpacing(const vtkPointSpacing&) = delete;
  void operator=(const vtkPointSpacing&) = delete;

  int NumberOfNeighbors = 12;
  double Scale = 1.5;
  double MaximumSpacing = 10.0;
  std::string RadiusArrayName = "radius";
};

#endif
