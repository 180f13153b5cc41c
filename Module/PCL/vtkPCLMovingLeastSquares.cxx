// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCLMovingLeastSquares.h"

#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPCLLocalCloud.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPointSpacing.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProgressRelay.h"
#include "vtkSMPTools.h"

#include <pcl/common/point_tests.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/mls.h>

#include <algorithm>

vtkStandardNewMacro(vtkPCLMovingLeastSquares);

namespace
{
// PCL hands the cloud to the tree with each batch, which would build it anew.
class KeptTree : public pcl::search::KdTree<pcl::PointXYZ>
{
public:
  KeptTree()
    : pcl::search::KdTree<pcl::PointXYZ>(false)
  {
  }
  void setInputCloud(const PointCloudConstPtr& cloud, const pcl::IndicesConstPtr& indices) override
  {
    if (cloud != this->getInputCloud())
    {
      pcl::search::KdTree<pcl::PointXYZ>::setInputCloud(cloud, indices);
    }
  }
};

// The mean spacing of the cloud's points, in its own lengths; 0 where no two differ.
double MeanSpacing(const vtkPCLLocalCloud& local, vtkAlgorithm* filter)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  for (const pcl::PointXYZ& point : *local.GetCloud())
  {
    points->InsertNextPoint(point.data);
  }
  cloud->SetPoints(points);
  vtkNew<vtkPointSpacing> spacing;
  vtkNew<vtkProgressRelay> relay;
  relay->Set(filter, 0.0, 0.2);
  spacing->AddObserver(vtkCommand::ProgressEvent, relay);
  spacing->SetInputData(cloud);
  spacing->SetScale(1.0);
  spacing->Update();
  vtkDataArray* spacings = spacing->GetOutput()->GetPointData()->GetArray("radius");
  double sum = 0.0;
  for (vtkIdType i = 0; spacings && i < spacings->GetNumberOfTuples(); ++i)
  {
    sum += spacings->GetComponent(i, 0);
  }
  return sum / std::max<std::size_t>(local.GetNumberOfPoints(), 1);
}
} // anonymous namespace

//------------------------------------------------------------------------------
vtkIdType vtkPCLMovingLeastSquares::Estimate(const vtkPCLLocalCloud& local,
  const double viewpoint[3], vtkPointSet* output, vtkFloatArray* normals, vtkFloatArray* curvature)
{
  const double radius = this->SearchRadius > 0.0 ? this->SearchRadius / local.GetScale()
                                                 : 4.0 * MeanSpacing(local, this);
  this->UpdateProgress(0.2);

  pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointNormal> squares;
  squares.setNumberOfThreads(vtkSMPTools::GetEstimatedNumberOfThreads());
  squares.setInputCloud(local.GetCloud());
  squares.setSearchMethod(pcl::make_shared<KeptTree>());
  squares.setSearchRadius(radius > 0.0 ? radius : 1.0);
  squares.setPolynomialOrder(this->PolynomialOrder);
  squares.setComputeNormals(true);

  vtkDataArray* sides = output->GetPointData()->GetNormals();
  vtkNew<vtkPoints> points;
  points->SetDataType(output->GetPoints()->GetDataType());
  points->DeepCopy(output->GetPoints());
  vtkIdType moved = 0;
  const auto move = [&](const vtkPCLLocalCloud::Indices& indices)
  {
    pcl::PointCloud<pcl::PointNormal> result;
    squares.setIndices(indices);
    squares.process(result);
    const pcl::Indices& sources = squares.getCorrespondingIndices()->indices;
    for (std::size_t i = 0; i < result.size(); ++i)
    {
      const pcl::PointNormal& point = result[i];
      double normal[3] = { point.normal_x, point.normal_y, point.normal_z };
      if (!pcl::isFinite(point) || vtkMath::Normalize(normal) == 0.0)
      {
        continue;
      }
      ++moved;
      const vtkIdType id = local.GetId(sources[i]);
      double x[3];
      local.ToInput(pcl::PointXYZ(point.x, point.y, point.z), x);
      points->SetPoint(id, x);
      double side[3];
      if (sides)
      {
        sides->GetTuple(id, side);
      }
      else
      {
        vtkMath::Subtract(viewpoint, x, side);
      }
      if (vtkMath::Dot(normal, side) < 0.0)
      {
        vtkMath::MultiplyScalar(normal, -1.0);
      }
      normals->SetTuple(id, normal);
      curvature->SetValue(id, point.curvature);
    }
  };
  if (local.ForBatches(this, 0.2, 1.0, move))
  {
    output->SetPoints(points);
  }
  return moved;
}

//------------------------------------------------------------------------------
void vtkPCLMovingLeastSquares::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SearchRadius: " << this->SearchRadius << "\n";
  os << indent << "PolynomialOrder: " << this->PolynomialOrder << "\n";
}
