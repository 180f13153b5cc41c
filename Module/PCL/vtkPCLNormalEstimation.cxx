// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCLNormalEstimation.h"

#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPCLLocalCloud.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkSMPTools.h"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <cmath>

vtkStandardNewMacro(vtkPCLNormalEstimation);

//------------------------------------------------------------------------------
int vtkPCLNormalEstimation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  vtkPointSet* output = vtkPointSet::GetData(outputVector);
  output->ShallowCopy(input);

  const vtkPCLLocalCloud local(input);
  double viewpoint[3];
  vtkPCLFindViewpoint(input, this->Viewpoint, viewpoint);
  const pcl::PointXYZ towards = local.ToLocal(viewpoint);

  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNumberOfThreads(vtkSMPTools::GetEstimatedNumberOfThreads());
  estimation.setInputCloud(local.GetCloud());
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>(false));
  estimation.setViewPoint(towards.x, towards.y, towards.z);
  if (this->SearchRadius > 0.0)
  {
    estimation.setRadiusSearch(this->SearchRadius / local.GetScale());
  }
  else
  {
    estimation.setKSearch(this->NumberOfNeighbors);
  }
  this->UpdateProgress(0.1);

  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(input->GetNumberOfPoints());
  normals->Fill(0.0);
  vtkNew<vtkFloatArray> curvature;
  curvature->SetName("curvature");
  curvature->SetNumberOfTuples(input->GetNumberOfPoints());
  curvature->Fill(0.0);
  vtkIdType without = local.GetNumberOfNotFinite();
  const auto estimate = [&](const vtkPCLLocalCloud::Indices& indices)
  {
    pcl::PointCloud<pcl::Normal> result;
    estimation.setIndices(indices);
    estimation.compute(result);
    for (std::size_t i = 0; i < result.size(); ++i)
    {
      const pcl::Normal& normal = result[i];
      if (!std::isfinite(normal.normal_x) || !std::isfinite(normal.curvature))
      {
        ++without;
        continue;
      }
      const vtkIdType id = local.GetId((*indices)[i]);
      normals->SetTypedTuple(id, normal.normal);
      curvature->SetValue(id, normal.curvature);
    }
  };
  if (!local.ForBatches(this, 0.1, 1.0, estimate))
  {
    return 1;
  }

  if (without > 0)
  {
    vtkWarningMacro(<< without << " of " << input->GetNumberOfPoints()
                    << " points have NaN or infinite coordinates, or fewer than 3 neighbours; they "
                       "get a zero normal.");
  }
  output->GetPointData()->SetNormals(normals);
  output->GetPointData()->AddArray(curvature);
  return 1;
}

//------------------------------------------------------------------------------
void vtkPCLNormalEstimation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << "\n";
  os << indent << "SearchRadius: " << this->SearchRadius << "\n";
  os << indent << "Viewpoint: (" << this->Viewpoint[0] << ", " << this->Viewpoint[1] << ", "
     << this->Viewpoint[2] << ")\n";
}
