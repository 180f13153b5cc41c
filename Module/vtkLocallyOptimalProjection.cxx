// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLocallyOptimalProjection.h"

#include "vtkDistinctPoints.h"
#include "vtkPointSpacing.h"
#include "vtkRandomOrder.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPThreadLocalObject.h"
#include "vtkSMPTools.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkLocallyOptimalProjection);

namespace
{
using Vector = std::array<double, 3>;

/// Beyond this share of h the weight exp(-16 r^2 / h^2) is below 1e-4, and left out.
constexpr double Reach = 0.76;

Vector GetPoint(vtkPointSet* cloud, vtkIdType id)
{
  Vector x;
  cloud->GetPoint(id, x.data());
  return x;
}

double GetWeight(double r, double h)
{
  return std::exp(-16.0 * r * r / (h * h));
}

/// The median of the input about a point: each neighbour counts with theta(r) / r; in the first
/// iteration with theta(r).
Vector Attract(vtkPointSet* cloud, vtkIdList* around, const Vector& x, double h, bool first)
{
  Vector sum = { 0.0, 0.0, 0.0 };
  double weights = 0.0;
  for (vtkIdType id : *around)
  {
    const Vector p = GetPoint(cloud, id);
    const double r = std::sqrt(vtkMath::Distance2BetweenPoints(p.data(), x.data()));
    const double weight = GetWeight(r, h) / (first ? 1.0 : std::max(r, 1e-6 * h));
    for (int k = 0; k < 3; ++k)
    {
      sum[k] += weight * (p[k] - x[k]);
    }
    weights += weight;
  }
  for (int k = 0; k < 3; ++k)
  {
    sum[k] = x[k] + (weights > 0.0 ? sum[k] / weights : 0.0);
  }
  return sum;
}

/// The mean of the differences to the other points, each with theta(r) / r |eta'(r)|.
Vector Repel(const std::vector<Vector>& points, vtkIdType self, vtkIdList* around, double h)
{
  const Vector& x = points[self];
  Vector sum = { 0.0, 0.0, 0.0 };
  double weights = 0.0;
  for (vtkIdType id : *around)
  {
    if (id == self)
    {
      continue;
    }
    const double r =
      std::max(std::sqrt(vtkMath::Distance2BetweenPoints(points[id].data(), x.data())), 1e-6 * h);
    const double weight = GetWeight(r, h) * std::pow(h / r, 5);
    for (int k = 0; k < 3; ++k)
    {
      sum[k] += weight * (x[k] - points[id][k]);
    }
    weights += weight;
  }
  for (int k = 0; k < 3; ++k)
  {
    sum[k] = weights > 0.0 ? sum[k] / weights : 0.0;
  }
  return sum;
}
}

//------------------------------------------------------------------------------
int vtkLocallyOptimalProjection::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

double vtkLocallyOptimalProjection::ChooseSupport(vtkPolyData* cloud, vtkIdType count)
{
  if (this->Support > 0.0)
  {
    return this->Support;
  }
  vtkNew<vtkPointSpacing> spacing;
  spacing->SetInputData(cloud);
  spacing->SetScale(1.0);
  spacing->Update();
  vtkDataArray* sides = spacing->GetOutput()->GetPointData()->GetArray("radius");
  double area = 0.0;
  for (vtkIdType id = 0; id < sides->GetNumberOfTuples(); ++id)
  {
    area += sides->GetTuple1(id) * sides->GetTuple1(id);
  }
  return 4.0 * std::sqrt(area / count);
}

