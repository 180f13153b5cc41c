// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDrawableSplats.h"

#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace
{
/// A splat of this many times the cloud's diagonal is taken for a fault in the data.
constexpr double LargestRadius = 100.0;

/// The array if it has a tuple a point and that many components at least; else says why not.
vtkDataArray* Require(vtkDataArray* array, const std::string& name, int components,
  vtkIdType splats, std::vector<std::string>& remarks)
{
  if (array && array->GetNumberOfTuples() == splats && array->GetNumberOfComponents() >= components)
  {
    return array;
  }
  std::ostringstream line;
  if (array)
  {
    line << "Array '" << name << "' has " << array->GetNumberOfTuples() << " tuples of "
         << array->GetNumberOfComponents() << " components for " << splats << " splats, where "
         << components << " components are needed";
  }
  else
  {
    line << "The input has no point array '" << name << "'";
  }
  line << ": nothing is drawn. Make splats of points with vtkAlgebraicSplats.";
  remarks.push_back(line.str());
  return nullptr;
}

/// Bounds of the polynomial over the unit disc.
std::array<float, 2> GetHeights(const float* c, int order)
{
  auto coefficient = [&](int a, int b) -> double
  { return a + b <= order ? c[vtkAlgebraicSplat::Index(a, b)] : 0.0; };
  const double slope = std::hypot(coefficient(1, 0), coefficient(0, 1));
  // the quadratic form between its eigenvalues
  const double middle = 0.5 * (coefficient(2, 0) + coefficient(0, 2));
  const double half =
    std::hypot(0.5 * (coefficient(2, 0) - coefficient(0, 2)), 0.5 * coefficient(1, 1));
  double rest = 0.0;
  for (int degree = 3; degree <= order; ++degree)
  {
    for (int b = 0; b <= degree; ++b)
    {
      rest += std::abs(coefficient(degree - b, b));
    }
  }
  const double margin = 1e-4 + slope + rest;
  return { static_cast<float>(c[0] + std::min(middle - half, 0.0) - margin),
    static_cast<float>(c[0] + std::max(middle + half, 0.0) + margin) };
}

bool IsFinite(const std::array<float, 3>& v)
{
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}
}

vtkIdType vtkDrawableSplats::GetNumberOfSplats() const
{
  vtkIdType count = 0;
  for (const auto& group : this->Groups)
  {
    count += static_cast<vtkIdType>(group.size());
  }
  return count;
}

std::vector<vtkDrawableSplats::Range> vtkDrawableSplats::GetRanges(
  int order, const std::vector<Range>& ofPoints) const
{
  const std::vector<Splat>& splats = this->GetSplats(order);
  auto find = [&splats](vtkIdType position)
  {
    return static_cast<vtkIdType>(
      std::lower_bound(splats.begin(), splats.end(), position,
        [](const Splat& splat, vtkIdType sought) { return splat.Position < sought; }) -
      splats.begin());
  };
  std::vector<Range> ranges;
  for (const Range& range : ofPoints)
  {
    const Range found = { find(range[0]), find(range[1]) };
    if (found[0] < found[1])
    {
      ranges.push_back(found);
    }
  }
  return ranges;
}

std::vector<std::string> vtkDrawableSplats::Build(vtkPolyData* cloud, vtkDataArray* normals,
  const std::vector<unsigned int>& ids, const double bounds[6], double diagonal)
{
  std::vector<std::string> remarks;
  for (auto& group : this->Groups)
  {
    group.clear();
  }
  for (int k = 0; k < 3; ++k)
  {
    this->Origin[k] = 0.5 * (bounds[2 * k] + bounds[2 * k + 1]);
  }
  this->Reach = 0.0;
  this->MeanRadius = 0.0;
  auto require = [&](const char* name, int components)
  {
    return Require(
      cloud->GetPointData()->GetArray(name), name, components, cloud->GetNumberOfPoints(), remarks);
  };
  vtkDataArray* coefficients = require("SplatCoefficients", 3);
  vtkDataArray* orders = coefficients ? require("SplatOrder", 1) : nullptr;
  vtkDataArray* axes = orders ? require("SplatAxes", 3) : nullptr;
  vtkDataArray* radii = axes ? require("radius", 1) : nullptr;
  if (!radii ||
    !Require(normals, normals && normals->GetName() ? normals->GetName() : "Normals", 3,
      cloud->GetNumberOfPoints(), remarks))
  {
    return remarks;
  }

  const int components = coefficients->GetNumberOfComponents();
  std::vector<double> tuple(components);
  const vtkIdType count =
    ids.empty() ? cloud->GetNumberOfPoints() : static_cast<vtkIdType>(ids.size());
  vtkIdType faulty = 0;
  vtkIdType first = -1;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const vtkIdType id = ids.empty() ? i : ids[i];
    const double order = orders->GetTuple1(id);
    double x[3], n[3], u[3], v[3];
    cloud->GetPoint(id, x);
    normals->GetTuple(id, n);
    axes->GetTuple(id, u);
    vtkMath::Normalize(n);
    vtkMath::Cross(n, u, v);
    vtkMath::Normalize(v);
    vtkMath::Cross(v, n, u); // unit, and across the normal for sure
    coefficients->GetTuple(id, tuple.data());

    Splat splat{};
    splat.Id = static_cast<unsigned int>(id);
    splat.Position = i;
    splat.Radius = static_cast<float>(radii->GetTuple1(id));
    bool sound = order >= 1.0 && order <= vtkAlgebraicSplat::MaximumOrder &&
      vtkAlgebraicSplat::GetNumberOfCoefficients(static_cast<int>(order)) <= components &&
      splat.Radius > 0.0f && std::isfinite(splat.Radius) &&
      (diagonal == 0.0 || splat.Radius <= LargestRadius * diagonal);
    for (int k = 0; k < 3; ++k)
    {
      splat.Center[k] = static_cast<float>(x[k] - this->Origin[k]);
      splat.U[k] = static_cast<float>(u[k]);
      splat.V[k] = static_cast<float>(v[k]);
      splat.Normal[k] = static_cast<float>(n[k]);
    }
    if (sound)
    {
      const int used = vtkAlgebraicSplat::GetNumberOfCoefficients(static_cast<int>(order));
      std::copy_n(tuple.begin(), used, splat.Coefficients.begin());
      splat.Heights = GetHeights(splat.Coefficients.data(), static_cast<int>(order));
    }
    sound = sound && IsFinite(splat.U) && IsFinite(splat.V) && vtkMath::Norm(v) > 0.5 &&
      std::isfinite(splat.Heights[0]) && std::isfinite(splat.Heights[1]);
    if (!sound)
    {
      first = first < 0 ? id : first;
      ++faulty;
      continue;
    }
    const double height = std::max(std::abs(splat.Heights[0]), std::abs(splat.Heights[1]));
    this->Reach = std::max(this->Reach, splat.Radius * std::hypot(1.0, height));
    this->MeanRadius += splat.Radius;
    this->Groups[static_cast<int>(order) - 1].push_back(splat);
  }
  this->MeanRadius /= std::max<vtkIdType>(count - faulty, 1);
  if (faulty > 0)
  {
    std::ostringstream line;
    line
      << faulty << " of " << count << " splats (the first is point " << first
      << ") are not drawn: 'SplatOrder' has to be 1 to 4 with as many 'SplatCoefficients' as it "
         "takes, 'radius' positive and no more than "
      << LargestRadius
      << " times the cloud's diagonal, normals other than 0, 'SplatAxes' across them, and all of "
         "these finite. Make them with vtkAlgebraicSplats.";
    remarks.push_back(line.str());
  }
  return remarks;
}
