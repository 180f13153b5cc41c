// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAlgebraicSplats.h"

#include "vtkAlgebraicSplat.h"
#include "vtkDistinctPoints.h"
#include "vtkLocallyOptimalProjection.h"
#include "vtkMovingLeastSquares.h"
#include "vtkPointNormals.h"
#include "vtkProgressFor.h"
#include "vtkProgressRelay.h"
#include "vtkRandomOrder.h"

#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPThreadLocalObject.h"
#include "vtkStaticPointLocator.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkAlgebraicSplats);

namespace
{
using Vector = vtkMovingLeastSquares::Vector;

/// Candidates that are fitted at once before the first of them discards others.
constexpr vtkIdType BatchSize = 2048;
/// Splats whose distances tell the feature size of a fixed count.
constexpr int NumberOfNearestSplats = 8;
/// What a fixed count is fitted to lies within this many feature sizes.
constexpr double SupportOfFixedCount = 2.0;
/// A point's normal tells its side only if this share of its neighbours agree, itself among them.
constexpr double LeastShareOfSide = 1.0 / 8.0;
/// And no fewer than these, which a plane takes.
constexpr vtkIdType LeastNumberOfSide = 3;
/// Where neighbours reach less far to one side than this share of how far they reach to the other,
/// there is a border.
constexpr double LargestShareAtBorder = 0.7;
/// What lies between the points is no farther from one of them than this share of their spacing.
constexpr double LargestGap = 0.75;
/// No fewer neighbours of a point at a border are left than these.
constexpr size_t LeastNumberAtBorders = 16;
/// What points are off a line by rounding is less than so many steps of their coordinates.
constexpr double StepsOfRounding = 4.0;

Vector GetPoint(vtkPointSet* cloud, vtkIdType id)
{
  Vector x;
  cloud->GetPoint(id, x.data());
  return x;
}

Vector Subtract(const Vector& a, const Vector& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double Dot(const Vector& a, const Vector& b)
{
  return vtkMath::Dot(a.data(), b.data());
}

/// What the largest coordinate may be off in the points' own precision, which `cloud` is a copy of.
double GetRounding(vtkPoints* points, vtkPolyData* cloud)
{
  double largest = 0.0;
  for (int i = 0; i < 6; ++i)
  {
    largest = std::max(largest, std::abs(cloud->GetBounds()[i]));
  }
  const bool single = points->GetDataType() == VTK_FLOAT;
  return StepsOfRounding * largest *
    (single ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon());
}

vtkSmartPointer<vtkFloatArray> AddFloats(
  vtkPolyData* output, const char* name, int components, vtkIdType count)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  output->GetPointData()->AddArray(array);
  return array;
}
}

/// One run of the filter: the cloud as it is searched, and the splats as they come.
class vtkAlgebraicSplats::Worker
{
public:
  Worker(vtkAlgebraicSplats* filter, vtkPointSet* input)
    : Filter(filter)
    , Input(input)
    , Distinct(input)
  {
  }

  /// Fits the splats; false when aborted.
  bool Run()
  {
    if (this->Distinct.GetNumberOfPoints() == 0)
    {
      return true;
    }
    return this->Prepare() &&
      (this->Filter->Selection == FIXED_COUNT ? this->FitFixedCount() : this->FitInput());
  }

  vtkIdType GetNumberOfNotFinite() const { return this->Distinct.GetNumberOfNotFinite(); }
  vtkIdType GetNumberOfSplats() const { return static_cast<vtkIdType>(this->Splats.size()); }
  vtkIdType GetNumberOfRankDeficient() const
  {
    return std::count_if(this->Splats.begin(), this->Splats.end(),
      [](const vtkAlgebraicSplat& splat) { return splat.RankDeficient; });
  }

  void WriteSplats(vtkPolyData* output) const;
  bool WriteErrors(vtkPolyData* output, double& total);

private:
  bool Prepare();
  bool FitInput();
  bool FitFixedCount();
  vtkAlgebraicSplat FitAt(const Vector& center, const Vector& normal, double featureSize) const;
  Vector FindSide(const Vector& center, const Vector& normal, vtkIdList* neighbors) const;
  Vector GetShiftFromBorder(
    const std::vector<Vector>& neighbors, const vtkAlgebraicSplat& splat) const;
  bool IsOnSameSide(const Vector& a, const Vector& b) const
  {
    return !this->Filter->RejectOppositeNormals || Dot(a, b) >= 0.0;
  }
  Vector GetNormal(vtkIdType id) const // zero where none is known
  {
    const float* n = this->Normals->GetPointer(3 * id);
    return { n[0], n[1], n[2] };
  }
  vtkAlgebraicSplat Fit(vtkMovingLeastSquares& fitter, const Vector& center, const Vector& side,
    double featureSize) const;

