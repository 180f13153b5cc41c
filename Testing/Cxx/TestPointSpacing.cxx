// SPDX-License-Identifier: BSD-3-Clause
// vtkPointSpacing on lattices and random samples of known density, and on data with faults.
#include "PointSurfaceTestUtilities.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkPointData.h"
#include "vtkPointSpacing.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
using Cloud = vtkSmartPointer<vtkPolyData>;

Cloud MakeCloud(int type = VTK_DOUBLE)
{
  auto cloud = Cloud::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  cloud->SetPoints(points);
  return cloud;
}

// Spacings in the order of the points.
std::vector<double> Spacings(vtkPolyData* cloud, int neighbors = 12)
{
  vtkNew<vtkPointSpacing> filter;
  filter->SetInputData(cloud);
  filter->SetScale(1.0);
  filter->SetNumberOfNeighbors(neighbors);
  filter->Update();
  vtkDataArray* radii = filter->GetOutput()->GetPointData()->GetArray("radius");
  std::vector<double> spacings;
  for (vtkIdType id = 0; radii && id < radii->GetNumberOfTuples(); ++id)
  {
    spacings.push_back(radii->GetTuple1(id));
  }
  return spacings;
}

double Median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values.empty() ? -1.0 : values[values.size() / 2];
}

double RelativeError(double value, double expected)
{
  return std::abs(value / expected - 1.0);
}

// n x n points, each with an area of its own of h^2.
Cloud SquareLattice(int n, double h, const double origin[3])
{
  Cloud cloud = MakeCloud();
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      cloud->GetPoints()->InsertNextPoint(origin[0] + i * h, origin[1] + j * h, origin[2]);
    }
  }
  return cloud;
}

Cloud HexagonalLattice(int n, double area)
{
  const double h = std::sqrt(area * 2.0 / std::sqrt(3.0));
  Cloud cloud = MakeCloud();
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      cloud->GetPoints()->InsertNextPoint((i + 0.5 * (j % 2)) * h, j * h * std::sqrt(0.75), 0.0);
    }
  }
  return cloud;
}

// Points on the unit sphere, independent of each other.
Cloud RandomSphere(int n)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(3);
  Cloud cloud = MakeCloud(VTK_FLOAT);
  for (int i = 0; i < n; ++i)
  {
    const double z = 2.0 * random->GetNextValue() - 1.0;
    const double angle = 2.0 * vtkMath::Pi() * random->GetNextValue();
    const double r = std::sqrt(1.0 - z * z);
    cloud->GetPoints()->InsertNextPoint(r * std::cos(angle), r * std::sin(angle), z);
  }
  return cloud;
}

//------------------------------------------------------------------------------
void TestDensity(PointSurfaceTest::Checks& check)
{
  const double zero[3] = { 0, 0, 0 };
  Cloud square = SquareLattice(41, 0.5, zero);
  check.AtMost(RelativeError(Median(Spacings(square)), 0.5), 0.05, "square lattice");
  check.AtMost(
    RelativeError(Median(Spacings(HexagonalLattice(41, 0.25))), 0.5), 0.06, "hexagonal lattice");
  // The formula itself, at a point with whole shells of neighbours about it.
  const double middle = Spacings(square, 8)[20 * 41 + 20];
  check.AtMost(RelativeError(middle, 0.5 * std::sqrt(2.0 * vtkMath::Pi() / 8.0)), 1e-6,
    "d sqrt(pi / k) of the 8th neighbour");
  for (int n : { 2000, 50000 })
  {
    const double expected = std::sqrt(4.0 * vtkMath::Pi() / n);
    const std::vector<double> spacings = Spacings(RandomSphere(n));
    check.AtMost(
      RelativeError(Median(spacings), expected), 0.05, std::to_string(n) + " points on a sphere");
    check(*std::max_element(spacings.begin(), spacings.end()) < 3.0 * expected,
      "no absurd spacing on a sphere");
  }
  // Centimetres at 10^7, as against the same lattice at the origin.
  const double far[3] = { 1e7, -5.4e6, 500.0 };
  const std::vector<double> expected = Spacings(SquareLattice(30, 0.01, zero));
  const std::vector<double> spacings = Spacings(SquareLattice(30, 0.01, far));
  double largest = 0.0;
  for (std::size_t i = 0; i < spacings.size(); ++i)
  {
    largest = std::max(largest, RelativeError(spacings[i], expected[i]));
  }
  check.AtMost(largest, 1e-5, "centimetres at 10^7");
}

//------------------------------------------------------------------------------
void TestTwins(PointSurfaceTest::Checks& check)
{
  const double zero[3] = { 0, 0, 0 };
  Cloud once = SquareLattice(20, 1.0, zero);
  Cloud thrice = MakeCloud();
  for (vtkIdType id = 0; id < 3 * once->GetNumberOfPoints(); ++id)
  {
    thrice->GetPoints()->InsertNextPoint(once->GetPoint(id % once->GetNumberOfPoints()));
  }
  const std::vector<double> expected = Spacings(once);
  const std::vector<double> spacings = Spacings(thrice);
  bool same = spacings.size() == 3 * expected.size();
  for (std::size_t i = 0; same && i < spacings.size(); ++i)
  {
    same = spacings[i] == expected[i % expected.size()];
  }
  check(same, "twins do not count as neighbours");
}

