// SPDX-License-Identifier: BSD-3-Clause
// vtkPointNormals on sphere and torus, whose normals are known, and on data with faults.
#include "PointSurfaceTestUtilities.h"

#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkPointData.h"
#include "vtkPointNormals.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace
{
using Vector = std::array<double, 3>;

// Points with the true normals beside them.
struct Sample
{
  vtkSmartPointer<vtkPolyData> Cloud = vtkSmartPointer<vtkPolyData>::New();
  std::vector<Vector> Normals;

  Sample()
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    this->Cloud->SetPoints(points);
  }
  void Add(const Vector& x, const Vector& normal)
  {
    this->Cloud->GetPoints()->InsertNextPoint(x.data());
    this->Normals.push_back(normal);
  }
};

// Evenly spread over the sphere by the golden angle.
Sample Sphere(int n, double radius, const Vector& center)
{
  Sample sample;
  for (int i = 0; i < n; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / n;
    const double angle = i * vtkMath::Pi() * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    const Vector normal = { r * std::cos(angle), r * std::sin(angle), z };
    sample.Add({ center[0] + radius * normal[0], center[1] + radius * normal[1],
                 center[2] + radius * normal[2] },
      normal);
  }
  return sample;
}

// At random angles.
Sample Torus(int n)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(5);
  Sample sample;
  for (int i = 0; i < n; ++i)
  {
    const double u = 2.0 * vtkMath::Pi() * random->GetNextValue();
    const double v = 2.0 * vtkMath::Pi() * random->GetNextValue();
    const Vector normal = { std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v) };
    sample.Add({ 2.0 * std::cos(u) + normal[0], 2.0 * std::sin(u) + normal[1], normal[2] }, normal);
  }
  return sample;
}

vtkSmartPointer<vtkDataArray> Normals(vtkPolyData* cloud)
{
  vtkNew<vtkPointNormals> filter;
  filter->SetInputData(cloud);
  filter->Update();
  return filter->GetOutput()->GetPointData()->GetNormals();
}

// The largest angle to the true normals in degrees; 180 for opposite ones.
double LargestAngle(const Sample& sample, vtkDataArray* normals)
{
  double least = normals->GetNumberOfTuples() == sample.Cloud->GetNumberOfPoints() ? 1.0 : -1.0;
  for (vtkIdType id = 0; id < normals->GetNumberOfTuples(); ++id)
  {
    const double* normal = normals->GetTuple(id);
    if (std::abs(vtkMath::Norm(normal) - 1.0) > 1e-5)
    {
      return 180.0;
    }
    least = std::min(least, vtkMath::Dot(sample.Normals[id].data(), normal));
  }
  return vtkMath::DegreesFromRadians(std::acos(std::max(-1.0, least)));
}

bool AreUnit(vtkDataArray* normals)
{
  for (vtkIdType id = 0; id < normals->GetNumberOfTuples(); ++id)
  {
    if (!(std::abs(vtkMath::Norm(normals->GetTuple(id)) - 1.0) < 1e-5))
    {
      return false;
    }
  }
  return normals->GetNumberOfTuples() > 0;
}

//------------------------------------------------------------------------------
void TestAccuracy(PointSurfaceTest::Checks& check)
{
  const Sample sphere = Sphere(5000, 1.0, { 0, 0, 0 });
  check.AtMost(LargestAngle(sphere, Normals(sphere.Cloud)), 3.0, "sphere, outward");
  const Sample torus = Torus(40000);
  check.AtMost(LargestAngle(torus, Normals(torus.Cloud)), 12.0, "torus at random, outward");
  // Centimetres at 10^7.
  const Sample far = Sphere(5000, 0.3, { 1e7, 5.4e6, -100.0 });
  check.AtMost(LargestAngle(far, Normals(far.Cloud)), 3.0, "sphere at 10^7");
}

//------------------------------------------------------------------------------
void TestOrientation(PointSurfaceTest::Checks& check)
{
  const Sample sphere = Sphere(2000, 1.0, { 10, 0, 0 });
  vtkNew<vtkPointNormals> filter;
  filter->SetInputData(sphere.Cloud);
  filter->FlipNormalsOn();
  filter->Update();
  vtkDataArray* normals = filter->GetOutput()->GetPointData()->GetNormals();
  check(LargestAngle(sphere, normals) > 175.0, "flipped normals point inward");

  // Towards a viewpoint inside the sphere, then outside.
  filter->FlipNormalsOff();
  filter->SetNormalOrientationToPoint();
  filter->SetOrientationPoint(10.5, 0, 0);
  filter->Update();
  normals = filter->GetOutput()->GetPointData()->GetNormals();
  bool inward = true;
  for (vtkIdType id = 0; id < normals->GetNumberOfTuples(); ++id)
  {
    inward = inward && vtkMath::Dot(sphere.Normals[id].data(), normals->GetTuple(id)) < -0.99;
  }
  check(inward, "normals towards a point within");
  filter->SetOrientationPoint(10, 0, 1e6);
  filter->Update();
  normals = filter->GetOutput()->GetPointData()->GetNormals();
  check(normals->GetRange(2)[0] > -0.05 && normals->GetRange(2)[1] > 0.99,
    "normals towards a point far above");
  filter->FlipNormalsOn();
  filter->Update();
  normals = filter->GetOutput()->GetPointData()->GetNormals();
  check(normals->GetRange(2)[1] < 0.05 && normals->GetRange(2)[0] < -0.99,
    "flipped, normals away from it");
}