  vtkAlgebraicSplats* Filter;
  vtkPointSet* Input;
  vtkDistinctPoints Distinct;
  std::vector<vtkIdType> InputIds; // of the distinct points
  vtkNew<vtkPolyData> Cloud;       // what splats are fitted to
  vtkNew<vtkFloatArray> Normals;   // of the cloud
  double Rounding = 0.0;           // of the cloud's coordinates
  vtkNew<vtkStaticPointLocator> Locator;
  mutable vtkSMPThreadLocal<vtkMovingLeastSquares> Fitters;
  mutable vtkSMPThreadLocalObject<vtkIdList> Lists;
  std::vector<vtkAlgebraicSplat> Splats;
  std::vector<vtkIdType> Centers; // ids in the input
};

//------------------------------------------------------------------------------
bool vtkAlgebraicSplats::Worker::Prepare()
{
  const vtkIdType count = this->Distinct.GetNumberOfPoints();
  this->InputIds.assign(count, -1);
  for (vtkIdType id = this->Input->GetNumberOfPoints() - 1; id >= 0; --id)
  {
    if (this->Distinct.GetDistinctId(id) >= 0)
    {
      this->InputIds[this->Distinct.GetDistinctId(id)] = id;
    }
  }
  this->Cloud->ShallowCopy(this->Distinct.GetCloud());
  this->Rounding = GetRounding(this->Input->GetPoints(), this->Cloud);

  vtkSmartPointer<vtkDataArray> normals = this->Input->GetPointData()->GetNormals();
  const bool given = normals != nullptr;
  if (!given)
  {
    vtkNew<vtkPointNormals> estimation;
    vtkNew<vtkProgressRelay> relay;
    relay->Set(this->Filter, 0.0, 0.2);
    estimation->AddObserver(vtkCommand::ProgressEvent, relay);
    estimation->SetInputData(this->Cloud);
    estimation->Update();
    normals = vtkPolyData::SafeDownCast(estimation->GetOutput())->GetPointData()->GetNormals();
    if (!normals || this->Filter->GetAbortExecute())
    {
      return false;
    }
  }
  this->Normals->SetNumberOfComponents(3);
  this->Normals->SetNumberOfTuples(count);
  for (vtkIdType id = 0; id < count; ++id)
  {
    double n[3];
    normals->GetTuple(given ? this->InputIds[id] : id, n);
    const bool known = std::isfinite(n[0]) && std::isfinite(n[1]) && std::isfinite(n[2]);
    this->Normals->SetTuple3(id, known ? n[0] : 0.0, known ? n[1] : 0.0, known ? n[2] : 0.0);
  }
  this->Locator->SetDataSet(this->Cloud);
  this->Locator->BuildLocator();
  this->Filter->UpdateProgress(0.2);
  return !this->Filter->GetAbortExecute();
}

// The disc covers what the splat stands for and the gaps between these points and the next ones.
vtkAlgebraicSplat vtkAlgebraicSplats::Worker::Fit(
  vtkMovingLeastSquares& fitter, const Vector& center, const Vector& side, double featureSize) const
{
  const double overlapping = this->Filter->Overlap * this->Filter->Quality;
  double radius = overlapping;
  if (this->Filter->Selection == HOLE_FREE && this->Filter->Overlap > 1.0)
  {
    // of points spread evenly over a disc, whose mean distance from its centre is 1; those on the
    // other side are not among them
    const double spacing =
      1.5 * std::sqrt(vtkMath::Pi() / std::max<size_t>(fitter.Neighbors.size(), 1));
    radius = std::max(radius, this->Filter->Quality + LargestGap * spacing);
  }
  fitter.LimitedShare = overlapping / radius;
  return fitter.Fit(center, side, featureSize, radius);
}

