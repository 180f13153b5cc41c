// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceMapperFactory.h"

#include "vtkAlgebraicSplatMapper.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDirectPointMapper.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPullPushMapper.h"
#include "vtkRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceSplatMapper.h"

#include <algorithm>
#include <limits>
#include <vector>

vtkStandardNewMacro(vtkPointSurfaceMapperFactory);

namespace
{
// Largest over smallest radius that a mapper stands; see Testing/Python/test_stability.py.
constexpr double VaryingForDirect = 10.0;
constexpr double VaryingForSplats = 50.0;

std::vector<vtkPointSet*> GetPointSets(vtkDataObject* cloud)
{
  std::vector<vtkPointSet*> sets;
  const auto add = [&sets](vtkDataObject* data)
  {
    vtkPointSet* set = vtkPointSet::SafeDownCast(data);
    if (set && set->GetNumberOfPoints() > 0)
    {
      sets.push_back(set);
    }
  };
  add(cloud);
  if (auto* tree = vtkCompositeDataSet::SafeDownCast(cloud))
  {
    vtkSmartPointer<vtkCompositeDataIterator> iterator;
    iterator.TakeReference(tree->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      add(iterator->GetCurrentDataObject());
    }
  }
  return sets;
}

/// Largest over smallest radius of all points; 1 where no radii are told.
double GetVariation(const std::vector<vtkPointSet*>& sets)
{
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (vtkPointSet* set : sets)
  {
    if (vtkDataArray* radii = set->GetPointData()->GetArray("radius"))
    {
      double range[2];
      radii->GetFiniteRange(range);
      smallest = std::min(smallest, range[0]);
      largest = std::max(largest, range[1]);
    }
  }
  return smallest > 0.0 && largest > 0.0 ? largest / smallest : 1.0;
}

bool IsRunByProcessor(int backend)
{
  if (backend != vtkPointSurfaceMapper::Automatic)
  {
    return backend == vtkPointSurfaceMapper::CPU;
  }
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetSize(1, 1);
  window->Render();
  return vtkPointSurfaceMapper::IsSoftwareRasterizer();
}
}

vtkPointSurfaceMapper* vtkPointSurfaceMapperFactory::NewMapper(vtkDataObject* cloud, int backend)
{
  const std::vector<vtkPointSet*> sets = GetPointSets(cloud);
  const bool hasSplats = std::any_of(sets.begin(), sets.end(),
    [](vtkPointSet* set) { return set->GetPointData()->HasArray("SplatCoefficients"); });
  const bool hasNormals = !sets.empty() &&
    std::all_of(sets.begin(), sets.end(),
      [](vtkPointSet* set) { return set->GetPointData()->GetNormals() != nullptr; });
  const double variation = GetVariation(sets);

  vtkPointSurfaceMapper* mapper;
  if (hasSplats)
  {
    mapper = vtkAlgebraicSplatMapper::New();
  }
  else if (!hasNormals && variation <= VaryingForDirect)
  {
    mapper = vtkDirectPointMapper::New();
  }
  else if (hasNormals && variation <= VaryingForSplats && IsRunByProcessor(backend))
  {
    mapper = vtkSurfaceSplatMapper::New();
  }
  else
  {
    mapper = vtkPullPushMapper::New();
  }
  mapper->SetBackend(backend);
  return mapper;
}
