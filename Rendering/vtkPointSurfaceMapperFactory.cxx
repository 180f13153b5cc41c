// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceMapperFactory.h"

#include "vtkAlgebraicSplatMapper.h"
#include "vtkDistinctPoints.h"
#include "vtkMovingLeastSquares.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDirectPointMapper.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPullPushMapper.h"
#include "vtkRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkStaticPointLocator.h"
#include "vtkSurfaceSplatMapper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

vtkStandardNewMacro(vtkPointSurfaceMapperFactory);

namespace
{
// Largest over smallest radius that a mapper stands; see Testing/Python/test_stability.py.
constexpr double VaryingForDirect = 10.0;
constexpr double VaryingForSplats = 50.0;

// Points whose normals are estimated in about a second.
constexpr vtkIdType MostToEstimate = 200000;
// Spacings. Evenly noisy points have noise of 0.25 spacings then, with which estimated normals make
// better pictures, or a little more; with 0.5 most do not.
constexpr double MostNoise = 0.35;
constexpr double NoisyShare = 0.1; // of the points, that may have more
constexpr vtkIdType NoiseSamples = 400;
constexpr vtkIdType NoiseNeighbors = 24;

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

/// Appends for every step-th point how far its neighbours lie off the quadric through them, in mean
/// spacings; infinite where they determine none, as on a line.
void AppendNoise(vtkPointSet* set, vtkIdType step, std::vector<double>& noise)
{
  const vtkDistinctPoints distinct(set);
  vtkPolyData* cloud = distinct.GetCloud();
  if (cloud->GetNumberOfPoints() == 0)
  {
    return; // none is finite, and the locator would tell an error
  }
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(cloud);
  locator->BuildLocator();
  vtkNew<vtkIdList> ids;
  vtkMovingLeastSquares fitter;
  fitter.Order = 2;
  for (vtkIdType id = 0; id < cloud->GetNumberOfPoints(); id += step)
  {
    vtkMovingLeastSquares::Vector center;
    cloud->GetPoint(id, center.data());
    locator->FindClosestNPoints(NoiseNeighbors, center.data(), ids);
    fitter.Neighbors.resize(ids->GetNumberOfIds());
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      cloud->GetPoint(ids->GetId(i), fitter.Neighbors[i].data());
      vtkMath::Subtract(fitter.Neighbors[i], center, fitter.Neighbors[i]);
    }
    const vtkAlgebraicSplat quadric = fitter.Fit(center, {}, 0.0, 1.0);
    // of points spread evenly over a disc, whose mean distance from its centre is two thirds of its
    // radius
    const double spacing =
      1.5 * quadric.FeatureSize * std::sqrt(vtkMath::Pi() / ids->GetNumberOfIds());
    noise.push_back(quadric.Order < fitter.Order ? std::numeric_limits<double>::infinity()
                                                 : quadric.Residual / spacing);
  }
}

/// What AppendNoise() has of all points but for NoisyShare.
double GetNoise(const std::vector<vtkPointSet*>& sets, vtkIdType count)
{
  std::vector<double> noise;
  for (vtkPointSet* set : sets)
  {
    AppendNoise(set, 1 + count / NoiseSamples, noise);
  }
  if (noise.empty())
  {
    return std::numeric_limits<double>::infinity();
  }
  const auto last = noise.end() - 1 - static_cast<std::ptrdiff_t>(NoisyShare * noise.size());
  std::nth_element(noise.begin(), last, noise.end());
  return *last;
}

/// Whether normals are there, or make a better picture than none after a wait that is not long.
bool AreNormalsOfUse(const std::vector<vtkPointSet*>& sets)
{
  std::vector<vtkPointSet*> without;
  vtkIdType count = 0;
  for (vtkPointSet* set : sets)
  {
    if (!set->GetPointData()->GetNormals())
    {
      without.push_back(set);
      count += set->GetNumberOfPoints();
    }
  }
  return !sets.empty() && count <= MostToEstimate &&
    (without.empty() || GetNoise(without, count) <= MostNoise);
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
  const double variation = GetVariation(sets);

  const bool byNormals = !hasSplats && AreNormalsOfUse(sets);

  vtkPointSurfaceMapper* mapper;
  if (hasSplats)
  {
    mapper = vtkAlgebraicSplatMapper::New();
  }
  else if (!byNormals && variation <= VaryingForDirect)
  {
    mapper = vtkDirectPointMapper::New();
  }
  else if (byNormals && variation <= VaryingForSplats && IsRunByProcessor(backend))
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
