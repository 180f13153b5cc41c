// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCLLocalCloud.h"

#include "vtkAlgorithm.h"
#include "vtkBoundingBox.h"
#include "vtkPointSet.h"

#include <algorithm>
#include <cmath>
#include <numeric>

//------------------------------------------------------------------------------
vtkPCLLocalCloud::vtkPCLLocalCloud(vtkPointSet* input)
  : Cloud(pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>())
{
  vtkBoundingBox box;
  const vtkIdType count = input->GetNumberOfPoints();
  double x[3];
  for (vtkIdType id = 0; id < count; ++id)
  {
    input->GetPoint(id, x);
    if (std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]))
    {
      box.AddPoint(x);
      this->Ids.push_back(id);
    }
  }
  if (this->Ids.empty())
  {
    return;
  }
  box.GetCenter(this->Center);
  if (box.GetDiagonalLength() > 0.0)
  {
    this->Scale = box.GetDiagonalLength();
  }
  this->Cloud->reserve(this->Ids.size());
  for (const vtkIdType id : this->Ids)
  {
    input->GetPoint(id, x);
    this->Cloud->push_back(this->ToLocal(x));
  }
}

//------------------------------------------------------------------------------
pcl::PointXYZ vtkPCLLocalCloud::ToLocal(const double x[3]) const
{
  return pcl::PointXYZ(static_cast<float>((x[0] - this->Center[0]) / this->Scale),
    static_cast<float>((x[1] - this->Center[1]) / this->Scale),
    static_cast<float>((x[2] - this->Center[2]) / this->Scale));
}

//------------------------------------------------------------------------------
void vtkPCLLocalCloud::ToInput(const pcl::PointXYZ& local, double x[3]) const
{
  for (int i = 0; i < 3; ++i)
  {
    x[i] = this->Center[i] + this->Scale * local.data[i];
  }
}

//------------------------------------------------------------------------------
bool vtkPCLLocalCloud::ForBatches(vtkAlgorithm* filter, double from, double to,
  const std::function<void(const Indices& indices)>& function) const
{
  const std::size_t count = this->GetNumberOfPoints();
  const std::size_t batch = std::max<std::size_t>(10000, count / 50);
  for (std::size_t begin = 0; begin < count && !filter->GetAbortExecute(); begin += batch)
  {
    const std::size_t end = std::min(begin + batch, count);
    auto indices = pcl::make_shared<pcl::Indices>(end - begin);
    std::iota(indices->begin(), indices->end(), static_cast<pcl::index_t>(begin));
    function(indices);
    filter->UpdateProgress(from + (to - from) * end / count);
  }
  return !filter->GetAbortExecute();
}