//------------------------------------------------------------------------------
void TestOutliers(PointSurfaceTest::Checks& check)
{
  const double zero[3] = { 0, 0, 0 };
  Cloud cloud = SquareLattice(40, 1.0, zero);
  cloud->GetPoints()->InsertNextPoint(20.0, 20.0, 3000.0);
  std::vector<double> spacings = Spacings(cloud);
  check.AtMost(RelativeError(spacings.back(), 10.0 * Median(spacings)), 1e-6, "outlier is cut");

  vtkNew<vtkPointSpacing> filter;
  filter->SetInputData(cloud);
  filter->SetMaximumSpacing(1e9);
  filter->SetRadiusArrayName("size");
  filter->Update();
  check(filter->GetOutput()->GetPointData()->GetArray("size")->GetRange()[1] > 2000.0,
    "outlier is not cut where that is not wanted");

  // NaN and infinite points neither spoil the others nor go without a radius.
  const vtkIdType outlier = cloud->GetNumberOfPoints() - 1;
  cloud->GetPoints()->SetPoint(outlier, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  cloud->GetPoints()->InsertNextPoint(0.0, std::numeric_limits<double>::infinity(), 0.0);
  filter->SetInputData(cloud);
  filter->SetScale(1.0);
  PointSurfaceTest::Messages messages(filter);
  filter->Update();
  check(messages.Contain("2 of 1602 points"), "one warning with the count");
  vtkDataArray* radii = filter->GetOutput()->GetPointData()->GetArray("size");
  spacings = Spacings(SquareLattice(40, 1.0, zero));
  bool same = radii->GetTuple1(outlier) == Median(spacings) &&
    radii->GetTuple1(outlier + 1) == Median(spacings);
  for (vtkIdType id = 0; id < outlier; ++id)
  {
    same = same && radii->GetTuple1(id) == spacings[id];
  }
  check(same, "the median for points that are not finite, the rest as without them");
}

//------------------------------------------------------------------------------
void TestFewPoints(PointSurfaceTest::Checks& check)
{
  Cloud cloud = MakeCloud();
  vtkNew<vtkPointSpacing> filter;
  filter->SetInputData(cloud);
  PointSurfaceTest::Messages messages(filter);
  filter->Update();
  vtkDataArray* radii = filter->GetOutput()->GetPointData()->GetArray("radius");
  check(radii && radii->GetNumberOfTuples() == 0 && messages.GetCount() == 0, "no points");

  vtkNew<vtkPolyData> bare; // not even an empty vtkPoints
  filter->SetInputData(bare);
  filter->Update();
  check(messages.GetCount() == 0, "no vtkPoints");

  for (int i = 0; i < 100; ++i)
  {
    cloud->GetPoints()->InsertNextPoint(1, 2, 3);
  }
  filter->SetInputData(cloud);
  filter->Update();
  radii = filter->GetOutput()->GetPointData()->GetArray("radius");
  check(messages.Contain("100 points share one position") && radii->GetRange()[1] == 0.0,
    "coincident points");

  cloud->GetPoints()->SetPoint(7, 1, 2, 5);
  std::vector<double> spacings = Spacings(cloud);
  check.AtMost(RelativeError(spacings[0], 2.0 * std::sqrt(vtkMath::Pi())), 1e-6, "two positions");
  check(spacings[7] == spacings[0], "two positions, the other");

  Cloud line = MakeCloud();
  for (int i = 0; i < 50; ++i)
  {
    line->GetPoints()->InsertNextPoint(i, 2.0 * i, -i);
  }
  spacings = Spacings(line, 4);
  check.AtMost(RelativeError(spacings[25], 2.0 * std::sqrt(6.0 * vtkMath::Pi() / 4.0)), 1e-6,
    "points on a line");
}

//------------------------------------------------------------------------------
void TestCitizenship(PointSurfaceTest::Checks& check)
{
  Cloud cloud = RandomSphere(20000);
  check(PointSurfaceTest::IsSameForAnyThreads(
          [&]
          {
            vtkNew<vtkPointSpacing> filter;
            filter->SetInputData(cloud);
            filter->Update();
            return std::vector<vtkSmartPointer<vtkDataArray>>{
              filter->GetOutput()->GetPointData()->GetArray("radius")
            };
          }),
    "the same bits for any backend and number of threads");

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(cloud->GetPoints());
  vtkNew<vtkPointSpacing> filter;
  filter->SetInputData(grid);
  filter->SetScale(3.0);
  filter->Update();
  const std::vector<double> spacings = Spacings(cloud);
  vtkDataArray* radii = filter->GetOutput()->GetPointData()->GetArray("radius");
  check(vtkUnstructuredGrid::SafeDownCast(filter->GetOutput()) != nullptr &&
      RelativeError(radii->GetTuple1(5), 3.0 * spacings[5]) < 1e-6,
    "any point set, and the scale");
  check(PointSurfaceTest::Abort(filter) && !filter->GetOutput()->GetPointData()->HasArray("radius"),
    "an aborted filter gives no radii");
}
} // anonymous namespace

int TestPointSpacing(int, char*[])
{
  PointSurfaceTest::Checks check;
  TestDensity(check);
  TestTwins(check);
  TestOutliers(check);
  TestFewPoints(check);
  TestCitizenship(check);
  return check.GetResult();
}
