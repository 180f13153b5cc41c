// SPDX-License-Identifier: BSD-3-Clause
// vtkAlgebraicSplats and vtkLocallyOptimalProjection on a sphere, whose points, normals and
// curvature are known, with every order and selection; on input that has too little in it, or what
// is no number; the same with any number of threads. (How well patches fit is tested in Python.)

#include "PointSurfaceTestUtilities.h"

#include "vtkAlgebraicSplats.h"
#include "vtkLocallyOptimalProjection.h"

#include <algorithm>
#include <limits>

using namespace PointSurfaceTest;

namespace
{
Checks check;

/// The largest distance of a point from the unit sphere.
double GetDistance(vtkPolyData* data)
{
  double worst = 0.0;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    worst = std::max(worst, std::abs(vtkMath::Norm(data->GetPoint(i)) - 1.0));
  }
  return worst;
}

void TestSphere()
{
  constexpr int Count = 600;
  const auto cloud = MakeSphereCloud(Count);
  for (int selection = 0; selection <= vtkAlgebraicSplats::FIXED_COUNT; ++selection)
  {
    for (int order = 1; order <= 4; ++order)
    {
      const std::string name =
        "selection " + std::to_string(selection) + ", order " + std::to_string(order);
      vtkNew<vtkAlgebraicSplats> splats;
      splats->SetInputData(cloud);
      splats->SetOrder(order);
      splats->SetSelection(selection);
      splats->SetNumberOfSplats(300);
      splats->SetNumberOfNeighbors(24);
      splats->ComputeErrorsOn();
      splats->Update();
      vtkPolyData* output = splats->GetOutput();
      const vtkIdType made = output->GetNumberOfPoints();
      check(selection == vtkAlgebraicSplats::ALL_POINTS ? made == Count
          : selection == vtkAlgebraicSplats::HOLE_FREE  ? made > 20 && made < Count / 4
                                                        : made == 300,
        name + ": as many splats as are wanted");
      check(output->GetPointData()->GetArray("SplatCoefficients")->GetNumberOfComponents() ==
          (order + 1) * (order + 2) / 2,
        name + ": coefficients");
      check.AtMost(GetDistance(output), 0.08, name + ": centres, off the sphere");
      double worst = 0.0;
      vtkDataArray* normals = output->GetPointData()->GetNormals();
      for (vtkIdType i = 0; i < made; ++i)
      {
        double x[3];
        output->GetPoint(i, x);
        vtkMath::Normalize(x);
        worst = std::max(worst, 1.0 - vtkMath::Dot(x, normals->GetTuple(i)));
      }
      check.AtMost(worst, 0.01, name + ": 1 - cosine of normal and radius");
      check(splats->GetTotalError() > 0.0 && std::isfinite(splats->GetTotalError()),
        name + ": an error is told");
    }
  }

  vtkNew<vtkLocallyOptimalProjection> projection;
  projection->SetInputData(cloud);
  projection->SetNumberOfPoints(300);
  projection->Update();
  check(projection->GetOutput()->GetNumberOfPoints() == 300, "projection: as many points");
  check.AtMost(GetDistance(projection->GetOutput()), 0.08, "projection: points, off the sphere");
}

vtkSmartPointer<vtkPolyData> MakeCloud(int count, const std::function<void(int, double*)>& place)
{
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  for (int i = 0; i < count; ++i)
  {
    double x[3] = { 0.0, 0.0, 0.0 };
    place(i, x);
    points->InsertNextPoint(x);
  }
  cloud->SetPoints(points);
  return cloud;
}

/// Each filter takes it, and gives as many points as there are distinct finite ones at most, all
/// finite.
void TryBad(const std::string& name, vtkPolyData* cloud, int distinct)
{
  vtkNew<vtkAlgebraicSplats> splats;
  vtkNew<vtkLocallyOptimalProjection> projection;
  projection->SetNumberOfPoints(10);
  for (vtkPolyDataAlgorithm* filter :
    std::vector<vtkPolyDataAlgorithm*>{ splats.Get(), projection.Get() })
  {
    Messages messages(filter);
    filter->SetInputDataObject(cloud);
    for (int order = 1; order <= 4; ++order)
    {
      splats->SetOrder(order);
      filter->Update();
      vtkPolyData* output = filter->GetOutput();
      check(output->GetNumberOfPoints() <= distinct, name + ": no points out of nothing");
      check(distinct == 0 || output->GetNumberOfPoints() > 0, name + ": points");
      bool finite = true;
      for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
      {
        finite = finite && std::isfinite(vtkMath::Norm(output->GetPoint(i)));
      }
      check(finite, name + ": finite points");
    }
  }
}

void TestBadInput()
{
  constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();
  TryBad("no points", MakeCloud(0, [](int, double*) {}), 0);
  TryBad("one point", MakeCloud(1, [](int, double*) {}), 1);
  TryBad("three points", MakeCloud(3, [](int i, double* x) { x[i] = 1.0; }), 3);
  TryBad("one place", MakeCloud(100, [](int, double*) {}), 1);
  TryBad("a line", MakeCloud(100, [](int i, double* x) { x[0] = i; }), 100);
  TryBad("two clusters far apart",
    MakeCloud(100, [](int i, double* x) { x[0] = 1e12 * (i % 2), x[1] = i, x[2] = i * i; }), 100);
  TryBad("nothing but NaN", MakeCloud(20, [](int, double* x) { x[1] = NotANumber; }), 0);
  TryBad("some NaN and infinities",
    MakeCloud(100,
      [](int i, double* x)
      {
        x[0] = i % 10;
        x[1] = i / 10;
        x[2] = i == 7 ? NotANumber : i == 33 ? VTK_DOUBLE_MAX * 10.0 : 0.0;
      }),
    98);
}

void TestThreads()
{
  const auto cloud = MakeSphereCloud(1000);
  check(IsSameForAnyThreads(
          [&]
          {
            vtkNew<vtkAlgebraicSplats> splats;
            splats->SetInputData(cloud);
            splats->SetSelectionToFixedCount();
            splats->SetNumberOfSplats(50);
            splats->SetNumberOfNeighbors(20);
            splats->Update();
            vtkPolyData* output = splats->GetOutput();
            return std::vector<vtkSmartPointer<vtkDataArray>>{ output->GetPoints()->GetData(),
              output->GetPointData()->GetArray("SplatCoefficients") };
          }),
    "the same splats with any number of threads");
  vtkNew<vtkAlgebraicSplats> splats;
  splats->SetInputData(cloud);
  check(Abort(splats) && splats->GetOutput()->GetNumberOfPoints() == 0, "an abort leaves nothing");
}
}

int TestAlgebraicSplats(int, char*[])
{
  TestSphere();
  TestBadInput();
  TestThreads();
  return check.GetResult();
}
