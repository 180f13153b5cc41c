// SPDX-License-Identifier: BSD-3-Clause
// What the tests share: checks that print their figure, clouds of known surfaces, caught warnings.
#ifndef PointSurfaceTestUtilities_h
#define PointSurfaceTestUtilities_h

#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <iostream>
#include <string>

namespace PointSurfaceTest
{
/// Checks that failed so far.
inline int& Failures()
{
  static int failures = 0;
  return failures;
}

inline bool Check(bool holds, const std::string& what)
{
  if (!holds)
  {
    ++Failures();
  }
  std::cout << (holds ? "ok      " : "FAILED  ") << what << std::endl;
  return holds;
}

inline bool CheckAtMost(double value, double limit, const std::string& what)
{
  return Check(
    value <= limit, what + ": " + std::to_string(value) + ", at most " + std::to_string(limit));
}

inline bool CheckAtLeast(double value, double limit, const std::string& what)
{
  return Check(
    value >= limit, what + ": " + std::to_string(value) + ", at least " + std::to_string(limit));
}

/**
 * Points of the unit sphere, evenly spread, with outward normals and radii of 1.5 times their
 * spacing in an array "radius".
 */
inline vtkSmartPointer<vtkPolyData> MakeSphereCloud(int count)
{
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  const double golden = vtkMath::Pi() * (1.0 + std::sqrt(5.0));
  const double radius = 1.5 * std::sqrt(4.0 * vtkMath::Pi() / count);
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - 2.0 * (i + 0.5) / count;
    const double r = std::sqrt(1.0 - z * z);
    const double n[3] = { r * std::cos(golden * i), r * std::sin(golden * i), z };
    points->InsertNextPoint(n);
    normals->InsertNextTuple(n);
    radii->InsertNextValue(static_cast<float>(radius));
  }
  cloud->SetPoints(points);
  cloud->GetPointData()->SetNormals(normals);
  cloud->GetPointData()->AddArray(radii);
  return cloud;
}
}

#endif
