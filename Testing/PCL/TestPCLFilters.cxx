// SPDX-License-Identifier: BSD-3-Clause
// vtkPCLNormalEstimation and vtkPCLMovingLeastSquares on spheres, whose surface is known.
#include "PointSurfaceTestUtilities.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkPCLMovingLeastSquares.h"
#include "vtkPCLNormalEstimation.h"

#include <algorithm>
#include <limits>

namespace
{
// A sphere of any place and size; with noise along its normals, in parts of the radius.
vtkSmartPointer<vtkPolyData> MakeSphere(int count, double center, double radius, double noise)
{
  vtkSmartPointer<vtkPolyData> sphere = PointSurfaceTest::MakeSphereCloud(count);
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(11);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType id = 0; id < count; ++id)
  {
    random->Next();
    const double size = radius * (1.0 + random->GetRangeValue(-noise, noise));
    const double* n = sphere->GetPoint(id);
    points->InsertNextPoint(center + size * n[0], center + size * n[1], center + size * n[2]);
  }
  sphere->SetPoints(points);
  sphere->GetPointData()->Initialize();
  return sphere;
}

void SetViewpoint(vtkPolyData* cloud, double x, double y, double z)
{
  vtkNew<vtkDoubleArray> viewpoint;
  viewpoint->SetName("viewpoint");
  for (const double value : { x, y, z, 1.0, 0.0, 0.0, 0.0 })
  {
    viewpoint->InsertNextValue(value);
  }
  cloud->GetFieldData()->AddArray(viewpoint);
}

// The largest angle in degrees between normals and the sphere's, those turned inward by `sign` -1.
double LargestAngle(vtkDataSet* cloud, double center, double sign)
{
  vtkDataArray* normals = cloud->GetPointData()->GetNormals();
  double least = normals ? 1.0 : -1.0;
  for (vtkIdType id = 0; normals && id < cloud->GetNumberOfPoints(); ++id)
  {
    double x[3];
    cloud->GetPoint(id, x);
    double normal[3] = { x[0] - center, x[1] - center, x[2] - center };
    vtkMath::Normalize(normal);
    least = std::min(least, sign * vtkMath::Dot(normal, normals->GetTuple(id)));
  }
  return vtkMath::DegreesFromRadians(std::acos(std::max(-1.0, least)));
}

// The root mean square of distances to the sphere, in parts of its radius.
double Deviation(vtkDataSet* cloud, double center, double radius)
{
  double sum = 0.0;
  for (vtkIdType id = 0; id < cloud->GetNumberOfPoints(); ++id)
  {
    double x[3];
    cloud->GetPoint(id, x);
    const double d[3] = { x[0] - center, x[1] - center, x[2] - center };
    const double off = vtkMath::Norm(d) / radius - 1.0;
    sum += off * off;
  }
  return std::sqrt(sum / cloud->GetNumberOfPoints());
}

//------------------------------------------------------------------------------
void TestNormals(PointSurfaceTest::Checks& check)
{
  for (const double size : { 1.0, 1e-9, 1e9 })
  {
    vtkSmartPointer<vtkPolyData> sphere = MakeSphere(5000, 0.0, size, 0.0);
    vtkNew<vtkPCLNormalEstimation> filter;
    filter->SetInputData(sphere);
    filter->Update();
    // from the centre, where the default viewpoint is
    check.AtMost(LargestAngle(filter->GetOutput(), 0.0, -1.0), 3.0, "normals, inward");
    vtkDataArray* curvature = filter->GetOutput()->GetPointData()->GetArray("curvature");
    check(curvature && curvature->GetRange()[0] >= 0.0 && curvature->GetRange()[1] < 0.01,
      "curvature of what is nearly flat");
    filter->SetSearchRadius(0.1 * size);
    filter->Update();
    check.AtMost(LargestAngle(filter->GetOutput(), 0.0, -1.0), 3.0, "by radius");
  }
  // Centimetres at 10^7, seen from within by a sensor of its own.
  vtkSmartPointer<vtkPolyData> far = MakeSphere(5000, 1e7, 0.3, 0.0);
  SetViewpoint(far, 1e7, 1e7, 1e7);
  vtkNew<vtkPCLNormalEstimation> filter;
  PointSurfaceTest::Messages messages(filter);
  filter->SetInputData(far);
  filter->SetViewpoint(0, 0, 0);
  filter->Update();
  check.AtMost(LargestAngle(filter->GetOutput(), 1e7, -1.0), 3.0, "normals at 10^7");
  check(messages.GetCount() == 0, "nothing to say");

  check(PointSurfaceTest::Abort(filter) && !filter->GetOutput()->GetPointData()->GetNormals(),
    "an aborted filter gives no normals");
}

