// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGhostPointsGenerator.h"

#include "vtkAppendPolyData.h"
#include "vtkBoundingBox.h"
#include "vtkCommunicator.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkDoubleArray.h"
#include "vtkDrawablePoints.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSamplingDistance.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

vtkStandardNewMacro(vtkGhostPointsGenerator);
vtkCxxSetObjectMacro(vtkGhostPointsGenerator, Controller, vtkMultiProcessController);

namespace
{
constexpr int Tag = 7120;

using Piece = vtkSmartPointer<vtkPolyData>;
using Pieces = std::vector<Piece>; // of a rank, one a leaf; null where it has no points

bool IsFinite(const double x[3])
{
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

double Distance2(const vtkBoundingBox& box, const double x[3])
{
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double outside =
      std::max({ box.GetMinPoint()[axis] - x[axis], x[axis] - box.GetMaxPoint()[axis], 0.0 });
    sum += outside * outside;
  }
  return sum;
}

//------------------------------------------------------------------------------
// Trees and single pieces alike.
vtkSmartPointer<vtkDataObjectTreeIterator> IterateLeaves(vtkDataObjectTree* tree)
{
  vtkSmartPointer<vtkDataObjectTreeIterator> leaf;
  leaf.TakeReference(tree->NewTreeIterator());
  leaf->SkipEmptyNodesOff(); // a leaf may be empty here and not elsewhere
  leaf->InitTraversal();
  return leaf;
}

// A copy with arrays that tell of each point that it is this rank's own.
Piece Own(vtkDataObject* data, int rank)
{
  auto* piece = vtkPolyData::SafeDownCast(data);
  if (!piece || piece->GetNumberOfPoints() == 0)
  {
    return nullptr;
  }
  auto own = Piece::New();
  own->ShallowCopy(piece);
  vtkNew<vtkFieldData> fieldData; // of its own
  fieldData->ShallowCopy(piece->GetFieldData());
  own->SetFieldData(fieldData);
  const char* ghostType = vtkDataSetAttributes::GhostArrayName();
  auto* known = vtkUnsignedCharArray::SafeDownCast(own->GetPointData()->GetArray(ghostType));
  if (!known || known->GetNumberOfTuples() != piece->GetNumberOfPoints())
  {
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(ghostType);
    ghosts->SetNumberOfTuples(piece->GetNumberOfPoints());
    ghosts->Fill(0);
    own->GetPointData()->AddArray(ghosts);
  }
  vtkNew<vtkUnsignedIntArray> processes;
  processes->SetName("vtkProcessId");
  processes->SetNumberOfTuples(piece->GetNumberOfPoints());
  processes->Fill(rank);
  own->GetPointData()->AddArray(processes);
  return own;
}

Pieces OwnPieces(vtkDataObject* data, int rank)
{
  Pieces pieces;
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    for (auto leaf = IterateLeaves(tree); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      pieces.push_back(Own(leaf->GetCurrentDataObject(), rank));
    }
    return pieces;
  }
  return { Own(data, rank) };
}

void PutPieces(const Pieces& pieces, vtkDataObject* data)
{
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    auto piece = pieces.begin();
    for (auto leaf = IterateLeaves(tree); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      if (*piece)
      {
        tree->SetDataSetFrom(leaf, *piece);
      }
      ++piece;
    }
  }
  else if (pieces[0])
  {
    data->ShallowCopy(pieces[0]);
  }
}

//------------------------------------------------------------------------------
// The diagonal of the bounds of all ranks' points, by which radii are judged; 0 for none.
double GetDiagonal(const Pieces& pieces, vtkMultiProcessController* controller)
{
  vtkBoundingBox box;
  for (vtkPolyData* piece : pieces)
  {
    for (vtkIdType id = 0; piece && id < piece->GetNumberOfPoints(); ++id)
    {
      double x[3];
      piece->GetPoint(id, x);
      if (IsFinite(x))
      {
        box.AddPoint(x);
      }
    }
  }
  double lower[3], upper[3];
  controller->AllReduce(box.GetMinPoint(), lower, 3, vtkCommunicator::MIN_OP);
  controller->AllReduce(box.GetMaxPoint(), upper, 3, vtkCommunicator::MAX_OP);
  return lower[0] <= upper[0] ? std::sqrt(vtkMath::Distance2BetweenPoints(lower, upper)) : 0.0;
}

