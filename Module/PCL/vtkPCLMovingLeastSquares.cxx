// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCLMovingLeastSquares.h"

#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
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
int vtkPCLMovingLeastSquares::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointSet* input = vtkPointSet::GetData(inputVector[0]);
  vtkPointSet* output = vtkPointSet::GetData(outputVector);
  output->ShallowCopy(input);
  if (input->GetNumberOfPoints() == 0)
  {
    return 1;
  }

  const vtkPCLLocalCloud local(input);
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

  double viewpoint[3];
  vtkPCLFindViewpoint(input, this->Viewpoint, viewpoint);
  vtkDataArray* sides = input->GetPointData()->GetNormals();
  vtkNew<vtkPoints> points;
  points->SetDataType(input->GetPoints()->GetDataType());
  points->DeepCopy(input->GetPoints());
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(input->GetNumberOfPoints());
  normals->Fill(0.0);
  vtkNew<vtkFloatArray> curvature;
  curvature->SetName("curvature");
  curvature->SetNumberOfTuples(input->GetNumberOfPoints());
  curvature->Fill(0.0);
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
  if (!local.ForBatches(this, 0.2, 1.0, move))
  {
    return 1;
  }

  if (moved < input->GetNumberOfPoints())
  {
    vtkWarningMacro(<< input->GetNumberOfPoints() - moved << " of " << input->GetNumberOfPoints()
                    << " points have NaN or infinite coordinates, or fewer than 3 neighbours "
                       "within the search radius; they stay where they are.");
  }
  output->SetPoints(points);
  output->GetPointData()->SetNormals(normals);
  output->GetPointData()->AddArray(curvature);
  return 1;
}

//------------------------------------------------------------------------------
void vtkPCLMovingLeastSquares::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SearchRadius: " << this->SearchRadius << "\n";
  os << indent << "PolynomialOrder: " << this->PolynomialOrder << "\n";
  os << indent << "Viewpoint: (" << this->Viewpoint[0] << ", " << this->Viewpoint[1] << ", "
     << this->Viewpoint[2] << ")\n";
}
