// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDrawablePoints
 * @brief   a cloud as the mappers upload it: every point with a position, and with a normal and a
 *          radius where the mapper needs them
 *
 * Takes the points of a vtkPolyData and what the user said of radii, and keeps the faults of the
 * data away from the graphics card. Where asked, what is to be drawn is brought to an order of
 * space: points that cannot be drawn are left out then, GetOrder() says which point is where, and
 * Arrange() brings arrays of the input, as of colours, to the same order. Else points and
 * attributes keep their order and count.
 * Not wrapped, not installed: it serves vtkPointSurfaceMapper.
 */
#ifndef vtkDrawablePoints_h
#define vtkDrawablePoints_h

#include "vtkKeptArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkSpatialOrder.h"
#include "vtkTimeStamp.h"
#include "vtkType.h"

#include <map>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataArray;
class vtkFloatArray;
class vtkPoints;
class vtkPolyData;

class vtkDrawablePoints
{
public:
  /**
   * Where radii come from: the array named here, else `Radius` if over 0, else an array "radius",
   * else vtkPointSpacing. Where radii are not needed but a sampling distance is, that stands for
   * all of them: `Radius` if over 0, else `SamplingDistance` if that is, of a cloud of which this
   * is a part, else the one of this quantile (vtkSamplingDistance). `Diagonal`, if over 0, is that
   * of the bounds of that cloud, by which radii are judged.
   */
  struct RadiusSource
  {
    std::string Array;
    double Radius = 0.0;
    double SamplingQuantile = -1.0;
    double SamplingDistance = 0.0;
    double Diagonal = 0.0;

    bool operator==(const RadiusSource& other) const
    {
      return this->Array == other.Array && this->Radius == other.Radius &&
        this->SamplingQuantile == other.SamplingQuantile &&
        this->SamplingDistance == other.SamplingDistance && this->Diagonal == other.Diagonal;
    }
  };

  /**
   * What the mapper makes use of. What it does not need is neither checked nor estimated.
   */
  struct Needs
  {
    bool Normals = true;
    bool Radii = true;
    bool SamplingDistance = false;
    bool SpatialOrder = true;
  };

  /**
   * Reads `input`, of which blocks begin at the points `blocks`. Returns what has to be said of the
   * data, a line each; empty if there is nothing. Estimates report their progress as that of
   * `caller`, and stop when it is told to abort: then all normals face the viewer, and radii are 0.
   * Such estimates are not kept.
   */
  std::vector<std::string> Build(vtkPolyData* input, const std::vector<vtkIdType>& blocks,
    const Needs& needs, const RadiusSource& source, vtkAlgorithm* caller);

  /**
   * Whether an estimate of the last Build() was aborted.
   */
  bool WasAborted() const { return this->Aborted; }

  /**
   * The cloud: points that are all finite, "Normals" that are finite (a zero normal means: facing
   * the viewer) where they are needed, else none, and no cells; in the order of space, or else with
   * all points and point arrays of the input.
   */
  vtkPolyData* GetCloud() const { return this->Cloud; }

  /**
   * A radius for each point of the cloud; nullptr when all have the radius `GetUniformRadius()`.
   */
  vtkFloatArray* GetRadii() const { return this->Radii; }

  /**
   * The radius of all points where there is no array of radii; 1 if radii are not needed and none
   * is known, so that a pixel's radius says still whether a point is there.
   */
  double GetUniformRadius() const { return this->LargestRadius > 0.0 ? this->LargestRadius : 1.0; }

  ///@{
  /**
   * Of the points' radii; 0 if none is known.
   */
  double GetLargestRadius() const { return this->LargestRadius; }
  double GetMeanRadius() const { return this->MeanRadius; }
  ///@}

