// SPDX-License-Identifier: BSD-3-Clause
#include "vtkThinnedPoints.h"

#include "vtkDrawablePoints.h"
#include "vtkPointThinning.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArrayRange.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <numeric>

namespace
{
/// The least cosine of the angle between normals of one surface.
constexpr float LeastAlike = 0.5f;

/// Where the order goes to and fro between surfaces, a point joins one of so many groups before.
constexpr size_t OpenGroups = 4;

/// Sums over the points of a group.
struct Group
{
  vtkIdType First;
  int Count = 0;
  double Position[3] = { 0.0, 0.0, 0.0 };
  float Normal[3] = { 0.0f, 0.0f, 0.0f };
  float Radius = 0.0f;
  int Color[4] = { 0, 0, 0, 0 };
};

class Thinner
{
public:
  Thinner(const vtkDrawablePoints& points, vtkDataArray* colors,
    const vtkThinnedPoints::Frame& frame, int size, vtkThinnedPoints& result)
    : Order(points.GetOrder())
    , UniformRadius(static_cast<float>(points.GetUniformRadius()))
    , ByteColors(vtkArrayDownCast<vtkUnsignedCharArray>(colors))
    , TextureCoordinates(this->ByteColors ? nullptr : colors)
    , Frame(frame)
    , Size(size)
    , Result(result)
  {
    auto* normals = static_cast<vtkFloatArray*>(points.GetCloud()->GetPointData()->GetNormals());
    this->Normals = normals ? normals->GetPointer(0) : nullptr;
    this->Radii = points.GetRadii() ? points.GetRadii()->GetPointer(0) : nullptr;
  }

  template <typename Array>
  void operator()(Array* positions) const
  {
    const auto tuples = vtk::DataArrayTupleRange<3>(positions);
    // groups are made twice, which takes less than to keep all of them until they are counted
    std::vector<size_t> begins(this->Order.GetChunks().size() + 1, 0);
    this->ForGroups(tuples,
      [&](size_t chunk, const std::vector<Group>& groups) { begins[chunk + 1] = groups.size(); });
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    this->Allocate(begins.back());
    this->ForGroups(tuples,
      [&](size_t chunk, const std::vector<Group>& groups)
      {
        for (size_t i = 0; i < groups.size(); ++i)
        {
          this->WriteMean(groups[i], begins[chunk] + i);
        }
      });
  }

private:
  /// Calls a function with each chunk's number and groups.
  template <typename Tuples, typename Function>
  void ForGroups(const Tuples& tuples, const Function& function) const
  {
    const auto& chunks = this->Order.GetChunks();
    vtkSMPTools::For(0, static_cast<vtkIdType>(chunks.size()),
      [&](vtkIdType begin, vtkIdType end)
      {
        std::vector<Group> groups;
        for (vtkIdType chunk = begin; chunk < end; ++chunk)
        {
          this->MakeGroups(tuples, chunks[chunk], groups);
          function(static_cast<size_t>(chunk), groups);
        }
      });
  }

  template <typename Tuples>
  void MakeGroups(
    const Tuples& tuples, const vtkSpatialOrder::Chunk& chunk, std::vector<Group>& groups) const
  {
    groups.clear();
    for (vtkIdType point = chunk.First; point < chunk.End; ++point)
    {
      size_t i = groups.size();
      const size_t last = i - std::min(i, OpenGroups);
      while (i > last && !this->IsJoined(tuples, point, groups[i - 1]))
      {
        --i;
      }
      if (i == last)
      {
        groups.push_back({ point });
        i = groups.size();
      }
      this->Add(tuples, point, groups[i - 1]);
    }
  }

  template <typename Tuples>
  bool IsJoined(const Tuples& tuples, vtkIdType point, const Group& group) const
  {
    if (group.Count == this->Size)
    {
      return false;
    }
    const double radius = vtkPointThinning::GetRadiusFactor(this->Size) *
      (this->Radii ? this->Radii[group.First] : this->UniformRadius);
    double distance2 = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const double step = static_cast<double>(tuples[point][k]) - tuples[group.First][k];
      distance2 += step * step;
    }
    return distance2 <= radius * radius && this->AreNormalsAlike(point, group.First);
  }

  bool AreNormalsAlike(vtkIdType point, vtkIdType other) const
  {
    if (!this->Normals)
    {
      return true;
    }
    const float* a = this->Normals + 3 * point;
    const float* b = this->Normals + 3 * other;
    return vtkMath::Dot(a, b) >= LeastAlike * vtkMath::Norm(a) * vtkMath::Norm(b);
  }