//------------------------------------------------------------------------------
void TestMovingLeastSquares(PointSurfaceTest::Checks& check)
{
  for (const double center : { 0.0, 1e7 })
  {
    vtkSmartPointer<vtkPolyData> sphere = MakeSphere(5000, center, 2.0, 0.01);
    SetViewpoint(sphere, center, center, center);
    vtkNew<vtkPCLMovingLeastSquares> filter;
    filter->SetInputData(sphere);
    filter->SetSearchRadius(0.5);
    filter->Update();
    vtkPointSet* output = filter->GetOutput();
    check.AtLeast(Deviation(sphere, center, 2.0), 0.005, "noise before");
    check.AtMost(Deviation(output, center, 2.0), 0.0015, "and after");
    check.AtMost(LargestAngle(output, center, -1.0), 4.0, "normals, towards the viewpoint");
    check(output->GetPoints()->GetDataType() == VTK_DOUBLE, "double precision stays");

    // The default radius; normals on the side of the input's; a plane leaves a sphere flattened.
    vtkNew<vtkPCLMovingLeastSquares> again;
    again->SetInputData(output);
    again->Update();
    check.AtMost(Deviation(again->GetOutput(), center, 2.0), 0.0015, "by the default radius");
    check.AtMost(
      LargestAngle(again->GetOutput(), center, -1.0), 4.0, "sides of the input's normals");
    filter->SetPolynomialOrder(1);
    filter->Update();
    check.AtLeast(Deviation(filter->GetOutput(), center, 2.0), 0.002, "a plane cuts the sphere");
    filter->SetPolynomialOrder(2);
    check(PointSurfaceTest::Abort(filter) && !filter->GetOutput()->GetPointData()->GetNormals() &&
        filter->GetOutput()->GetPoint(5)[0] == sphere->GetPoint(5)[0],
      "an aborted filter gives its input");
  }
}

//------------------------------------------------------------------------------
template <typename Filter>
void TestFaults(PointSurfaceTest::Checks& check, const std::string& name)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  vtkSmartPointer<vtkPolyData> sphere = MakeSphere(2000, 0.0, 1.0, 0.0);
  sphere->GetPoints()->InsertNextPoint(nan, 0.0, 0.0);
  sphere->GetPoints()->InsertNextPoint(0.0, 0.0, std::numeric_limits<double>::infinity());
  vtkNew<Filter> filter;
  PointSurfaceTest::Messages messages(filter);
  filter->SetInputData(sphere);
  filter->Update();
  vtkDataArray* normals = filter->GetOutput()->GetPointData()->GetNormals();
  check(messages.Contain("2 of 2002 points"), name + ": one warning with the count");
  check(normals && normals->GetNumberOfTuples() == 2002 &&
      vtkMath::Norm(normals->GetTuple(2000)) == 0.0 &&
      vtkMath::Norm(normals->GetTuple(2001)) == 0.0 &&
      std::abs(vtkMath::Norm(normals->GetTuple(0)) - 1.0) < 1e-5,
    name + ": zero normals for what is not finite");
  check(std::isnan(filter->GetOutput()->GetPoint(2000)[0]), name + ": which stays where it is");

  for (const int count : { 0, 1, 2, 3 })
  {
    vtkNew<vtkPolyData> few;
    vtkNew<vtkPoints> points;
    for (int i = 0; i < count; ++i)
    {
      points->InsertNextPoint(0.0, 0.0, 0.0); // at one place
    }
    few->SetPoints(points);
    filter->SetInputData(few);
    filter->Update();
    check(filter->GetOutput()->GetNumberOfPoints() == count,
      name + ": " + std::to_string(count) + " points");
  }
}
} // anonymous namespace

int TestPCLFilters(int, char*[])
{
  PointSurfaceTest::Checks check;
  TestNormals(check);
  TestMovingLeastSquares(check);
  TestFaults<vtkPCLNormalEstimation>(check, "normals");
  TestFaults<vtkPCLMovingLeastSquares>(check, "moving least squares");
  return check.GetResult();
}