// The radius of a point as the mappers take it.
double GetRadius(const vtkDrawablePoints& drawable, vtkIdType id)
{
  vtkFloatArray* radii = drawable.GetRadii();
  return radii ? radii->GetValue(id) : drawable.GetLargestRadius();
}

// Where a rank has points, and what their radii are.
class Region
{
public:
  Region(const Pieces& pieces, const std::vector<vtkDrawablePoints>& drawable)
  {
    for (std::size_t leaf = 0; leaf < pieces.size(); ++leaf)
    {
      for (vtkIdType id = 0; pieces[leaf] && id < pieces[leaf]->GetNumberOfPoints(); ++id)
      {
        double x[3];
        pieces[leaf]->GetPoint(id, x);
        if (IsFinite(x))
        {
          this->Box.AddPoint(x);
        }
        const double r = GetRadius(drawable[leaf], id);
        if (r > 0.0) // else there are none, or all coordinates are faulty
        {
          this->Values[Sum] += r;
          this->Values[Count] += 1.0;
          this->Values[Largest] = std::max(this->Values[Largest], r);
        }
      }
    }
    this->Box.GetBounds(this->Values.data());
    this->Values[Leaves] = static_cast<double>(pieces.size());
  }

  const vtkBoundingBox& GetBox() const { return this->Box; }
  std::size_t GetNumberOfLeaves() const { return static_cast<std::size_t>(this->Values[Leaves]); }

  std::vector<Region> Gather(vtkMultiProcessController* controller) const
  {
    std::vector<double> all(NumberOfValues * controller->GetNumberOfProcesses());
    controller->AllGather(this->Values.data(), all.data(), NumberOfValues);
    std::vector<Region> regions;
    for (auto values = all.begin(); values != all.end(); values += NumberOfValues)
    {
      regions.emplace_back();
      std::copy_n(values, NumberOfValues, regions.back().Values.begin());
      regions.back().Box.SetBounds(regions.back().Values.data());
    }
    return regions;
  }

  // What mappers are told of the whole: bounds, the mean and the largest radius, sampling distance.
  static vtkSmartPointer<vtkDoubleArray> Join(
    const std::vector<Region>& regions, double samplingDistance)
  {
    Region joined;
    for (const Region& region : regions)
    {
      joined.Box.AddBox(region.Box);
      joined.Values[Sum] += region.Values[Sum];
      joined.Values[Count] += region.Values[Count];
      joined.Values[Largest] = std::max(joined.Values[Largest], region.Values[Largest]);
    }
    double bounds[6];
    joined.Box.GetBounds(bounds);
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName("vtkWholeCloud");
    for (const double bound : bounds)
    {
      array->InsertNextValue(bound);
    }
    // as vtkDrawablePoints: no radius is larger than the cloud
    const double diagonal = joined.Box.IsValid() ? joined.Box.GetDiagonalLength() : 0.0;
    const double limit = diagonal > 0.0 ? diagonal : VTK_FLOAT_MAX;
    const double mean = joined.Values[Sum] / std::max(joined.Values[Count], 1.0);
    array->InsertNextValue(std::min(mean, limit));
    array->InsertNextValue(std::min(joined.Values[Largest], limit));
    array->InsertNextValue(samplingDistance);
    return array;
  }

  Region() = default;

private:
  enum // in Values, behind the bounds
  {
    Sum = 6,
    Count,
    Largest,
    Leaves,
    NumberOfValues
  };
  vtkBoundingBox Box;
  std::array<double, NumberOfValues> Values{};
};

