// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCLSurfaceEstimation.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPCLLocalCloud.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <algorithm>

namespace
{
// Where the sensor was: the field data that vtkPCDReader leaves, if there are any, else `fallback`.
void FindViewpoint(vtkPointSet* input, const double fallback[3], double viewpoint[3])
{
  std::copy(fallback, fallback + 3, viewpoint);
  vtkDataArray* sensor = input->GetFieldData()->GetArray("viewpoint");
  if (sensor && sensor->GetNumberOfValues() == 7)
  {
    const int components = sensor->GetNumberOfComponents();
    for (int i = 0; i < 3; ++i)
    {
      viewpoint[i] = sensor->GetComponent(i / components, i % components);
    }
  }
}

vtkNew<vtkFloatArray> MakeZeros(const char* name, int components, vtkIdType count)
{
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count);
  array->Fill(0.0);
  return array;
}
} // anonymous namespace

//------------------------------------------------------------------------------
int vtkPCLSurfaceEstimation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  vtkPointSet* output = vtkPointSet::GetData(outputVector);
  output->ShallowCopy(input);
  const vtkIdType count = input->GetNumberOfPoints();
  if (count == 0)
  {
    return 1;
  }

  const vtkPCLLocalCloud local(input);
  double viewpoint[3];
  FindViewpoint(input, this->Viewpoint, viewpoint);
  const vtkNew<vtkFloatArray> normals = MakeZeros("Normals", 3, count);
  const vtkNew<vtkFloatArray> curvature = MakeZeros("curvature", 1, count);
  const vtkIdType estimated = this->Estimate(local, viewpoint, output, normals, curvature);
  if (this->GetAbortExecute())
  {
    return 1;
  }
  if (estimated < count)
  {
    vtkWarningMacro(<< count - estimated << " of " << count
                    << " points have NaN or infinite coordinates, or fewer than 3 neighbours to "
                       "find a surface with; they get a zero normal.");
  }
  output->GetPointData()->SetNormals(normals);
  output->GetPointData()->AddArray(curvature);
  return 1;
}

//------------------------------------------------------------------------------
void vtkPCLSurfaceEstimation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Viewpoint: (" << this->Viewpoint[0] << ", " << this->Viewpoint[1] << ", "
     << this->Viewpoint[2] << ")\n";
}