//------------------------------------------------------------------------------
void TestFaults(PointSurfaceTest::Checks& check)
{
  // Each point with so many twins that they alone would be all of its neighbours.
  Sample sphere = Sphere(1000, 1.0, { 0, 0, 0 });
  Sample twins;
  for (int i = 0; i < 20; ++i)
  {
    for (vtkIdType id = 0; id < sphere.Cloud->GetNumberOfPoints(); ++id)
    {
      Vector x;
      sphere.Cloud->GetPoint(id, x.data());
      twins.Add(x, sphere.Normals[id]);
    }
  }
  check.AtMost(LargestAngle(twins, Normals(twins.Cloud)), 5.0, "twenty of each point");

  // Points that are not finite get a zero normal and do not change the others.
  vtkSmartPointer<vtkDataArray> expected = Normals(sphere.Cloud);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  sphere.Cloud->GetPoints()->InsertNextPoint(nan, 0, 0);
  sphere.Cloud->GetPoints()->InsertNextPoint(0, 0, -std::numeric_limits<double>::infinity());
  vtkNew<vtkPointNormals> filter;
  PointSurfaceTest::Messages messages(filter);
  filter->SetInputData(sphere.Cloud);
  filter->Update();
  check(messages.Contain("2 of 1002 points"), "one warning with the count");
  vtkDataArray* normals = filter->GetOutput()->GetPointData()->GetNormals();
  check(
    std::equal(expected->GetNumberOfValues() ? vtkFloatArray::SafeDownCast(expected)->GetPointer(0)
                                             : nullptr,
      vtkFloatArray::SafeDownCast(expected)->GetPointer(0) + expected->GetNumberOfValues(),
      vtkFloatArray::SafeDownCast(normals)->GetPointer(0)),
    "the others as without them");
  check(
    vtkMath::Norm(normals->GetTuple(1000)) == 0.0 && vtkMath::Norm(normals->GetTuple(1001)) == 0.0,
    "zero normals for points that are not finite");

  // Few points, points on a line, one position: some unit normal, and no message.
  vtkNew<vtkPointNormals> quiet;
  PointSurfaceTest::Messages none(quiet);
  Sample few;
  quiet->SetInputData(few.Cloud);
  quiet->Update();
  normals = quiet->GetOutput()->GetPointData()->GetNormals();
  check(normals && normals->GetNumberOfTuples() == 0, "no points");
  vtkNew<vtkPolyData> bare;
  quiet->SetInputData(bare);
  quiet->Update();
  for (int i = 0; i < 40; ++i)
  {
    few.Add({ 1.0 * (i / 2), 2.0 * (i / 2), 0.0 }, { 0, 0, 1 });
    few.Cloud->Modified();
    quiet->SetInputData(few.Cloud);
    quiet->Update();
    check(AreUnit(quiet->GetOutput()->GetPointData()->GetNormals()),
      std::to_string(i + 1) + " points on a line");
  }
  vtkDataArray* line = quiet->GetOutput()->GetPointData()->GetNormals();
  check(std::abs(line->GetComponent(20, 0) + 2.0 * line->GetComponent(20, 1)) < 1e-5,
    "normals across a line");
  check(none.GetCount() == 0, "no messages");

  check(PointSurfaceTest::Abort(quiet) && !quiet->GetOutput()->GetPointData()->GetNormals(),
    "an aborted filter gives no normals");
}

//------------------------------------------------------------------------------
void TestThreads(PointSurfaceTest::Checks& check)
{
  const Sample torus = Torus(5000);
  check(PointSurfaceTest::IsSameForAnyThreads(
          [&] { return std::vector<vtkSmartPointer<vtkDataArray>>{ Normals(torus.Cloud) }; }),
    "the same bits for any backend and number of threads");
}
} // anonymous namespace

int TestPointNormals(int, char*[])
{
  PointSurfaceTest::Checks check;
  TestAccuracy(check);
  TestOrientation(check);
  TestFaults(check);
  TestThreads(check);
  return check.GetResult();
}
