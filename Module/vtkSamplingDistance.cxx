// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSamplingDistance.h"

#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProgressFor.h"
#include "vtkSMPThreadLocalObject.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>

namespace
{
/// Points that are asked for their neighbour where a quantile other than the least is wanted: the
/// rank of a quantile of 0.98 is then known to 0.0014.
constexpr vtkIdType SampleSize = 10000;

/// A point with more twins than this has no neighbour: what is there is no sampled surface.
constexpr vtkIdType MaximumTwins = 1024;

vtkNew<vtkPolyData> Gather(vtkPoints* points, const std::vector<unsigned int>& ids)
{
  vtkNew<vtkPolyData> cloud;
  if (ids.empty())
  {
    cloud->SetPoints(points);
    return cloud;
  }
  vtkNew<vtkPoints> listed;
  listed->SetDataType(points->GetDataType());
  listed->SetNumberOfPoints(static_cast<vtkIdType>(ids.size()));
  for (vtkIdType i = 0; i < listed->GetNumberOfPoints(); ++i)
  {
    listed->SetPoint(i, points->GetPoint(ids[i]));
  }
  cloud->SetPoints(listed);
  return cloud;
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
}

double vtkSamplingDistance(
  vtkPoints* points, const std::vector<unsigned int>& ids, double quantile, vtkAlgorithm* caller)
{
  const vtkNew<vtkPolyData> cloud = Gather(points, ids);
  const vtkIdType count = cloud->GetNumberOfPoints();
  if (count < 2 || cloud->GetLength() == 0.0)
  {
    return 0.0;
  }
  caller->UpdateProgress(0.05);
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  caller->UpdateProgress(0.3);

  const vtkIdType asked = quantile > 0.0 ? std::min(count, SampleSize) : count;
  std::vector<double> distances(asked);
  vtkSMPThreadLocalObject<vtkIdList> found;
  const vtkIdType batch = (vtkIdType(1) << 15) * vtkSMPTools::GetEstimatedNumberOfThreads();
  if (!vtkProgressFor(caller, asked, batch, 0.3, 1.0,
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType i = begin; i < end; ++i)
          {
            distances[i] = NearestNeighbor(locator, i * count / asked, found.Local());
          }
        }))
  {
    return 0.0;
  }
  distances.erase(std::remove(distances.begin(), distances.end(), 0.0), distances.end());
  if (distances.empty())
  {
    return 0.0;
  }
  const auto rank = static_cast<std::ptrdiff_t>(quantile * (distances.size() - 1) + 0.5);
  std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
  return distances[rank];
}