vtkAlgebraicSplat vtkAlgebraicSplats::Worker::FitAt(
  const Vector& center, const Vector& normal, double featureSize) const
{
  vtkMovingLeastSquares& fitter = this->Fitters.Local();
  vtkIdList* ids = this->Lists.Local();
  fitter.Order = this->Filter->Order;
  fitter.Tolerance = this->Filter->Tolerance;
  fitter.ExtrapolationLimit = this->Filter->ExtrapolationLimit;
  fitter.Rounding = this->Rounding;
  if (featureSize > 0.0)
  {
    this->Locator->FindPointsWithinRadius(SupportOfFixedCount * featureSize, center.data(), ids);
  }
  if (featureSize == 0.0 || ids->GetNumberOfIds() < this->Filter->NumberOfNeighbors)
  {
    this->Locator->FindClosestNPoints(this->Filter->NumberOfNeighbors, center.data(), ids);
  }
  // in one order, whatever the search's is: sums of floating point numbers depend on it
  std::sort(ids->begin(), ids->end());
  const Vector side = this->FindSide(center, normal, ids);
  fitter.Neighbors.clear();
  for (vtkIdType id : *ids)
  {
    if (this->IsOnSameSide(side, this->GetNormal(id)))
    {
      fitter.Neighbors.push_back(Subtract(GetPoint(this->Cloud, id), center));
    }
  }
  vtkAlgebraicSplat splat = this->Fit(fitter, center, side, featureSize);
  // at a border or on a tip, a smaller disc is less far over it
  while (
    featureSize == 0.0 && splat.Extrapolates && fitter.Neighbors.size() >= 2 * LeastNumberAtBorders)
  {
    std::sort(fitter.Neighbors.begin(), fitter.Neighbors.end(),
      [](const Vector& a, const Vector& b) { return Dot(a, a) < Dot(b, b); });
    fitter.Neighbors.resize(fitter.Neighbors.size() / 2);
    splat = this->Fit(fitter, center, side, featureSize);
  }
  const Vector shift = featureSize == 0.0 && this->Filter->ExtrapolationLimit > 0.0
    ? this->GetShiftFromBorder(fitter.Neighbors, splat)
    : Vector{};
  if (Dot(shift, shift) > 0.0)
  {
    for (Vector& neighbor : fitter.Neighbors)
    {
      neighbor = Subtract(neighbor, shift);
    }
    splat = this->Fit(
      fitter, Subtract(center, { -shift[0], -shift[1], -shift[2] }), side, splat.FeatureSize);
  }
  return splat;
}

// Where a border is nearer than what the splat stands for reaches, its disc, which is larger, can
// move away from it until it just covers that: then it is less far over the border.
Vector vtkAlgebraicSplats::Worker::GetShiftFromBorder(
  const std::vector<Vector>& neighbors, const vtkAlgebraicSplat& splat) const
{
  Vector inward = {}; // to the middle of the neighbours, within the plane
  for (const Vector& p : neighbors)
  {
    const double u = Dot(p, splat.U) / neighbors.size();
    const double v = Dot(p, splat.V) / neighbors.size();
    for (int k = 0; k < 3; ++k)
    {
      inward[k] += u * splat.U[k] + v * splat.V[k];
    }
  }
  vtkMath::Normalize(inward.data());
  double border = 0.0; // its distance, if the neighbours end there and not as there are no more
  double end = 0.0;    // and that of theirs on the other side
  for (const Vector& p : neighbors)
  {
    border = std::max(border, -Dot(p, inward));
    end = std::max(end, Dot(p, inward));
  }
  const double reach = this->Filter->Quality * splat.FeatureSize;
  if (!(border < std::min(reach, LargestShareAtBorder * end)))
  {
    return {};
  }
  // the points of the border at a distance of `reach` come to lie on the disc's rim
  const double moved =
    std::sqrt(border * border + splat.Radius * splat.Radius - reach * reach) - border;
  return { moved * inward[0], moved * inward[1], moved * inward[2] };
}

// The normal itself, or, where nearly all neighbours contradict it, that of the nearest one that
// they do not contradict: a lone wrong normal would leave its point without neighbours. Zero, which
// is any side, where there is none.
Vector vtkAlgebraicSplats::Worker::FindSide(
  const Vector& center, const Vector& normal, vtkIdList* neighbors) const
{
  const vtkIdType least = std::max(
    LeastNumberOfSide, static_cast<vtkIdType>(LeastShareOfSide * neighbors->GetNumberOfIds()));
  auto isShared = [&](const Vector& side)
  {
    return std::count_if(neighbors->begin(), neighbors->end(),
             [&](vtkIdType id) { return this->IsOnSameSide(side, this->GetNormal(id)); }) >= least;
  };
  if (isShared(normal))
  {
    return normal;
  }
  std::vector<std::pair<double, vtkIdType>> nearest;
  for (vtkIdType id : *neighbors)
  {
    const Vector d = Subtract(GetPoint(this->Cloud, id), center);
    nearest.emplace_back(Dot(d, d), id);
  }
  std::sort(nearest.begin(), nearest.end());
  for (const auto& neighbor : nearest)
  {
    if (isShared(this->GetNormal(neighbor.second)))
    {
      return this->GetNormal(neighbor.second);
    }
  }
  return {};
}

