// SPDX-License-Identifier: BSD-3-Clause
#ifndef PointSurfaceTestUtilities_h
#define PointSurfaceTestUtilities_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace PointSurfaceTest
{
/**
 * Counts what does not hold, and says it on standard output, where ctest looks for "ERROR:".
 */
class Checks
{
public:
  void operator()(bool holds, const std::string& what)
  {
    if (!holds)
    {
      ++this->Failures;
      std::cout << "ERROR: " << what << std::endl;
    }
  }

  /**
   * For measured values: fails above the bound and for NaN.
   */
  void AtMost(double value, double bound, const std::string& what)
  {
    std::cout << what << ": " << value << " (at most " << bound << ")" << std::endl;
    (*this)(value <= bound, what);
  }

  void AtLeast(double value, double bound, const std::string& what)
  {
    std::cout << what << ": " << value << " (at least " << bound << ")" << std::endl;
    (*this)(value >= bound, what);
  }

  int GetResult() const { return this->Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE; }

private:
  int Failures = 0;
};

/**
 * The text of the errors and warnings of an object, which are then not displayed.
 */
class Messages
{
public:
  explicit Messages(vtkObject* object)
  {
    object->AddObserver(vtkCommand::ErrorEvent, this, &Messages::Add);
    object->AddObserver(vtkCommand::WarningEvent, this, &Messages::Add);
  }
  int GetCount() const { return static_cast<int>(this->Texts.size()); }
  bool Contain(const std::string& text) const
  {
    return this->GetCount() == 1 && this->Texts[0].find(text) != std::string::npos;
  }

private:
  void Add(vtkObject*, unsigned long, void* text)
  {
    this->Texts.emplace_back(static_cast<const char*>(text));
  }
  std::vector<std::string> Texts;
};

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

/**
 * Two spheres of radius 1 and 0.5, the small one partly before the other, sampled at random, with
 * normals, scalars from -1 to 1 and radii that vary.
 */
inline vtkSmartPointer<vtkPolyData> MakeTwoSpheres(int count)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(7);
  auto next = [&]()
  {
    random->Next();
    return random->GetValue();
  };
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetName("Normals");
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  const double spacing = std::sqrt(4.0 * vtkMath::Pi() / count);
  for (int i = 0; i < count; ++i)
  {
    const double z = 2.0 * next() - 1.0;
    const double angle = 2.0 * vtkMath::Pi() * next();
    const double r = std::sqrt(1.0 - z * z);
    const double n[3] = { r * std::cos(angle), r * std::sin(angle), z };
    const double size = i % 2 ? 1.0 : 0.5;
    const double shift = i % 2 ? 0.0 : 1.1;
    points->InsertNextPoint(
      size * n[0] + 0.4 * shift, size * n[1] + 0.2 * shift, size * n[2] + shift);
    normals->InsertNextTuple(n);
    radii->InsertNextValue(static_cast<float>(2.0 * size * spacing * (1.0 + 0.4 * next())));
    height->InsertNextValue(static_cast<float>(n[1]));
  }
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(points);
  cloud->GetPointData()->SetNormals(normals);
  cloud->GetPointData()->AddArray(radii);
  cloud->GetPointData()->SetScalars(height);
  return cloud;
}

/**
 * A file of the shared test data, or "" with a word that the test is skipped.
 */
inline std::string SharedData(const std::string& path)
{
#ifdef POINTSURFACE_SHARED_DATA
  return POINTSURFACE_SHARED_DATA "/" + path;
#else
  std::cout << "skipped: ../shared/data is absent (" << path << ")" << std::endl;
  return "";
#endif
}

/**
 * Calls `make` with each backend and several numbers of threads; whether the arrays that it returns
 * are the same each time, bit for bit.
 */
inline bool IsSameForAnyThreads(
  const std::function<std::vector<vtkSmartPointer<vtkDataArray>>()>& make)
{
  std::vector<vtkSmartPointer<vtkDataArray>> first;
  const std::string backend = vtkSMPTools::GetBackend();
  bool same = true;
  for (const char* name : { "Sequential", "STDThread", "TBB" })
  {
    for (int threads : { 1, 2, 4 })
    {
      if (!vtkSMPTools::SetBackend(name))
      {
        continue; // not in this VTK
      }
      vtkSMPTools::Initialize(threads);
      const auto arrays = make();
      if (first.empty())
      {
        first = arrays;
      }
      for (std::size_t i = 0; i < arrays.size(); ++i)
      {
        const std::size_t bytes =
          static_cast<std::size_t>(first[i]->GetNumberOfValues()) * first[i]->GetDataTypeSize();
        same = same && arrays[i]->GetNumberOfValues() == first[i]->GetNumberOfValues() &&
          std::memcmp(arrays[i]->GetVoidPointer(0), first[i]->GetVoidPointer(0), bytes) == 0;
      }
    }
  }
  vtkSMPTools::SetBackend(backend.c_str());
  vtkSMPTools::Initialize();
  return same && !first.empty() && first[0]->GetNumberOfValues() > 0;
}

/**
 * Updates a filter that is told to abort by its first progress event; returns whether one came.
 */
inline bool Abort(vtkAlgorithm* filter)
{
  struct Aborter
  {
    bool Called = false;
    void Execute(vtkObject* caller, unsigned long, void*)
    {
      this->Called = true;
      static_cast<vtkAlgorithm*>(caller)->AbortExecuteOn();
    }
  } aborter;
  const unsigned long tag =
    filter->AddObserver(vtkCommand::ProgressEvent, &aborter, &Aborter::Execute);
  filter->Modified();
  filter->Update();
  filter->RemoveObserver(tag);
  filter->AbortExecuteOff();
  return aborter.Called;
}
} // namespace PointSurfaceTest

#endif
