// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpatialOrder.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>

namespace
{
constexpr vtkIdType PointsOfChunk = 1024;

/// How much larger chunks may grow until points are ordered anew.
constexpr double LargestGrowth = 1.5;

/// Cells along a side of the box that the curve runs through: three such numbers and an id are
/// sorted as one of 64 bits.
constexpr int BitsOfCell = 10;

/// Bounds of the points of some ids.
std::array<double, 6> GetBounds(
  vtkPoints* points, const unsigned int* begin, const unsigned int* end)
{
  std::array<double, 6> bounds = { VTK_DOUBLE_MAX, -VTK_DOUBLE_MAX, VTK_DOUBLE_MAX, -VTK_DOUBLE_MAX,
    VTK_DOUBLE_MAX, -VTK_DOUBLE_MAX };
  for (const unsigned int* id = begin; id < end; ++id)
  {
    double x[3];
    points->GetPoint(*id, x);
    for (int k = 0; k < 3; ++k)
    {
      bounds[2 * k] = std::min(bounds[2 * k], x[k]);
      bounds[2 * k + 1] = std::max(bounds[2 * k + 1], x[k]);
    }
  }
  return bounds;
}

/// The bits of a number at every third place.
std::uint64_t Spread(std::uint64_t bits)
{
  bits = (bits | (bits << 16)) & 0x030000ff;
  bits = (bits | (bits << 8)) & 0x0300f00f;
  bits = (bits | (bits << 4)) & 0x030c30c3;
  return (bits | (bits << 2)) & 0x09249249;
}
}

void vtkSpatialOrder::Update(vtkPoints* points, const std::vector<unsigned int>& ids,
  const std::vector<vtkIdType>& starts, vtkAlgorithm* caller)
{
  const vtkIdType count = points->GetNumberOfPoints();
  if (count == this->NumberOfPoints && ids == this->Listed && starts == this->Starts &&
    this->MeasureChunks(points) <= LargestGrowth * this->ChunkSize)
  {
    return;
  }
  caller->SetProgressText("Ordering points");
  this->NumberOfPoints = count;
  this->Listed = ids;
  this->Starts = starts;
  this->Ids = ids;
  if (ids.empty())
  {
    this->Ids.resize(count);
    std::iota(this->Ids.begin(), this->Ids.end(), 0u);
  }
  this->Chunks.clear();
  const auto ordered = static_cast<vtkIdType>(this->Ids.size());
  for (size_t part = 0; part < starts.size(); ++part)
  {
    const vtkIdType end = part + 1 < starts.size() ? starts[part + 1] : ordered;
    this->Sort(points, starts[part], end);
    this->CutChunks(starts[part], end);
    caller->UpdateProgress(static_cast<double>(end) / ordered);
  }
  this->ChunkSize = this->MeasureChunks(points);
  this->Time.Modified();
  caller->SetProgressText(nullptr);
}

void vtkSpatialOrder::Sort(vtkPoints* points, vtkIdType first, vtkIdType end)
{
  const unsigned int* ids = this->Ids.data();
  const std::array<double, 6> bounds = GetBounds(points, ids + first, ids + end);
  double side = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    side = std::max(side, bounds[2 * k + 1] - bounds[2 * k]);
  }
  const double last = (1 << BitsOfCell) - 1;
  const double scale = side > 0.0 ? last / side : 0.0;
  std::vector<std::uint64_t> keys(end - first);
  vtkSMPTools::For(first, end,
    [&](vtkIdType from, vtkIdType to)
    {
      for (vtkIdType i = from; i < to; ++i)
      {
        double x[3];
        points->GetPoint(ids[i], x);
        std::uint64_t cell = 0;
        for (int k = 0; k < 3; ++k)
        {
          const double place = std::min(std::max(scale * (x[k] - bounds[2 * k]), 0.0), last);
          cell |= Spread(static_cast<std::uint64_t>(place)) << k;
        }
        keys[i - first] = cell << 32 | ids[i];
      }
    });
  vtkSMPTools::Sort(keys.begin(), keys.end());
  std::transform(keys.begin(), keys.end(), this->Ids.begin() + first,
    [](std::uint64_t key) { return static_cast<unsigned int>(key & 0xffffffffu); });
}

void vtkSpatialOrder::CutChunks(vtkIdType first, vtkIdType end)
{
  for (vtkIdType begin = first; begin < end; begin += PointsOfChunk)
  {
    this->Chunks.push_back({ begin, std::min(begin + PointsOfChunk, end), {} });
  }
}

/// Takes the chunks' bounds; returns the sum of their diagonals.
double vtkSpatialOrder::MeasureChunks(vtkPoints* points)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Chunks.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        Chunk& chunk = this->Chunks[i];
        const unsigned int* ids = this->Ids.data();
        chunk.Bounds = GetBounds(points, ids + chunk.First, ids + chunk.End);
      }
    });
  double sum = 0.0;
  for (const Chunk& chunk : this->Chunks)
  {
    const auto& b = chunk.Bounds;
    sum += std::hypot(b[1] - b[0], b[3] - b[2], b[5] - b[4]);
  }
  return sum;
}

vtkSmartPointer<vtkDataArray> vtkSpatialOrder::Arrange(vtkDataArray* array) const
{
  vtkSmartPointer<vtkDataArray> source = array;
  if (!array->HasStandardMemoryLayout())
  {
    source.TakeReference(vtkDataArray::CreateDataArray(array->GetDataType()));
    source->DeepCopy(array);
  }
  vtkSmartPointer<vtkDataArray> arranged;
  arranged.TakeReference(vtkDataArray::CreateDataArray(array->GetDataType()));
  arranged->SetName(array->GetName());
  arranged->SetNumberOfComponents(array->GetNumberOfComponents());
  arranged->SetNumberOfTuples(static_cast<vtkIdType>(this->Ids.size()));
  const size_t size =
    static_cast<size_t>(array->GetNumberOfComponents()) * array->GetDataTypeSize();
  const char* from = static_cast<const char*>(source->GetVoidPointer(0));
  char* to = static_cast<char*>(arranged->GetVoidPointer(0));
  vtkSMPTools::For(0, arranged->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        std::memcpy(to + i * size, from + this->Ids[i] * size, size);
      }
    });
  return arranged;
}
