// SPDX-License-Identifier: BSD-3-Clause
// vtkPointSpacing and vtkPointNormals on real scans: twins, uneven density, strays, NaN points.
#include "PointSurfaceTestUtilities.h"

#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPointNormals.h"
#include "vtkPointSpacing.h"
#include "vtkPolyData.h"
#include "vtkTesting.h"
#include "vtkXMLPolyDataReader.h"

#include <algorithm>
#include <cmath>

namespace
{
void TestScan(PointSurfaceTest::Checks& check, const std::string& name, vtkIdType notFinite,
  double leastMedian, double greatestMedian)
{
  const std::string file = PointSurfaceTest::SharedData("scans/" + name + ".vtp");
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkPointSpacing> spacing;
  spacing->SetInputConnection(reader->GetOutputPort());
  PointSurfaceTest::Messages messages(spacing);
  spacing->Update();
  vtkDataArray* radii = spacing->GetOutput()->GetPointData()->GetArray("radius");
  std::vector<double> values;
  for (vtkIdType id = 0; id < radii->GetNumberOfTuples(); ++id)
  {
    values.push_back(radii->GetTuple1(id));
  }
  std::sort(values.begin(), values.end());
  const double median = values[values.size() / 2];
  std::cout << name << ": radii " << values.front() << ", median " << median << ", "
            << values.back() << std::endl;
  check(values.front() > 0.0, name + ": no radius of 0");
  check(median > leastMedian && median < greatestMedian, name + ": median radius");
  check(values.back() <= 10.5 * median, name + ": no absurd radius");
  check(notFinite == 0
      ? messages.GetCount() == 0
      : messages.Contain(std::to_string(notFinite) + " of " + std::to_string(values.size())),
    name + ": points that are not finite are told of");
}
} // anonymous namespace

int TestPointSpacingScans(int, char*[])
{
  if (PointSurfaceTest::SharedData("scans").empty())
  {
    return VTK_SKIP_RETURN_CODE;
  }
  PointSurfaceTest::Checks check;
  // From half to three times 1.5 mean distances to the nearest distinct neighbour; single
  // precision has drawn the terrain into lines 0.5 apart.
  TestScan(check, "room-lidar", 0, 0.02, 0.14);
  TestScan(check, "terrain-utm-csite2", 0, 0.5, 2.0);
  TestScan(check, "table-mug-stereo-rgb", 97920, 0.001, 0.006);

  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(PointSurfaceTest::SharedData("clouds/bunny.vtp").c_str());
  reader->Update();
  vtkDataArray* expected = reader->GetOutput()->GetPointData()->GetNormals();
  vtkNew<vtkPointNormals> filter;
  filter->SetInputConnection(reader->GetOutputPort());
  filter->Update();
  vtkDataArray* normals = filter->GetOutput()->GetPointData()->GetNormals();
  double sum = 0.0;
  vtkIdType inward = 0;
  for (vtkIdType id = 0; id < normals->GetNumberOfTuples(); ++id)
  {
    const double cosine = vtkMath::Dot(expected->GetTuple(id), normals->GetTuple(id));
    inward += cosine < 0.0;
    sum += std::acos(std::min(1.0, std::abs(cosine)));
  }
  const double count = static_cast<double>(normals->GetNumberOfTuples());
  check.AtMost(vtkMath::DegreesFromRadians(sum / count), 4.0, "bunny: mean angle, degrees");
  check.AtMost(inward / count, 0.01, "bunny: share of inward normals");
  return check.GetResult();
}