  /**
   * Ids of the input's points to draw, in rising order, and when they last changed; empty when all
   * `GetNumberOfDrawnPoints()` of them are drawn.
   */
  const std::vector<unsigned int>& GetDrawnIds() const { return this->DrawnIds; }
  vtkMTimeType GetDrawnIdsTime() const { return this->DrawnIdsTime; }
  vtkIdType GetNumberOfDrawnPoints() const { return this->NumberOfDrawnPoints; }

  /**
   * For each point of the input 255 where another process has it too (vtkGhostType has
   * DUPLICATEPOINT), else 0; empty where there are none of these.
   */
  const std::vector<unsigned char>& GetDuplicates() const { return this->Duplicates; }

  ///@{
  /**
   * The order of space, which the cloud is in; and an array with a tuple for each point of the
   * input in that order: the same one as before where neither has changed. Each `use` of arrays has
   * a name. nullptr for nullptr.
   */
  const vtkSpatialOrder& GetOrder() const { return this->Order; }
  vtkDataArray* Arrange(const std::string& use, vtkDataArray* array);
  ///@}

  /**
   * When Build() was last called.
   */
  vtkMTimeType GetBuildTime() const { return this->BuildTime.GetMTime(); }

  /**
   * Bounds of the drawn points.
   */
  const double* GetBounds() const { return this->Bounds; }

  /**
   * The diagonal by which radii are judged: that of the source, else that of GetBounds(); 0 for no
   * more than one position.
   */
  double GetDiagonal() const { return this->Diagonal; }

private:
  void SelectPoints(vtkPolyData* input);
  void SelectNormals(vtkPolyData* input, vtkAlgorithm* caller);
  void SelectRadii(vtkPolyData* input, const RadiusSource& source, vtkAlgorithm* caller);
  void RepairRadii(vtkDataArray* radii);
  void EstimateNormals(vtkAlgorithm* caller);
  void EstimateRadii(vtkAlgorithm* caller);
  void SelectSamplingDistance(const RadiusSource& source, vtkAlgorithm* caller);
  void OrderPoints(const std::vector<vtkIdType>& blocks, vtkAlgorithm* caller);
  void Say(const std::string& line) { this->Remarks.push_back(line); }

  /// What was estimated from points, kept for as long as these do not change.
  struct Estimate
  {
    vtkPoints* Points = nullptr; // only compared
    vtkMTimeType Time = 0;
    vtkSmartPointer<vtkFloatArray> Array;
    bool IsOf(vtkPoints* points) const;
    void Set(vtkPoints* points, vtkFloatArray* array);
  };
  /// What is converted or repaired, which stays the same for as long as its values do.
  vtkKeptArray KeptCoordinates;
  vtkSmartPointer<vtkPoints> RepairedPoints;
  vtkKeptArray KeptNormals;
  vtkKeptArray KeptRadii;
  Estimate EstimatedNormals;
  Estimate EstimatedRadii;

  vtkPoints* InputPoints = nullptr; // only compared
  vtkSmartPointer<vtkPolyData> Cloud;
  vtkSmartPointer<vtkFloatArray> Radii;
  double LargestRadius = 0.0;
  double MeanRadius = 0.0;
  std::vector<unsigned int> DrawnIds;
  vtkTimeStamp DrawnIdsTime;
  vtkIdType NumberOfDrawnPoints = 0;
  std::vector<unsigned char> Duplicates;
  double Bounds[6] = { 1, -1, 1, -1, 1, -1 };
  double Diagonal = 0.0;
  vtkSpatialOrder Order;
  vtkSmartPointer<vtkPoints> OrderedPoints;
  struct Arranged
  {
    vtkDataArray* Source = nullptr; // only compared
    vtkMTimeType SourceTime = 0;
    vtkMTimeType OrderTime = 0;
    vtkSmartPointer<vtkDataArray> Array;
  };
  std::map<std::string, Arranged> ArrangedArrays; // by their uses
  std::vector<std::string> Remarks;
  bool Aborted = false;
  vtkTimeStamp BuildTime;
};

#endif