// Calls visit(id, x) for each point of a piece that is the rank's own and finite.
template <class Visit>
void VisitOwn(vtkPolyData* piece, const Visit& visit)
{
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
    piece->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  for (vtkIdType id = 0; id < piece->GetNumberOfPoints(); ++id)
  {
    double x[3];
    piece->GetPoint(id, x);
    if (!ghosts->GetValue(id) && IsFinite(x))
    {
      visit(id, x);
    }
  }
}

// Ids of a piece's points, in rising order, for each rank.
using Choice = std::vector<vtkSmartPointer<vtkIdList>>;

Choice ChooseNone(std::size_t ranks)
{
  Choice none(ranks);
  for (auto& ids : none)
  {
    ids = vtkSmartPointer<vtkIdList>::New();
  }
  return none;
}

// Whether a rank may need points of this one.
bool IsOther(const std::vector<Region>& regions, std::size_t other, int rank)
{
  return static_cast<int>(other) != rank && regions[other].GetBox().IsValid();
}

// The points of a piece that are within reach of each of the other ranks.
Choice FindNear(vtkPolyData* piece, const vtkDrawablePoints& drawable, double reach,
  const std::vector<Region>& regions, int rank)
{
  Choice near = ChooseNone(regions.size());
  VisitOwn(piece,
    [&](vtkIdType id, const double x[3])
    {
      const double distance = reach * GetRadius(drawable, id);
      for (std::size_t other = 0; other < regions.size(); ++other)
      {
        if (IsOther(regions, other, rank) &&
          Distance2(regions[other].GetBox(), x) <= distance * distance)
        {
          near[other]->InsertNextId(id);
        }
      }
    });
  return near;
}

// The share that each rank gets of what all others have beyond its reach.
std::vector<double> FindShares(const Pieces& pieces, const std::vector<Choice>& near,
  const std::vector<Region>& regions, vtkIdType limit, vtkMultiProcessController* controller)
{
  const int rank = controller->GetLocalProcessId();
  std::vector<double> beyond(regions.size(), 0.0);
  for (std::size_t leaf = 0; leaf < pieces.size(); ++leaf)
  {
    double own = 0.0;
    if (pieces[leaf])
    {
      VisitOwn(pieces[leaf], [&own](vtkIdType, const double*) { own += 1.0; });
    }
    for (std::size_t other = 0; pieces[leaf] && other < regions.size(); ++other)
    {
      beyond[other] += IsOther(regions, other, rank)
        ? own - static_cast<double>(near[leaf][other]->GetNumberOfIds())
        : 0.0;
    }
  }
  std::vector<double> shares(regions.size());
  controller->AllReduce(
    beyond.data(), shares.data(), static_cast<vtkIdType>(shares.size()), vtkCommunicator::SUM_OP);
  for (double& share : shares)
  {
    share = static_cast<double>(limit) / std::max(share, static_cast<double>(limit));
  }
  return shares;
}

// Shares of the other points of a piece, by chance.
Choice ChooseDistant(vtkPolyData* piece, const Choice& near, const std::vector<double>& shares,
  const std::vector<Region>& regions, int rank)
{
  Choice distant = ChooseNone(regions.size());
  std::vector<vtkIdType> next(regions.size(), 0); // of those near to each rank
  vtkNew<vtkMinimalStandardRandomSequence> lots;
  lots->Initialize(rank + 1);
  VisitOwn(piece,
    [&](vtkIdType id, const double*)
    {
      lots->Next();
      const double lot = lots->GetValue();
      for (std::size_t other = 0; other < regions.size(); ++other)
      {
        vtkIdType& place = next[other];
        if (place < near[other]->GetNumberOfIds() && near[other]->GetId(place) == id)
        {
          ++place;
        }
        else if (IsOther(regions, other, rank) && lot < shares[other])
        {
          distant[other]->InsertNextId(id);
        }
      }
    });
  return distant;
}

