// SPDX-License-Identifier: BSD-3-Clause
// vtkIsosurfacePoints on real volumes, beside vtkFlyingEdges3D.
#include "PointSurfaceTestUtilities.h"

#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkIsosurfacePoints.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTesting.h"
#include "vtkXMLImageDataReader.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace
{
vtkIdType CountCoincident(vtkPolyData* data)
{
  std::vector<std::array<double, 3>> positions(data->GetNumberOfPoints());
  for (vtkIdType id = 0; id < data->GetNumberOfPoints(); ++id)
  {
    data->GetPoint(id, positions[id].data());
  }
  std::sort(positions.begin(), positions.end());
  const auto end = std::unique(positions.begin(), positions.end());
  return positions.end() - end;
}

vtkIdType CountUndefined(vtkDataArray* normals)
{
  vtkIdType count = 0;
  for (vtkIdType id = 0; id < normals->GetNumberOfTuples(); ++id)
  {
    count += !(std::abs(vtkMath::Norm(normals->GetTuple(id)) - 1.0) < 1e-5);
  }
  return count;
}

void TestVolume(
  PointSurfaceTest::Checks& check, const std::string& file, double isovalue, bool meetsVoxels)
{
  vtkNew<vtkXMLImageDataReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputConnection(reader->GetOutputPort());
  edges->SetValue(0, isovalue);
  edges->ComputeScalarsOff();
  edges->Update();
  vtkNew<vtkIsosurfacePoints> points;
  points->SetInputConnection(reader->GetOutputPort());
  points->SetValue(0, isovalue);
  PointSurfaceTest::Messages messages(points);
  points->Update();

  const vtkIdType vertices = edges->GetOutput()->GetNumberOfPoints();
  const vtkIdType coincident = CountCoincident(edges->GetOutput());
  vtkPolyData* cloud = points->GetOutput();
  std::cout << file << " at " << isovalue << ": " << vertices << " vertices, " << coincident
            << " of them coincident; " << cloud->GetNumberOfPoints() << " points" << std::endl;
  check((coincident > 0) == meetsVoxels, "flying edges has coincident points at whole values");
  check(cloud->GetNumberOfPoints() == vertices - coincident, "each position once");
  check(CountCoincident(cloud) == 0, "no coincident points");
  check(CountUndefined(cloud->GetPointData()->GetNormals()) == 0, "no undefined normals");
  check(cloud->GetPointData()->GetArray("radius")->GetRange()[0] > 0.0, "no radius of 0");
  check(messages.GetCount() == 0, "no messages");
}
} // anonymous namespace

int TestIsosurfacePointsVolumes(int, char*[])
{
  const std::string folder = PointSurfaceTest::SharedData("volumes/");
  if (folder.empty())
  {
    return VTK_SKIP_RETURN_CODE;
  }
  PointSurfaceTest::Checks check;
  TestVolume(check, folder + "mr-head-colin27-t1.vti", 50, true);
  TestVolume(check, folder + "mr-head-colin27-t1.vti", 50.5, false);
  TestVolume(check, folder + "ct-head-promed0051.vti", 300, true);
  TestVolume(check, folder + "frog-tissue-labels.vti", 0.5, false);
  return check.GetResult();
}
