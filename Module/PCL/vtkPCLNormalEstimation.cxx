// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCLNormalEstimation.h"

#include "vtkFloatArray.h"
#include "vtkObjectFactory.h"
#include "vtkPCLLocalCloud.h"
#include "vtkSMPTools.h"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <cmath>

vtkStandardNewMacro(vtkPCLNormalEstimation);

//------------------------------------------------------------------------------
vtkIdType vtkPCLNormalEstimation::Estimate(const vtkPCLLocalCloud& local, const double viewpoint[3],
  vtkPointSet*, vtkFloatArray* normals, vtkFloatArray* curvature)
{
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

  vtkIdType estimated = 0;
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
        continue;
      }
      ++estimated;
      const vtkIdType id = local.GetId((*indices)[i]);
      normals->SetTypedTuple(id, normal.normal);
      curvature->SetValue(id, normal.curvature);
    }
  };
  local.ForBatches(this, 0.1, 1.0, estimate);
  return estimated;
}

//------------------------------------------------------------------------------
void vtkPCLNormalEstimation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfNeighbors: " << this->NumberOfNeighbors << "\n";
  os << indent << "SearchRadius: " << this->SearchRadius << "\n";
}