Piece Extract(vtkPolyData* piece, vtkIdList* ids)
{
  auto part = Piece::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(piece->GetPoints()->GetDataType());
  piece->GetPoints()->GetPoints(ids, points);
  part->SetPoints(points);
  vtkPointData* data = part->GetPointData();
  data->CopyAllOn();
  data->CopyAllocate(piece->GetPointData(), ids->GetNumberOfIds());
  vtkNew<vtkIdList> places;
  places->SetNumberOfIds(ids->GetNumberOfIds());
  std::iota(places->begin(), places->end(), 0);
  data->CopyData(piece->GetPointData(), ids, places);
  vtkUnsignedCharArray::SafeDownCast(data->GetArray(vtkDataSetAttributes::GhostArrayName()))
    ->Fill(vtkDataSetAttributes::DUPLICATEPOINT);
  return part;
}

// What a rank has to send or gets: how many points of each leaf, by rank and leaf.
class Counts
{
public:
  Counts(int ranks, std::size_t leaves)
    : Leaves(leaves)
    , Values(ranks * leaves, 0)
  {
  }
  vtkIdType& At(int rank, std::size_t leaf) { return this->Values[rank * this->Leaves + leaf]; }

  // What the others have for this rank, by rank and leaf.
  Counts Exchange(vtkMultiProcessController* controller) const
  {
    const auto ranks = static_cast<std::size_t>(controller->GetNumberOfProcesses());
    std::vector<vtkIdType> all(ranks * this->Values.size());
    controller->AllGather(
      this->Values.data(), all.data(), static_cast<vtkIdType>(this->Values.size()));
    Counts received(static_cast<int>(ranks), this->Leaves);
    for (std::size_t from = 0; from < ranks; ++from)
    {
      const auto first =
        all.begin() + (from * ranks + controller->GetLocalProcessId()) * this->Leaves;
      std::copy(first, first + this->Leaves, received.Values.begin() + from * this->Leaves);
    }
    return received;
  }

private:
  std::size_t Leaves;
  std::vector<vtkIdType> Values;
};

// Sends parts to a rank, or receives parts from it.
void SendParts(vtkMultiProcessController* controller, int to, const Pieces& parts)
{
  for (vtkPolyData* part : parts)
  {
    if (part)
    {
      controller->Send(part, to, Tag);
    }
  }
}

void ReceiveParts(
  vtkMultiProcessController* controller, int from, Counts& counts, std::vector<Pieces>& parts)
{
  for (std::size_t leaf = 0; leaf < parts.size(); ++leaf)
  {
    if (counts.At(from, leaf) > 0)
    {
      auto part = Piece::New();
      controller->Receive(part, from, Tag);
      parts[leaf].push_back(part);
    }
  }
}

// Sends each rank copies of what was chosen for it, and receives those for this rank, by leaf.
std::vector<Pieces> Exchange(
  const Pieces& pieces, const std::vector<Choice>& chosen, vtkMultiProcessController* controller)
{
  const int rank = controller->GetLocalProcessId();
  const int ranks = controller->GetNumberOfProcesses();
  const std::size_t leaves = pieces.size();
  std::vector<Pieces> toSend(ranks, Pieces(leaves));
  Counts sent(ranks, leaves);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf)
  {
    for (int other = 0; pieces[leaf] && other < ranks; ++other)
    {
      vtkIdList* ids = chosen[leaf][other];
      sent.At(other, leaf) = ids->GetNumberOfIds();
      if (ids->GetNumberOfIds() > 0)
      {
        toSend[other][leaf] = Extract(pieces[leaf], ids);
      }
    }
  }
  Counts received = sent.Exchange(controller);
  // Pairs of ranks in one order on all of them, so that no rank waits for one that waits for it.
  std::vector<Pieces> parts(leaves);
  for (int other = 0; other < ranks; ++other)
  {
    if (rank < other)
    {
      SendParts(controller, other, toSend[other]);
    }
    if (rank != other)
    {
      ReceiveParts(controller, other, received, parts);
    }
    if (rank > other)
    {
      SendParts(controller, other, toSend[other]);
    }
  }
  return parts;
}

