// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkDistinctPoints_h
#define vtkDistinctPoints_h

#include "vtkNew.h"
#include "vtkPolyData.h"

#include <vector>

/**
 * The finite points of a point set, each position once, in double precision and in the order in
 * which they come first. Neighbour searches want them so: points that are not finite break
 * locators, and twins are no neighbours that tell of spacing or tangent plane.
 */
class vtkDistinctPoints
{
public:
  explicit vtkDistinctPoints(vtkPointSet* input);

  // Points without cells.
  vtkPolyData* GetCloud() const { return this->Cloud; }
  vtkIdType GetNumberOfPoints() const { return this->Cloud->GetNumberOfPoints(); }
  vtkIdType GetNumberOfNotFinite() const { return this->NumberOfNotFinite; }

  // The id in the cloud of a point of the input, or -1 if that is not finite.
  vtkIdType GetDistinctId(vtkIdType inputId) const { return this->DistinctIds[inputId]; }

private:
  vtkNew<vtkPolyData> Cloud;
  std::vector<vtkIdType> DistinctIds;
  vtkIdType NumberOfNotFinite = 0;
};

#endif
