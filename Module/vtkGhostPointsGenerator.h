// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGhostPointsGenerator
 * @brief   copies of the points beyond a rank's borders, so that its surface does not end there
 *
 * In a parallel run each rank draws its own points, and the surface at its borders would lack what
 * the points of its neighbours add. This filter gives each rank copies of all points of other ranks
 * that are closer than Reach radii to the box of its own points, with all their point arrays.
 * (VTK's own ghost cells come with cells alone, which clouds have not.) Then each rank draws the
 * surface whole up to its borders and somewhat beyond; where both sides draw it, they draw the
 * same, so that compositing by depth gives the picture of the whole cloud.
 *
 * Input is vtkPolyData, or a tree with the same leaves on all ranks; points go to the leaf that
 * they come from. The output is the input with the copies added behind its points, and two point
 * arrays: `vtkGhostType` (the copies are vtkDataSetAttributes::DUPLICATEPOINT; the mappers draw
 * these, and filters that count or sum leave them out) and `vtkProcessId` (unsigned int, the rank
 * that a point is of, for selections). A rank without points gets none. With one process the output
 * is the input.
 *
 * Field data `vtkWholeCloud` (9 doubles) tell the mappers the bounds of all ranks' points, the mean
 * and the largest radius, and the sampling distance: by these they choose how fine an image is, how
 * deep a pyramid. Give the mappers the radii that this filter has, and vtkDirectPointMapper the
 * same quantile; it needs DistantPoints besides.
 *
 * Radii are those that the mappers take, by the same rules: RadiusArray, else Radius, else an array
 * `radius`, else those of vtkPointSpacing, which takes some time. Point arrays that do not have a
 * value for each point are left out, with a warning. Normals should be there: estimates of two
 * ranks may differ in their side.
 *
 * The cost is that of the points near borders where each rank has a region of its own; ranks whose
 * boxes overlap exchange all that lies in both (redistribute such data first).
 *
 * All ranks have to run the filter, as it communicates; it cannot be aborted. Ranks with trees that
 * differ get one error, and their input.
 *
 * @sa
 * vtkPointSurfaceMapper vtkPointSpacing vtkGhostCellsGenerator
 */

#ifndef vtkGhostPointsGenerator_h
#define vtkGhostPointsGenerator_h

#include "vtkPassInputTypeAlgorithm.h"
#include "vtkPointSurfaceModule.h" // For export macro

#include <string> // For std::string

class vtkMultiProcessController;
class vtkPointData;

class VTKPOINTSURFACE_EXPORT vtkGhostPointsGenerator : public vtkPassInputTypeAlgorithm
{
public:
  static vtkGhostPointsGenerator* New();
  vtkTypeMacro(vtkGhostPointsGenerator, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The processes that exchange points. Default: the global controller, if there is one.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * How far from the box of a rank's points those of others are still copied to it, in their own
   * radii; 0 or more. Default: 8. A footprint reaches one radius, and the one that it overlaps
   * another; what fills a hole lies up to three radii around it and four in depth (the reach of
   * vtkImageSpacePointMapper), and is there only if its own surroundings are known.
   */
  vtkSetClampMacro(Reach, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Reach, double);
  ///@}

  ///@{
  /**
   * The point array with radii, in the units of the coordinates. Default: empty, none.
   */
  vtkSetMacro(RadiusArray, std::string);
  vtkGetMacro(RadiusArray, std::string);
  ///@}

  ///@{
  /**
   * One radius for all points, in the units of the coordinates. Default: 0, none.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Which quantile of the distances between neighbours is the sampling distance, which
   * vtkDirectPointMapper draws by; see there. All ranks ask the points that one process would, so
   * that it is the same. Below 0: it is not estimated, which saves some time where no such mapper
   * draws, nor is it where Radius is set. Default: 0.98.
   */
  vtkSetClampMacro(SamplingQuantile, double, -1.0, 1.0);
  vtkGetMacro(SamplingQuantile, double);
  ///@}

  ///@{
  /**
   * About how many points of others a rank gets at most that are farther than its reach, where
   * vtkDirectPointMapper draws: what a plane is fitted to depends on what hides the points behind
   * it, which may be anywhere before them. Of that many, and fewer, it gets all, and the picture is
   * that of one process; else as many by chance, and single pixels at outlines may be left out.
   * Other mappers would draw these points to no avail. Default: 0, none.
   */
  vtkSetClampMacro(DistantPoints, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(DistantPoints, vtkIdType);
  ///@}

  /**
   * How many points this rank got when the filter last ran.
   */
  vtkGetMacro(NumberOfGhostPoints, vtkIdType);

protected:
  vtkGhostPointsGenerator();
  ~vtkGhostPointsGenerator() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkGhostPointsGenerator(const vtkGhostPointsGenerator&) = delete;
  void operator=(const vtkGhostPointsGenerator&) = delete;

  void LeaveOutUnfit(vtkPointData* data, vtkIdType points);

  vtkMultiProcessController* Controller = nullptr;
  double Reach = 8.0;
  std::string RadiusArray;
  double Radius = 0.0;
  double SamplingQuantile = 0.98;
  vtkIdType DistantPoints = 0;
  vtkIdType NumberOfGhostPoints = 0;
};

#endif