//------------------------------------------------------------------------------
// At all points, or at those that no chosen one before them stands for. Many are fitted at once,
// and some of these for nothing, as they are then discarded: so the result is that of one at a
// time.
bool vtkAlgebraicSplats::Worker::FitInput()
{
  const vtkIdType count = this->Cloud->GetNumberOfPoints();
  const bool holeFree = this->Filter->Selection == HOLE_FREE;
  std::vector<vtkIdType> order(count);
  for (vtkIdType id = 0; id < count; ++id)
  {
    order[id] = id;
  }
  if (holeFree)
  {
    vtkRandomOrder(order, count, this->Filter->Seed);
  }

  std::vector<char> discarded(count, 0);
  std::vector<vtkIdType> candidates;
  std::vector<vtkAlgebraicSplat> splats;
  vtkNew<vtkIdList> around;
  vtkIdType next = 0;
  while (next < count && !this->Filter->GetAbortExecute())
  {
    candidates.clear();
    for (; next < count && static_cast<vtkIdType>(candidates.size()) < BatchSize; ++next)
    {
      if (!discarded[order[next]])
      {
        candidates.push_back(order[next]);
      }
    }
    splats.resize(candidates.size());
    vtkSMPTools::For(0, static_cast<vtkIdType>(candidates.size()), 16,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const vtkIdType id = candidates[i];
          splats[i] = this->FitAt(GetPoint(this->Cloud, id), this->GetNormal(id), 0.0);
        }
      });
    for (size_t i = 0; i < candidates.size(); ++i)
    {
      const vtkIdType center = candidates[i];
      if (discarded[center])
      {
        continue;
      }
      this->Splats.push_back(splats[i]);
      this->Centers.push_back(this->InputIds[center]);
      if (holeFree)
      {
        this->Locator->FindPointsWithinRadius(this->Filter->Quality * splats[i].FeatureSize,
          GetPoint(this->Cloud, center).data(), around);
        for (vtkIdType id : *around)
        {
          discarded[id] |= this->IsOnSameSide(splats[i].Normal, this->GetNormal(id)) ? 1 : 0;
        }
      }
    }
    this->Filter->UpdateProgress(0.2 + 0.7 * next / count);
  }
  return !this->Filter->GetAbortExecute();
}

//------------------------------------------------------------------------------
bool vtkAlgebraicSplats::Worker::FitFixedCount()
{
  vtkNew<vtkLocallyOptimalProjection> projection;
  vtkNew<vtkProgressRelay> relay;
  relay->Set(this->Filter, 0.2, 0.7);
  projection->AddObserver(vtkCommand::ProgressEvent, relay);
  projection->SetInputData(this->Cloud);
  projection->SetNumberOfPoints(this->Filter->NumberOfSplats);
  projection->SetSeed(this->Filter->Seed);
  projection->Update();
  if (this->Filter->GetAbortExecute())
  {
    return false;
  }
  vtkPolyData* decimated = projection->GetOutput();
  const vtkIdType count = decimated->GetNumberOfPoints();
  auto* nearest =
    vtkIdTypeArray::SafeDownCast(decimated->GetPointData()->GetArray("InputPointIds"));

  // splats are fitted to the input and the decimated set together
  vtkNew<vtkPoints> all;
  all->SetDataTypeToDouble();
  all->DeepCopy(this->Cloud->GetPoints());
  for (vtkIdType i = 0; i < count; ++i)
  {
    all->InsertNextPoint(decimated->GetPoint(i));
    this->Normals->InsertNextTuple(this->GetNormal(nearest->GetValue(i)).data());
  }
  this->Cloud->SetPoints(all);
  this->Locator->Modified();
  this->Locator->BuildLocator();
  vtkNew<vtkStaticPointLocator> decimatedLocator;
  decimatedLocator->SetDataSet(decimated);
  decimatedLocator->BuildLocator();

  this->Splats.resize(count);
  this->Centers.resize(count);
  return vtkProgressFor(this->Filter, count, BatchSize, 0.7, 0.9,
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkIdList* ids = this->Lists.Local();
      for (vtkIdType i = begin; i < end; ++i)
      {
        const Vector center = GetPoint(decimated, i);
        const Vector normal = this->GetNormal(nearest->GetValue(i));
        decimatedLocator->FindClosestNPoints(NumberOfNearestSplats + 1, center.data(), ids);
        double sum = 0.0;
        for (vtkIdType id : *ids)
        {
          const Vector d = Subtract(GetPoint(decimated, id), center);
          const double height = Dot(d, normal);
          sum += std::sqrt(std::max(Dot(d, d) - height * height, 0.0));
        }
        const double featureSize = sum / std::max<vtkIdType>(ids->GetNumberOfIds() - 1, 1);
        this->Splats[i] = this->FitAt(center, normal, featureSize);
        this->Centers[i] = this->InputIds[nearest->GetValue(i)];
      }
    });
}

