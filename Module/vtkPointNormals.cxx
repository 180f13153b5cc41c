// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointNormals.h"

#include "vtkDistinctPoints.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPCANormalEstimation.h"
#include "vtkPointData.h"

#include <algorithm>

vtkStandardNewMacro(vtkPointNormals);

namespace
{
// Whether normals point away from the middle of their points, on the whole.
bool PointOutward(vtkPolyData* cloud)
{
  double center[3];
  cloud->GetCenter(center);
  vtkDataArray* normals = cloud->GetPointData()->GetNormals();
  double sum = 0.0;
  for (vtkIdType id = 0; id < cloud->GetNumberOfPoints(); ++id)
  {
    double x[3];
    double normal[3];
    cloud->GetPoint(id, x);
    normals->GetTuple(id, normal);
    vtkMath::Subtract(x, center, x);
    sum += vtkMath::Dot(x, normal);
  }
  return sum >= 0.0;
}
} // anonymous namespace

//------------------------------------------------------------------------------
int vtkPointNormals::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  vtkPointSet* output = vtkPointSet::GetData(outputVector);
  output->ShallowCopy(input);

  const vtkDistinctPoints distinct(input);
  if (distinct.GetNumberOfNotFinite() > 0)
  {
    vtkWarningMacro(<< distinct.GetNumberOfNotFinite() << " of " << input->GetNumberOfPoints()
                    << " points have NaN or infinite coordinates; they get a zero normal.");
  }
  this->UpdateProgress(0.1);
  if (this->GetAbortExecute())
  {
    return 1;
  }

  const bool traverse = this->NormalOrientation == GRAPH_TRAVERSAL;
  vtkNew<vtkPCANormalEstimation> estimation;
  estimation->SetInputData(distinct.GetCloud());
  estimation->SetSampleSize(this->NumberOfNeighbors);
  estimation->SetNormalOrientation(
    traverse ? vtkPCANormalEstimation::GRAPH_TRAVERSAL : vtkPCANormalEstimation::POINT);
  estimation->SetOrientationPoint(this->OrientationPoint);
  estimation->Update();
  this->UpdateProgress(0.9);
  if (this->GetAbortExecute())
  {
    return 1;
  }

  vtkPolyData* estimated = estimation->GetOutput();
  vtkDataArray* distinctNormals = estimated->GetPointData()->GetNormals();
  const bool outward = !traverse || !distinctNormals || PointOutward(estimated);
  const double sign = outward == this->FlipNormals ? -1.0 : 1.0;

  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(input->GetNumberOfPoints());
  for (vtkIdType id = 0; id < input->GetNumberOfPoints(); ++id)
  {
    double normal[3] = { 0.0, 0.0, 0.0 };
    const vtkIdType distinctId = distinct.GetDistinctId(id);
    if (distinctId >= 0)
    {
      distinctNormals->GetTuple(distinctId, normal);
      vtkMath::MultiplyScalar(normal, sign);
    }
    normals->SetTuple(id, normal);
  }
  output->GetPointData()->SetNormals(normals);
  return 1;
}

//------------------------------------------------------------------------------
void vtkPointNormals::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << "\n";
  os << indent << "NormalOrientation: "
     << (this->NormalOrientation == POINT ? "Point\n" : "GraphTraversal\n");
  os << indent << "OrientationPoint: (" << this->OrientationPoint[0] << ", "
     << this->OrientationPoint[1] << ", " << this->OrientationPoint[2] << ")\n";
  os << indent << "FlipNormals: " << (this->FlipNormals ? "On\n" : "Off\n");
}
