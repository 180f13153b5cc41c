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
#include <cmath>
#include <cstddef>
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

/// Largest over smallest radius of all points but a thousandth at either end; 1 where no radii are
/// told. Of an isosurface's points a few have hardly a radius, where voxels are near the isovalue;
/// they say nothing of how dense the others lie.
double GetVariation(const std::vector<vtkPointSet*>& sets)
{
  constexpr vtkIdType most = 100000; // of a set that are looked at
  std::vector<double> sample;
  for (vtkPointSet* set : sets)
  {
    if (vtkDataArray* radii = set->GetPointData()->GetArray("radius"))
    {
      const vtkIdType step = 1 + radii->GetNumberOfTuples() / most;
      for (vtkIdType i = 0; i < radii->GetNumberOfTuples(); i += step)
      {
        const double radius = radii->GetComponent(i, 0);
        if (radius > 0.0 && std::isfinite(radius))
        {
          sample.push_back(radius);
        }
      }
    }
  }
  if (sample.empty())
  {
    return 1.0;
  }
  std::sort(sample.begin(), sample.end());
  const std::size_t end = sample.size() / 1000;
  return sample[sample.size() - 1 - end] / sample[end];
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
