// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSpatialOrder
 * @brief   points in the order of a Morton curve, cut into chunks with bounds
 *
 * What lies together on the screen then lies together in memory, and what is outside of a view is
 * left out chunk by chunk. Of points that are at the same place the first one stays the first. An
 * order is kept while points move, for as long as its chunks stay about as small as they were: what
 * was arranged by it, and perhaps uploaded, then stays as it is.
 */
#ifndef vtkSpatialOrder_h
#define vtkSpatialOrder_h

#include "vtkSmartPointer.h"
#include "vtkTimeStamp.h"
#include "vtkType.h"

#include <array>
#include <vector>

class vtkAlgorithm;
class vtkDataArray;
class vtkPoints;

class vtkSpatialOrder
{
public:
  /// Points that follow each other.
  struct Chunk
  {
    vtkIdType First, End; ///< places in the order
    std::array<double, 6> Bounds;
  };

  /**
   * Orders those of the points that are listed in `ids`, in rising order; all if it is empty. Parts
   * of them, each of which begins where `starts` says among the ids, stay apart in their order.
   * Progress is reported as that of `caller`.
   */
  void Update(vtkPoints* points, const std::vector<unsigned int>& ids,
    const std::vector<vtkIdType>& starts, vtkAlgorithm* caller);

  /**
   * The ids of the points as they are ordered, and when that last changed.
   */
  const std::vector<unsigned int>& GetIds() const { return this->Ids; }
  vtkMTimeType GetTime() const { return this->Time.GetMTime(); }

  const std::vector<Chunk>& GetChunks() const { return this->Chunks; }

  /**
   * A new array with a tuple for each ordered point, from one with a tuple for each id.
   */
  vtkSmartPointer<vtkDataArray> Arrange(vtkDataArray* array) const;

private:
  void Sort(vtkPoints* points, vtkIdType first, vtkIdType end);
  void CutChunks(vtkIdType first, vtkIdType end);
  double MeasureChunks(vtkPoints* points);

  vtkIdType NumberOfPoints = 0; // all, and what was listed of them
  std::vector<unsigned int> Listed;
  std::vector<vtkIdType> Starts;
  std::vector<unsigned int> Ids;
  std::vector<Chunk> Chunks;
  double ChunkSize = 0.0; // sum of diagonals when the order was made
  vtkTimeStamp Time;
};

#endif
