// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDistinctPoints.h"

#include "vtkSMPTools.h"

#include <cmath>
#include <tuple>

namespace
{
struct Position
{
  double X[3];
  vtkIdType Id;

  bool IsAt(const Position& other) const
  {
    return this->X[0] == other.X[0] && this->X[1] == other.X[1] && this->X[2] == other.X[2];
  }
  bool operator<(const Position& other) const
  {
    return std::tie(this->X[0], this->X[1], this->X[2], this->Id) <
      std::tie(other.X[0], other.X[1], other.X[2], other.Id);
  }
};
} // anonymous namespace

//------------------------------------------------------------------------------
vtkDistinctPoints::vtkDistinctPoints(vtkPointSet* input)
  : DistinctIds(input->GetNumberOfPoints(), -1)
{
  std::vector<Position> positions;
  positions.reserve(this->DistinctIds.size());
  Position position;
  for (position.Id = 0; position.Id < input->GetNumberOfPoints(); ++position.Id)
  {
    input->GetPoint(position.Id, position.X);
    if (std::isfinite(position.X[0]) && std::isfinite(position.X[1]) &&
      std::isfinite(position.X[2]))
    {
      positions.push_back(position);
    }
  }
  this->NumberOfNotFinite = input->GetNumberOfPoints() - static_cast<vtkIdType>(positions.size());

  // Each point is first given the lowest id of its twins, then these are numbered.
  vtkSMPTools::Sort(positions.begin(), positions.end());
  const Position* first = positions.data();
  for (const Position& p : positions)
  {
    if (!p.IsAt(*first))
    {
      first = &p;
    }
    this->DistinctIds[p.Id] = first->Id;
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType id = 0; id < input->GetNumberOfPoints(); ++id)
  {
    const vtkIdType twin = this->DistinctIds[id];
    if (twin == id)
    {
      this->DistinctIds[id] = points->InsertNextPoint(input->GetPoint(id));
    }
    else if (twin >= 0)
    {
      this->DistinctIds[id] = this->DistinctIds[twin];
    }
  }
  this->Cloud->SetPoints(points);
}
