// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSpacing.h"

#include "vtkDistinctPoints.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkProgressFor.h"
#include "vtkSMPThreadLocalObject.h"
#include "vtkStaticPointLocator.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkPointSpacing);

namespace
{
// The distance to the farthest of the nearest neighbours that a search finds.
double FarthestNeighbor(
  vtkAbstractPointLocator* locator, vtkIdType id, int neighbors, vtkIdList* found)
{
  double x[3];
  locator->GetDataSet()->GetPoint(id, x);
  locator->FindClosestNPoints(neighbors + 1, x, found); // the point itself is the first
  double farthest2 = 0.0;
  for (vtkIdType i = 0; i < found->GetNumberOfIds(); ++i)
  {
    double y[3];
    locator->GetDataSet()->GetPoint(found->GetId(i), y);
    farthest2 = std::max(farthest2, vtkMath::Distance2BetweenPoints(x, y));
  }
  return std::sqrt(farthest2);
}

double Median(std::vector<double> values)
{
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}
} // anonymous namespace

//------------------------------------------------------------------------------
int vtkPointSpacing::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  vtkPointSet* output = vtkPointSet::GetData(outputVector);
  output->ShallowCopy(input);

  const vtkDistinctPoints distinct(input);
  this->UpdateProgress(0.2);
  if (distinct.GetNumberOfNotFinite() > 0)
  {
    vtkWarningMacro(<< distinct.GetNumberOfNotFinite() << " of " << input->GetNumberOfPoints()
                    << " points have NaN or infinite coordinates; they get the median radius.");
  }

  const vtkIdType count = distinct.GetNumberOfPoints();
  std::vector<double> spacings(count, 0.0);
  double median = 0.0;
  if (count > 1)
  {
    vtkNew<vtkStaticPointLocator> locator;
    locator->SetDataSet(distinct.GetCloud());
    locator->BuildLocator();
    this->UpdateProgress(0.3);
    const int neighbors = static_cast<int>(std::min<vtkIdType>(this->NumberOfNeighbors, count - 1));
    const double perDistance = std::sqrt(vtkMath::Pi() / neighbors);
    vtkSMPThreadLocalObject<vtkIdList> found;
    const vtkIdType batch = (vtkIdType(1) << 15) * vtkSMPTools::GetEstimatedNumberOfThreads();
    if (!vtkProgressFor(this, count, batch, 0.3, 1.0,
          [&](vtkIdType begin, vtkIdType end)
          {
            for (vtkIdType id = begin; id < end; ++id)
            {
              spacings[id] = perDistance * FarthestNeighbor(locator, id, neighbors, found.Local());
            }
          }))
    {
      return 1;
    }
    median = Median(spacings);
  }
  else if (count == 1)
  {
    vtkWarningMacro(<< input->GetNumberOfPoints()
                    << " points share one position, so their spacing is unknown and the radius is "
                       "0; set a radius in the mapper.");
  }

  vtkNew<vtkFloatArray> radii;
  radii->SetName(this->RadiusArrayName.c_str());
  radii->SetNumberOfTuples(input->GetNumberOfPoints());
  const double largest = this->MaximumSpacing * median;
  for (vtkIdType id = 0; id < input->GetNumberOfPoints(); ++id)
  {
    const vtkIdType distinctId = distinct.GetDistinctId(id);
    const double spacing = distinctId < 0 ? median : std::min(spacings[distinctId], largest);
    radii->SetValue(id, static_cast<float>(this->Scale * spacing));
  }
  output->GetPointData()->AddArray(radii);
  return 1;
}

//------------------------------------------------------------------------------
void vtkPointSpacing::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << "\n";
  os << indent << "Scale: " << this->Scale << "\n";
  os << indent << "MaximumSpacing: " << this->MaximumSpacing << "\n";
  os << indent << "RadiusArrayName: " << this->RadiusArrayName << "\n";
}