int vtkLocallyOptimalProjection::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  this->NumberOfIterations = 0;
  const vtkDistinctPoints distinct(input);
  if (distinct.GetNumberOfNotFinite() > 0)
  {
    vtkWarningMacro(<< distinct.GetNumberOfNotFinite() << " of " << input->GetNumberOfPoints()
                    << " points have NaN or infinite coordinates; they are left out.");
  }
  vtkPolyData* cloud = distinct.GetCloud();
  const vtkIdType total = cloud->GetNumberOfPoints();
  const vtkIdType count = std::min(this->NumberOfPoints, total);
  if (count == 0)
  {
    return 1;
  }

  std::vector<vtkIdType> ids(total);
  for (vtkIdType id = 0; id < total; ++id)
  {
    ids[id] = id;
  }
  vtkRandomOrder(ids, count, this->Seed);
  std::vector<Vector> points(count);
  std::vector<Vector> moved(count);
  vtkNew<vtkPoints> current; // the same as `points`, for the search
  current->SetDataTypeToDouble();
  current->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    points[i] = GetPoint(cloud, ids[i]);
    current->SetPoint(i, points[i].data());
  }

  vtkNew<vtkStaticPointLocator> cloudLocator;
  cloudLocator->SetDataSet(cloud);
  cloudLocator->BuildLocator();
  if (count < total)
  {
    const double h = this->ChooseSupport(cloud, count);
    vtkNew<vtkPolyData> set;
    set->SetPoints(current);
    vtkSMPThreadLocalObject<vtkIdList> lists;
    double movement = VTK_DOUBLE_MAX;
    while (this->NumberOfIterations < this->MaximumNumberOfIterations &&
      movement > this->Convergence * h)
    {
      vtkNew<vtkStaticPointLocator> locator;
      locator->SetDataSet(set);
      locator->BuildLocator();
      const bool first = this->NumberOfIterations == 0;
      vtkSMPTools::For(0, count, 64,
        [&](vtkIdType begin, vtkIdType end)
        {
          vtkIdList* around = lists.Local();
          for (vtkIdType i = begin; i < end; ++i)
          {
            // in one order, whatever the search's is: sums of floating point numbers depend on it
            cloudLocator->FindPointsWithinRadius(Reach * h, points[i].data(), around);
            std::sort(around->begin(), around->end());
            moved[i] = Attract(cloud, around, points[i], h, first);
            if (!first)
            {
              locator->FindPointsWithinRadius(Reach * h, points[i].data(), around);
              std::sort(around->begin(), around->end());
              const Vector away = Repel(points, i, around, h);
              for (int k = 0; k < 3; ++k)
              {
                moved[i][k] += this->Mu * away[k];
              }
            }
          }
        });
      movement = 0.0;
      for (vtkIdType i = 0; i < count; ++i)
      {
        movement +=
          std::sqrt(vtkMath::Distance2BetweenPoints(points[i].data(), moved[i].data())) / count;
        current->SetPoint(i, moved[i].data());
      }
      current->Modified();
      points.swap(moved);
      ++this->NumberOfIterations;
      this->UpdateProgress(
        static_cast<double>(this->NumberOfIterations) / this->MaximumNumberOfIterations);
      if (this->GetAbortExecute())
      {
        return 1;
      }
    }
  }

  std::vector<vtkIdType> inputIds(total, -1); // of the distinct points
  for (vtkIdType id = input->GetNumberOfPoints() - 1; id >= 0; --id)
  {
    if (distinct.GetDistinctId(id) >= 0)
    {
      inputIds[distinct.GetDistinctId(id)] = id;
    }
  }
  vtkNew<vtkIdTypeArray> nearest;
  nearest->SetName("InputPointIds");
  nearest->SetNumberOfTuples(count);
  output->GetPointData()->CopyAllOn();
  output->GetPointData()->CopyAllocate(input->GetPointData(), count);
  vtkNew<vtkPoints> outputPoints;
  outputPoints->SetDataType(input->GetPoints()->GetDataType());
  outputPoints->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const vtkIdType id = inputIds[cloudLocator->FindClosestPoint(points[i].data())];
    output->GetPointData()->CopyData(input->GetPointData(), id, i);
    nearest->SetValue(i, id);
    outputPoints->SetPoint(i, points[i].data());
  }
  output->SetPoints(outputPoints);
  output->GetPointData()->AddArray(nearest);
  return 1;
}

//------------------------------------------------------------------------------
void vtkLocallyOptimalProjection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Support: " << this->Support << "\n";
  os << indent << "Mu: " << this->Mu << "\n";
  os << indent << "Convergence: " << this->Convergence << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "NumberOfIterations: " << this->NumberOfIterations << "\n";
}
