// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceBufferComparison.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{
constexpr double TOLERANCE = 1e-4;
constexpr double DIFFERING_SHARE = 1e-3;

vtkDataArray* RequireArray(vtkFieldData* data, const char* name, int components)
{
  vtkDataArray* array = data->GetArray(name);
  if (!array || array->GetNumberOfComponents() != components || array->GetNumberOfTuples() == 0)
  {
    throw std::runtime_error("The buffer has no array \"" + std::string(name) + "\" of " +
      std::to_string(components) + " component(s).");
  }
  return array;
}

PullPushReference::Image ReadProjection(vtkImageData* projected)
{
  vtkPointData* data = projected->GetPointData();
  vtkDataArray* normals = RequireArray(data, "Normals", 3);
  vtkDataArray* radii = RequireArray(data, "Radius", 1);
  vtkDataArray* depths = RequireArray(data, "Depth", 1);
  vtkDataArray* displacements = RequireArray(data, "Displacement", 2);
  vtkDataArray* ids = RequireArray(data, "PointIds", 1);
  vtkDataArray* colors = data->GetArray("Colors");

  int size[3];
  projected->GetDimensions(size);
  PullPushReference::Image image(size[0], size[1]);
  for (int id = 0; id < size[0] * size[1]; ++id)
  {
    const double radius = radii->GetComponent(id, 0);
    if (!(radius > 0.0))
    {
      continue;
    }
    PullPushReference::Pixel& pixel = image.At(id % size[0], id / size[0]);
    pixel = PullPushReference::MakePoint(
      {}, radius, depths->GetComponent(id, 0), static_cast<int>(ids->GetComponent(id, 0)));
    normals->GetTuple(id, pixel.Normal.data());
    displacements->GetTuple(id, pixel.Displacement.data());
    if (colors)
    {
      colors->GetTuple(id, pixel.Color.data());
    }
  }
  return image;
}

template <size_t N>
double LargestDifference(const std::array<double, N>& expected, vtkDataArray* actual, int id)
{
  double largest = 0.0;
  for (size_t i = 0; i < N; ++i)
  {
    const double difference = std::abs(expected[i] - actual->GetComponent(id, static_cast<int>(i)));
    // Not a number must not pass for no difference.
    largest = difference <= largest ? largest : difference;
  }
  return largest;
}

// Keeps what is not a number, once met.
void Widen(double& worst, double difference)
{
  worst = difference <= worst || std::isnan(worst) ? worst : difference;
}
}

//------------------------------------------------------------------------------
PullPushReference SurfaceBufferComparison::Reconstruct(vtkImageData* projected)
{
  PullPushReference::Matrix projection;
  vtkDataArray* matrix = projected->GetFieldData()->GetArray("Projection");
  if (!matrix || matrix->GetNumberOfValues() != 16)
  {
    throw std::runtime_error("The buffer has no field array \"Projection\" of 16 numbers.");
  }
  for (int i = 0; i < 16; ++i)
  {
    const int components = matrix->GetNumberOfComponents();
    projection[i] = matrix->GetComponent(i / components, i % components);
  }
  const int levels =
    static_cast<int>(RequireArray(projected->GetFieldData(), "Levels", 1)->GetComponent(0, 0));
  return PullPushReference(ReadProjection(projected), projection, levels);
}

//------------------------------------------------------------------------------
SurfaceBufferComparison::SurfaceBufferComparison(vtkImageData* projected, vtkImageData* surface)
{
  RequireArray(surface->GetPointData(), "Normals", 3);
  RequireArray(surface->GetPointData(), "Depth", 1);
  RequireArray(surface->GetPointData(), "PointIds", 1);
  const bool compareColors = projected->GetPointData()->HasArray("Colors") != 0;
  if (compareColors)
  {
    RequireArray(surface->GetPointData(), "Colors", 4);
  }
  const int* worked = projected->GetExtent();
  const int* seen = surface->GetExtent();
  if (seen[0] < worked[0] || seen[1] > worked[1] || seen[2] < worked[2] || seen[3] > worked[3])
  {
    throw std::runtime_error("The surface buffer is larger than the projected one.");
  }

  const PullPushReference reference = Reconstruct(projected);
  const PullPushReference::Image& expected = reference.GetResult();
  int id = 0;
  for (int y = seen[2]; y <= seen[3]; ++y)
  {
    for (int x = seen[0]; x <= seen[1]; ++x)
    {
      this->ComparePixel(expected.At(x - worked[0], y - worked[2]), surface, id++, compareColors);
    }
  }
}

//------------------------------------------------------------------------------
void SurfaceBufferComparison::ComparePixel(
  const PullPushReference::Pixel& expected, vtkImageData* surface, int pixelId, bool compareColors)
{
  vtkPointData* data = surface->GetPointData();
  const double depth = data->GetArray("Depth")->GetComponent(pixelId, 0);
  const bool valid = depth != 0.0;
  if (!expected.Valid && !valid)
  {
    return;
  }
  ++this->Covered;
  const int source = static_cast<int>(data->GetArray("PointIds")->GetComponent(pixelId, 0));
  const bool differs = expected.Valid != valid || expected.Source != source;
  if (expected.NearDecision)
  {
    ++this->NearDecision;
    this->NearDecisionDiffering += differs;
    return;
  }
  if (differs)
  {
    ++this->Differing;
    return;
  }
  Widen(this->WorstNormal, LargestDifference(expected.Normal, data->GetArray("Normals"), pixelId));
  Widen(this->WorstDepth, std::abs(depth - expected.MinimumDepth) / expected.MinimumDepth);
  if (compareColors)
  {
    Widen(this->WorstColor, LargestDifference(expected.Color, data->GetArray("Colors"), pixelId));
  }
}

//------------------------------------------------------------------------------
bool SurfaceBufferComparison::Agrees() const
{
  return this->Covered > 0 && this->Differing <= DIFFERING_SHARE * this->Covered &&
    this->WorstNormal <= TOLERANCE && this->WorstDepth <= TOLERANCE &&
    this->WorstColor <= TOLERANCE;
}

//------------------------------------------------------------------------------
void SurfaceBufferComparison::Print(std::ostream& os) const
{
  os << "covered " << this->Covered << ", near a decision " << this->NearDecision << " ("
     << this->NearDecisionDiffering << " differing)"
     << ", differing in validity or source " << this->Differing << ", worst normal component "
     << this->WorstNormal << ", worst relative depth " << this->WorstDepth << ", worst color "
     << this->WorstColor << "\n";
}