// The points that count of a rank's own, and then the copies.
class Neighborhood
{
public:
  Neighborhood(const Pieces& pieces, const std::vector<vtkDrawablePoints>& drawable,
    const std::vector<Pieces>& ghosts)
  {
    this->Points->SetDataTypeToDouble();
    for (std::size_t leaf = 0; leaf < pieces.size(); ++leaf)
    {
      const std::vector<unsigned int>& ids = drawable[leaf].GetDrawnIds();
      for (vtkIdType i = 0; i < drawable[leaf].GetNumberOfDrawnPoints(); ++i)
      {
        this->Points->InsertNextPoint(pieces[leaf]->GetPoint(ids.empty() ? i : ids[i]));
      }
    }
    this->Own = this->Points->GetNumberOfPoints();
    for (const Pieces& parts : ghosts)
    {
      for (vtkPolyData* part : parts)
      {
        const vtkIdType first = this->Points->GetNumberOfPoints();
        this->Points->InsertPoints(first, part->GetNumberOfPoints(), 0, part->GetPoints());
      }
    }
  }
  vtkPoints* GetPoints() const { return this->Points; }
  vtkIdType GetOwn() const { return this->Own; }

private:
  vtkNew<vtkPoints> Points;
  vtkIdType Own = 0;
};

// That of all ranks' points, the same on all of them.
double FindSamplingDistance(const Neighborhood& neighborhood, double quantile,
  vtkMultiProcessController* controller, vtkAlgorithm* caller)
{
  vtkNew<vtkDoubleArray> own;
  for (const vtkNeighborDistance& asked :
    vtkSampleNeighborDistances(neighborhood.GetPoints(), neighborhood.GetOwn(), quantile, caller))
  {
    own->InsertNextValue(asked.Lot);
    own->InsertNextValue(asked.Distance);
  }
  vtkNew<vtkDoubleArray> all;
  controller->AllGatherV(own, all);
  std::vector<vtkNeighborDistance> distances;
  for (vtkIdType i = 0; i < all->GetNumberOfValues(); i += 2)
  {
    distances.push_back({ all->GetValue(i), all->GetValue(i + 1) });
  }
  return vtkSamplingDistance(distances, quantile);
}

Piece Append(vtkPolyData* own, const Pieces& parts)
{
  vtkNew<vtkAppendPolyData> append;
  if (own)
  {
    append->AddInputData(own);
  }
  for (vtkPolyData* part : parts)
  {
    append->AddInputData(part);
  }
  append->Update();
  Piece all = append->GetOutput();
  if (own)
  {
    all->GetFieldData()->ShallowCopy(own->GetFieldData());
  }
  return all;
}
} // anonymous namespace

//------------------------------------------------------------------------------
vtkGhostPointsGenerator::vtkGhostPointsGenerator()
{
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

//------------------------------------------------------------------------------
vtkGhostPointsGenerator::~vtkGhostPointsGenerator()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
int vtkGhostPointsGenerator::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObjectTree");
  return 1;
}

//------------------------------------------------------------------------------
void vtkGhostPointsGenerator::LeaveOutUnfit(vtkPointData* data, vtkIdType points)
{
  for (int i = data->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (array->GetNumberOfTuples() != points)
    {
      const std::string name = array->GetName() ? array->GetName() : "(no name)";
      vtkWarningMacro("Point array '" << name << "' has " << array->GetNumberOfTuples()
                                      << " values for " << points
                                      << " points; it is left out. Give one value for each point.");
      data->RemoveArray(i);
    }
  }
}

