// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSamplingDistance.h"

#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProgressFor.h"
#include "vtkSMPThreadLocalObject.h"
#include "vtkSmartPointer.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace
{
/// Points that are asked for their neighbour where a quantile other than the least is wanted: the
/// rank of a quantile of 0.98 is then known to 0.0014.
constexpr std::size_t SampleSize = 10000;

/// A point with more twins than this has no neighbour: what is there is no sampled surface.
constexpr vtkIdType MaximumTwins = 1024;

/// A number from 0 to 1 that looks random, and is the same for the same position (the mixing of
/// SplitMix64).
double GetLot(const double x[3])
{
  std::uint64_t bits = 0;
  for (int k = 0; k < 3; ++k)
  {
    const double value = x[k] + 0.0; // -0 is 0
    std::uint64_t own;
    std::memcpy(&own, &value, sizeof(own));
    bits = (bits ^ own) + 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    bits ^= bits >> 31;
  }
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

struct Candidate
{
  double Lot;
  vtkIdType Id;
  bool operator<(const Candidate& other) const { return this->Lot < other.Lot; }
};

/// Of the first `count` points those of the lowest lots, `size` of them.
std::vector<Candidate> ChooseSample(vtkPoints* points, vtkIdType count, std::size_t size)
{
  std::vector<Candidate> sample; // once full a heap, the highest lot first
  for (vtkIdType id = 0; id < count; ++id)
  {
    double x[3];
    points->GetPoint(id, x);
    const Candidate candidate = { GetLot(x), id };
    if (sample.size() < size)
    {
      sample.push_back(candidate);
      if (sample.size() == size && id + 1 < count) // else all are taken
      {
        std::make_heap(sample.begin(), sample.end());
      }
    }
    else if (candidate < sample.front())
    {
      std::pop_heap(sample.begin(), sample.end());
      sample.back() = candidate;
      std::push_heap(sample.begin(), sample.end());
    }
  }
  return sample;
}

vtkSmartPointer<vtkPoints> Gather(vtkPoints* points, const std::vector<unsigned int>& ids)
{
  if (ids.empty())
  {
    return points;
  }
  auto listed = vtkSmartPointer<vtkPoints>::New();
  listed->SetDataType(points->GetDataType());
  listed->SetNumberOfPoints(static_cast<vtkIdType>(ids.size()));
  for (vtkIdType i = 0; i < listed->GetNumberOfPoints(); ++i)
  {
    listed->SetPoint(i, points->GetPoint(ids[i]));
  }
  return listed;
}

/// The distance to the nearest point at another position; 0 if there is none to be found.
double NearestNeighbor(vtkStaticPointLocator* locator, vtkIdType id, vtkIdList* found)
{
  double x[3];
  locator->GetDataSet()->GetPoint(id, x);
  const vtkIdType count = locator->GetDataSet()->GetNumberOfPoints();
  // most points have no twin, or one; where all that are found are twins, more are asked for
  for (vtkIdType wanted = 4;; wanted *= 4)
  {
    const int asked = static_cast<int>(std::min(wanted, count));
    locator->FindClosestNPoints(asked, x, found);
    double nearest2 = VTK_DOUBLE_MAX;
    for (vtkIdType i = 0; i < found->GetNumberOfIds(); ++i)
    {
      double y[3];
      locator->GetDataSet()->GetPoint(found->GetId(i), y);
      const double distance2 = vtkMath::Distance2BetweenPoints(x, y);
      nearest2 = distance2 > 0.0 ? std::min(nearest2, distance2) : nearest2;
    }
    if (nearest2 < VTK_DOUBLE_MAX)
    {
      return std::sqrt(nearest2);
    }
    if (asked == count || wanted > MaximumTwins)
    {
      return 0.0;
    }
  }
}

bool IsNearer(const vtkNeighborDistance& a, const vtkNeighborDistance& b)
{
  return a.Distance < b.Distance;
}

/// Points without a neighbour say nothing.
void RemoveLone(std::vector<vtkNeighborDistance>& distances)
{
  distances.erase(std::remove_if(distances.begin(), distances.end(),
                    [](const auto& asked) { return asked.Distance == 0.0; }),
    distances.end());
}
}

std::vector<vtkNeighborDistance> vtkSampleNeighborDistances(
  vtkPoints* points, vtkIdType own, double quantile, vtkAlgorithm* caller)
{
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  if (own == 0 || cloud->GetNumberOfPoints() < 2 || cloud->GetLength() == 0.0)
  {
    return {};
  }
  caller->UpdateProgress(0.05);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  caller->UpdateProgress(0.3);

  const std::vector<Candidate> asked =
    ChooseSample(points, own, quantile > 0.0 ? SampleSize : static_cast<std::size_t>(own));
  std::vector<vtkNeighborDistance> distances(asked.size());
  vtkSMPThreadLocalObject<vtkIdList> found;
  const vtkIdType batch = (vtkIdType(1) << 15) * vtkSMPTools::GetEstimatedNumberOfThreads();
  if (!vtkProgressFor(caller, static_cast<vtkIdType>(asked.size()), batch, 0.3, 1.0,
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType i = begin; i < end; ++i)
          {
            distances[i] = { asked[i].Lot, NearestNeighbor(locator, asked[i].Id, found.Local()) };
          }
        }))
  {
    return {};
  }
  if (quantile > 0.0)
  {
    return distances;
  }
  RemoveLone(distances);
  const auto least = std::min_element(distances.begin(), distances.end(), IsNearer);
  return least == distances.end() ? distances : std::vector<vtkNeighborDistance>{ *least };
}

double vtkSamplingDistance(std::vector<vtkNeighborDistance> distances, double quantile)
{
  if (distances.size() > SampleSize)
  {
    std::nth_element(distances.begin(), distances.begin() + SampleSize, distances.end(),
      [](const auto& a, const auto& b) { return a.Lot < b.Lot; });
    distances.resize(SampleSize);
  }
  RemoveLone(distances);
  if (distances.empty())
  {
    return 0.0;
  }
  const auto rank = static_cast<std::ptrdiff_t>(quantile * (distances.size() - 1) + 0.5);
  std::nth_element(distances.begin(), distances.begin() + rank, distances.end(), IsNearer);
  return distances[rank].Distance;
}

double vtkSamplingDistance(
  vtkPoints* points, const std::vector<unsigned int>& ids, double quantile, vtkAlgorithm* caller)
{
  const vtkSmartPointer<vtkPoints> counted = Gather(points, ids);
  return vtkSamplingDistance(
    vtkSampleNeighborDistances(counted, counted->GetNumberOfPoints(), quantile, caller), quantile);
}