//------------------------------------------------------------------------------
void vtkAlgebraicSplats::Worker::WriteSplats(vtkPolyData* output) const
{
  const vtkIdType count = this->GetNumberOfSplats();
  vtkNew<vtkPoints> points;
  points->SetDataType(
    this->Input->GetPoints() ? this->Input->GetPoints()->GetDataType() : VTK_FLOAT);
  points->SetNumberOfPoints(count);
  output->SetPoints(points);

  vtkPointData* from = this->Input->GetPointData();
  output->GetPointData()->CopyNormalsOff();
  output->GetPointData()->CopyAllocate(from, count);
  int order = 1;
  for (vtkIdType i = 0; i < count; ++i)
  {
    output->GetPointData()->CopyData(from, this->Centers[i], i);
    order = std::max(order, this->Splats[i].Order);
  }
  const int coefficients = vtkAlgebraicSplat::GetNumberOfCoefficients(order);
  auto normals = AddFloats(output, "Normals", 3, count);
  output->GetPointData()->SetNormals(normals);
  auto axes = AddFloats(output, "SplatAxes", 3, count);
  auto radii = AddFloats(output, "radius", 1, count);
  auto polynomials = AddFloats(output, "SplatCoefficients", coefficients, count);
  auto sizes = AddFloats(output, "FeatureSize", 1, count);
  auto residuals = AddFloats(output, "Residual", 1, count);
  vtkNew<vtkUnsignedCharArray> orders;
  orders->SetName("SplatOrder");
  orders->SetNumberOfTuples(count);
  output->GetPointData()->AddArray(orders);
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("InputPointIds");
  ids->SetNumberOfTuples(count);
  output->GetPointData()->AddArray(ids);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const vtkAlgebraicSplat& splat = this->Splats[i];
    points->SetPoint(i, splat.Origin.data());
    normals->SetTuple(i, splat.Normal.data());
    axes->SetTuple(i, splat.U.data());
    radii->SetValue(i, static_cast<float>(splat.Radius));
    polynomials->SetTuple(i, splat.Coefficients.data());
    sizes->SetValue(i, static_cast<float>(splat.FeatureSize));
    residuals->SetValue(i, static_cast<float>(splat.Residual));
    orders->SetValue(i, static_cast<unsigned char>(splat.Order));
    ids->SetValue(i, this->Centers[i]);
  }
}