//------------------------------------------------------------------------------
int vtkGhostPointsGenerator::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputVector);
  output->ShallowCopy(input);
  this->NumberOfGhostPoints = 0;
  const int ranks = this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
  if (ranks < 2)
  {
    return 1;
  }

  const int rank = this->Controller->GetLocalProcessId();
  Pieces pieces = OwnPieces(input, rank);
  const std::size_t leaves = pieces.size();
  std::vector<vtkDrawablePoints> drawable(leaves); // whose remarks the mappers make
  vtkDrawablePoints::Needs needs;
  needs.Normals = needs.SpatialOrder = false;
  const double diagonal = GetDiagonal(pieces, this->Controller);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf)
  {
    if (pieces[leaf])
    {
      this->LeaveOutUnfit(pieces[leaf]->GetPointData(), pieces[leaf]->GetNumberOfPoints());
      drawable[leaf].Build(
        pieces[leaf], { 0 }, needs, { this->RadiusArray, this->Radius, -1.0, 0.0, diagonal }, this);
    }
  }
  this->UpdateProgress(0.2);

  // What all ranks have to know of each other.
  const Region own(pieces, drawable);
  const std::vector<Region> regions = own.Gather(this->Controller);
  for (int other = 0; other < ranks; ++other)
  {
    if (regions[other].GetNumberOfLeaves() != leaves)
    {
      vtkErrorMacro("The trees of rank " << rank << " and rank " << other << " have " << leaves
                                         << " and " << regions[other].GetNumberOfLeaves()
                                         << " leaves; no points are exchanged. Give all ranks the "
                                            "same tree, with empty leaves.");
      return 1; // as all ranks do
    }
  }

  std::vector<Choice> near(leaves); // what goes to which rank
  for (std::size_t leaf = 0; leaf < leaves; ++leaf)
  {
    if (pieces[leaf])
    {
      near[leaf] = FindNear(pieces[leaf], drawable[leaf], this->Reach, regions, rank);
    }
  }
  this->UpdateProgress(0.4);
  std::vector<Pieces> ghosts = Exchange(pieces, near, this->Controller);
  this->UpdateProgress(0.6);

  double samplingDistance = 0.0;
  if (this->SamplingQuantile >= 0.0 && this->Radius <= 0.0)
  {
    this->SetProgressShiftScale(0.6, 0.2);
    samplingDistance = FindSamplingDistance(
      { pieces, drawable, ghosts }, this->SamplingQuantile, this->Controller, this);
    this->SetProgressShiftScale(0.0, 1.0);
  }
  if (this->DistantPoints > 0)
  {
    const auto shares = FindShares(pieces, near, regions, this->DistantPoints, this->Controller);
    std::vector<Choice> distant(leaves);
    for (std::size_t leaf = 0; leaf < leaves; ++leaf)
    {
      if (pieces[leaf])
      {
        distant[leaf] = ChooseDistant(pieces[leaf], near[leaf], shares, regions, rank);
      }
    }
    const std::vector<Pieces> parts = Exchange(pieces, distant, this->Controller);
    for (std::size_t leaf = 0; leaf < leaves; ++leaf)
    {
      ghosts[leaf].insert(ghosts[leaf].end(), parts[leaf].begin(), parts[leaf].end());
    }
  }
  const vtkSmartPointer<vtkDoubleArray> whole = Region::Join(regions, samplingDistance);
  for (std::size_t leaf = 0; leaf < leaves; ++leaf)
  {
    for (vtkPolyData* part : ghosts[leaf])
    {
      this->NumberOfGhostPoints += part->GetNumberOfPoints();
    }
    if (!ghosts[leaf].empty())
    {
      pieces[leaf] = Append(pieces[leaf], ghosts[leaf]);
    }
    if (pieces[leaf])
    {
      pieces[leaf]->GetFieldData()->AddArray(whole);
    }
  }
  PutPieces(pieces, output);
  return 1;
}

//------------------------------------------------------------------------------
void vtkGhostPointsGenerator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "Reach: " << this->Reach << "\n";
  os << indent << "RadiusArray: " << (this->RadiusArray.empty() ? "(none)" : this->RadiusArray)
     << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "SamplingQuantile: " << this->SamplingQuantile << "\n";
  os << indent << "DistantPoints: " << this->DistantPoints << "\n";
  os << indent << "NumberOfGhostPoints: " << this->NumberOfGhostPoints << "\n";
}