  template <typename Tuples>
  void Add(const Tuples& tuples, vtkIdType point, Group& group) const
  {
    ++group.Count;
    for (int k = 0; k < 3; ++k)
    {
      group.Position[k] += tuples[point][k] - this->Frame.Origin[k];
    }
    if (this->Normals)
    {
      float normal[3];
      std::copy_n(this->Normals + 3 * point, 3, normal);
      vtkMath::Normalize(normal);
      vtkMath::Add(group.Normal, normal, group.Normal);
    }
    group.Radius += this->Radii ? this->Radii[point] : 0.0f;
    for (int k = 0; this->ByteColors && k < this->ByteColors->GetNumberOfComponents(); ++k)
    {
      group.Color[k] += this->ByteColors->GetTypedComponent(point, k);
    }
  }

  void Allocate(size_t count) const
  {
    this->Result.Firsts.resize(count);
    this->Result.Ids.resize(count);
    this->Result.Positions.resize(3 * count);
    this->Result.Normals.resize(this->Normals ? 3 * count : 0);
    this->Result.Radii.resize(this->Radii ? count : 0);
    vtkDataArray* colors = this->ByteColors ? this->ByteColors : this->TextureCoordinates;
    if (colors)
    {
      this->Result.Colors.TakeReference(
        vtkDataArray::CreateDataArray(this->ByteColors ? VTK_UNSIGNED_CHAR : VTK_FLOAT));
      this->Result.Colors->SetNumberOfComponents(colors->GetNumberOfComponents());
      this->Result.Colors->SetNumberOfTuples(static_cast<vtkIdType>(count));
    }
  }

  void WriteMean(const Group& group, size_t to) const
  {
    this->Result.Firsts[to] = static_cast<unsigned int>(group.First);
    this->Result.Ids[to] = this->Order.GetIds()[group.First];
    for (int k = 0; k < 3; ++k)
    {
      this->Result.Positions[3 * to + k] =
        static_cast<float>(this->Frame.Scale[k] * group.Position[k] / group.Count);
    }
    if (this->Normals)
    {
      std::copy_n(group.Normal, 3, &this->Result.Normals[3 * to]);
    }
    if (this->Radii)
    {
      this->Result.Radii[to] = group.Radius / group.Count;
    }
    const int size = this->Result.Colors ? this->Result.Colors->GetNumberOfComponents() : 0;
    for (int k = 0; k < size; ++k)
    {
      this->Result.Colors->SetComponent(static_cast<vtkIdType>(to), k,
        this->ByteColors ? (group.Color[k] + group.Count / 2) / group.Count
                         : this->TextureCoordinates->GetComponent(group.First, k));
    }
  }

  const vtkSpatialOrder& Order;
  const float* Normals; // nullptr: all points face the viewer
  const float* Radii;   // nullptr: all have the same
  float UniformRadius;
  vtkUnsignedCharArray* ByteColors; // one of the two, if any
  vtkDataArray* TextureCoordinates;
  const vtkThinnedPoints::Frame& Frame;
  int Size;
  vtkThinnedPoints& Result;
};
}

vtkThinnedPoints::Source vtkThinnedPoints::GetSource(
  const vtkDrawablePoints& points, vtkDataArray* colors, const Frame& frame)
{
  Source source;
  for (vtkDataArray* array : { points.GetCloud()->GetPoints()->GetData(),
         points.GetCloud()->GetPointData()->GetNormals(),
         static_cast<vtkDataArray*>(points.GetRadii()), colors })
  {
    source.push_back(array ? static_cast<double>(array->GetMTime()) : 0.0); // times are unique
  }
  source.push_back(static_cast<double>(points.GetOrder().GetTime()));
  source.push_back(points.GetUniformRadius());
  source.insert(source.end(), frame.Origin.begin(), frame.Origin.end());
  source.insert(source.end(), frame.Scale.begin(), frame.Scale.end());
  return source;
}

vtkThinnedPoints::vtkThinnedPoints(
  const vtkDrawablePoints& points, vtkDataArray* colors, const Frame& frame, int size)
{
  const Thinner thinner(points, colors, frame, size, *this);
  vtkDataArray* positions = points.GetCloud()->GetPoints()->GetData();
  using Dispatcher = vtkArrayDispatch::DispatchByValueType<vtkArrayDispatch::Reals>;
  if (!Dispatcher::Execute(positions, thinner))
  {
    thinner(positions);
  }
}

std::vector<std::array<vtkIdType, 2>> vtkThinnedPoints::GetGroups(
  const std::vector<unsigned int>& firsts, const std::vector<std::array<vtkIdType, 2>>& ranges)
{
  const auto getFirst = [&firsts](vtkIdType point) -> vtkIdType
  {
    return std::lower_bound(firsts.begin(), firsts.end(), static_cast<unsigned int>(point)) -
      firsts.begin();
  };
  std::vector<std::array<vtkIdType, 2>> groups;
  for (const auto& range : ranges)
  {
    groups.push_back({ getFirst(range[0]), getFirst(range[1]) });
  }
  return groups;
}