// Equation 3: found splat by splat in threads, summed in the order of the splats.
bool vtkAlgebraicSplats::Worker::WriteErrors(vtkPolyData* output, double& total)
{
  const vtkIdType count = this->GetNumberOfSplats();
  std::vector<double> errors(this->Distinct.GetNumberOfPoints(), 0.0);
  std::vector<std::vector<std::pair<vtkIdType, double>>> found;
  for (vtkIdType first = 0; first < count; first += BatchSize)
  {
    if (this->Filter->GetAbortExecute())
    {
      return false;
    }
    const vtkIdType last = std::min(count, first + BatchSize);
    found.assign(last - first, {});
    vtkSMPTools::For(first, last, 16,
      [&](vtkIdType begin, vtkIdType end)
      {
        vtkIdList* ids = this->Lists.Local();
        for (vtkIdType i = begin; i < end; ++i)
        {
          const vtkAlgebraicSplat& splat = this->Splats[i];
          this->Locator->FindPointsWithinRadius(splat.Radius, splat.Origin.data(), ids);
          for (vtkIdType id : *ids)
          {
            if (id >= this->Distinct.GetNumberOfPoints() ||
              !this->IsOnSameSide(splat.Normal, this->GetNormal(id)))
            {
              continue;
            }
            const Vector d = Subtract(GetPoint(this->Cloud, id), splat.Origin);
            const double height = splat.Radius *
              vtkAlgebraicSplat::Evaluate(splat.Coefficients.data(), splat.Order,
                Dot(d, splat.U) / splat.Radius, Dot(d, splat.V) / splat.Radius);
            const double weight = std::exp(-Dot(d, d) / (splat.FeatureSize * splat.FeatureSize));
            found[i - first].emplace_back(id, weight * std::abs(Dot(d, splat.Normal) - height));
          }
        }
      });
    for (const auto& ofSplat : found)
    {
      for (const auto& error : ofSplat)
      {
        errors[error.first] += error.second;
      }
    }
    this->Filter->UpdateProgress(0.9 + 0.1 * last / count);
  }

  const vtkIdType points = this->Input->GetNumberOfPoints();
  auto array = AddFloats(output, "ApproximationError", 1, points);
  total = 0.0;
  for (vtkIdType id = 0; id < points; ++id)
  {
    const vtkIdType distinct = this->Distinct.GetDistinctId(id);
    const double error = distinct < 0 ? 0.0 : errors[distinct];
    array->SetValue(id, static_cast<float>(error));
    total += error;
  }
  return true;
}

//------------------------------------------------------------------------------
vtkAlgebraicSplats::vtkAlgebraicSplats()
{
  this->SetNumberOfOutputPorts(2);
}

int vtkAlgebraicSplats::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

int vtkAlgebraicSplats::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  vtkPolyData* errors = vtkPolyData::GetData(outputVector, 1);
  errors->SetPoints(input->GetPoints());
  errors->GetPointData()->ShallowCopy(input->GetPointData());
  this->TotalError = 0.0;

  vtkDataArray* normals = input->GetPointData()->GetNormals();
  if (normals && normals->GetNumberOfTuples() != input->GetNumberOfPoints())
  {
    vtkErrorMacro(<< "Array '" << (normals->GetName() ? normals->GetName() : "(no name)")
                  << "' has " << normals->GetNumberOfTuples() << " normals for "
                  << input->GetNumberOfPoints()
                  << " points. Give one for each point, or none to have them estimated.");
    return 1;
  }
  Worker worker(this, input);
  if (worker.GetNumberOfNotFinite() > 0)
  {
    vtkWarningMacro(<< worker.GetNumberOfNotFinite() << " of " << input->GetNumberOfPoints()
                    << " points have NaN or infinite coordinates; they are left out.");
  }
  if (!worker.Run() || (this->ComputeErrors && !worker.WriteErrors(errors, this->TotalError)))
  {
    return 1;
  }
  if (worker.GetNumberOfRankDeficient() > 0)
  {
    vtkWarningMacro(<< worker.GetNumberOfRankDeficient() << " of " << worker.GetNumberOfSplats()
                    << " splats have a lower order than " << this->Order
                    << ", since their neighbours do not determine more (they are too few, or lie "
                       "on lines); raise NumberOfNeighbors, which is "
                    << this->NumberOfNeighbors << ".");
  }
  worker.WriteSplats(vtkPolyData::GetData(outputVector, 0));
  return 1;
}

//------------------------------------------------------------------------------
void vtkAlgebraicSplats::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Order: " << this->Order << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << "\n";
  os << indent << "Selection: "
     << (this->Selection == ALL_POINTS     ? "AllPoints\n"
            : this->Selection == HOLE_FREE ? "HoleFree\n"
                                           : "FixedCount\n");
  os << indent << "Quality: " << this->Quality << "\n";
  os << indent << "Overlap: " << this->Overlap << "\n";
  os << indent << "NumberOfSplats: " << this->NumberOfSplats << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "RejectOppositeNormals: " << (this->RejectOppositeNormals ? "On\n" : "Off\n");
  os << indent << "ExtrapolationLimit: " << this->ExtrapolationLimit << "\n";
  os << indent << "ComputeErrors: " << (this->ComputeErrors ? "On\n" : "Off\n");
  os << indent << "TotalError: " << this->TotalError << "\n";
}
