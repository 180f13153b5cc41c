// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceView.h"

#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkSpatialOrder.h"

#include <algorithm>
#include <cmath>

double vtkPointSurfaceView::GetLargestStretch(vtkMatrix4x4* matrix)
{
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double row[3] = { matrix->GetElement(axis, 0), matrix->GetElement(axis, 1),
      matrix->GetElement(axis, 2) };
    largest = std::max(largest, vtkMath::Norm(row));
  }
  return largest;
}

/// A rim of a width in samples. In steps, so that pixels stay the children of the same
/// coarser ones (of those that matter) while a camera moves, as they would without a rim; not so
/// many that they would cost more than the viewport itself.
void vtkPointSurfaceView::AddRim(double width, int largestSize)
{
  constexpr int Step = 16;
  const int largest = std::max(this->Size[0], this->Size[1]);
  const double wanted = std::min(width, 0.125 * largest) / this->Supersampling;
  const int possible = (largestSize - largest) / (2 * this->Supersampling);
  this->Rim = std::max(std::min(Step * static_cast<int>(std::ceil(wanted / Step)), possible), 0);
  for (int k = 0; k < 2; ++k)
  {
    const int size = this->Size[k] + 2 * this->Rim * this->Supersampling;
    for (int row = 0; row < 4; ++row)
    {
      this->VCDC[4 * row + k] *= static_cast<double>(this->Size[k]) / size;
    }
    this->Size[k] = size;
  }
}

void vtkPointSurfaceView::SetExtent(
  vtkMatrix4x4* modelToEye, const double bounds[6], double rim, int largestSize)
{
  double nearest = VTK_DOUBLE_MAX;
  double farthest = -VTK_DOUBLE_MAX;
  double corners[8][3];
  for (int c = 0; c < 8; ++c)
  {
    const double model[4] = { bounds[c & 1], bounds[2 + ((c >> 1) & 1)], bounds[4 + (c >> 2)],
      1.0 };
    for (int k = 0; k < 3; ++k)
    {
      corners[c][k] = 0.0;
      for (int i = 0; i < 4; ++i)
      {
        corners[c][k] += model[i] * modelToEye->GetElement(i, k);
      }
    }
    nearest = std::min(nearest, -corners[c][2]);
    farthest = std::max(farthest, -corners[c][2]);
  }
  this->Diagonal = 0.0;
  for (int c = 0; c < 4; ++c)
  {
    this->Diagonal = std::max(
      this->Diagonal, std::sqrt(vtkMath::Distance2BetweenPoints(corners[c], corners[7 - c])));
  }
  for (int k = 0; k < 3; ++k)
  {
    this->Center[k] = 0.5 * (corners[0][k] + corners[7][k]);
  }
  // the linear depth is a float of this range: keep the ends apart
  const double margin = 1e-4 * std::max(farthest - nearest, this->LargestRadius) + 1e-30;
  this->DepthRange = { nearest - margin, farthest + margin };

  const auto& m = this->VCDC;
  const double middleW = std::max(m[15] - 0.5 * m[11] * (nearest + farthest), 1e-30);
  this->TypicalRadius = 0.5 * this->MeanRadius * this->Size[1] * std::abs(m[5]) / middleW;
  const double nearestW = m[15] - m[11] * nearest;
  if (nearestW <= 1e-6 * (m[15] - m[11] * farthest))
  {
    // some of the cloud is beside or behind the eye: the whole image
    this->AddRim(rim * this->TypicalRadius, largestSize);
    this->Rectangle = { 0, 0, this->Size[0], this->Size[1] };
    this->LargestDisc = { 1.0 * this->Size[0], 1.0 * this->Size[1] };
    return;
  }
  double lower[2] = { VTK_DOUBLE_MAX, VTK_DOUBLE_MAX };
  double upper[2] = { -VTK_DOUBLE_MAX, -VTK_DOUBLE_MAX };
  for (const auto& corner : corners)
  {
    const double w = m[15] + m[11] * corner[2];
    for (int k = 0; k < 2; ++k)
    {
      const double clip =
        m[k] * corner[0] + m[4 + k] * corner[1] + m[8 + k] * corner[2] + m[12 + k];
      lower[k] = std::min(lower[k], clip / w);
      upper[k] = std::max(upper[k], clip / w);
    }
  }
  // in samples, of the largest disc and of half the viewport
  const double half[2] = { 0.5 * this->Size[0], 0.5 * this->Size[1] };
  const std::array<double, 2> radius = { this->LargestRadius * std::hypot(m[0], m[4]) / nearestW *
      half[0],
    std::abs(this->LargestRadius * m[5] / nearestW) * half[1] };
  this->LargestDisc = radius;
  if (std::min(lower[0], lower[1]) < -1.0 || std::max(upper[0], upper[1]) > 1.0)
  {
    this->AddRim(rim * std::max(radius[0], radius[1]), largestSize);
  }
  for (int k = 0; k < 2; ++k)
  {
    // with the largest disc around
    const double size = this->Size[k];
    const double begin = std::floor(0.5 * size + half[k] * lower[k] - radius[k]) - 1.0;
    const double end = std::ceil(0.5 * size + half[k] * upper[k] + radius[k]) + 1.0;
    this->Rectangle[k] = static_cast<int>(std::min(std::max(begin, 0.0), size));
    this->Rectangle[2 + k] =
      static_cast<int>(std::min(std::max(end, 0.0), size)) - this->Rectangle[k];
  }
}

//------------------------------------------------------------------------------
namespace
{
/// The planes that bound what is seen, in eye coordinates: inside is where all are over 0.
std::array<std::array<double, 4>, 6> GetFrustum(const vtkPointSurfaceView& view)
{
  constexpr double Margin = 8.0; // pixels
  std::array<std::array<double, 4>, 6> planes;
  const auto& m = view.VCDC;
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? 1.0 : -1.0;
    const double width = axis < 2 ? 1.0 + 2.0 * Margin / view.Size[axis] : 1.0 + 1e-6;
    for (int k = 0; k < 4; ++k)
    {
      planes[side][k] = width * m[4 * k + 3] + sign * m[4 * k + axis];
    }
  }
  return planes;
}

/// A plane of eye coordinates in those that a matrix brings to the eye.
std::array<double, 4> TakeBack(const std::array<double, 4>& plane, const std::array<double, 16>& m)
{
  std::array<double, 4> result = { 0.0, 0.0, 0.0, plane[3] };
  for (int k = 0; k < 4; ++k)
  {
    result[k] += plane[0] * m[4 * k] + plane[1] * m[4 * k + 1] + plane[2] * m[4 * k + 2];
  }
  return result;
}

/// Whether all of a box is beyond a plane.
bool IsOutside(const std::array<double, 6>& bounds, const std::array<double, 4>& plane)
{
  double largest = plane[3];
  for (int k = 0; k < 3; ++k)
  {
    largest += std::max(plane[k] * bounds[2 * k], plane[k] * bounds[2 * k + 1]);
  }
  return largest < 0.0;
}
}

void vtkPointSurfaceView::LeaveOutUnseen(const vtkSpatialOrder& order, double reach)
{
  auto planes = GetFrustum(*this);
  for (size_t side = 0; side < planes.size(); ++side)
  {
    planes[side][3] += side < 4 ? reach * vtkMath::Norm(planes[side].data()) : 0.0;
    planes[side] = TakeBack(planes[side], this->ModelToEye);
  }
  const std::vector<vtkSpatialOrder::Chunk>& chunks = order.GetChunks();
  std::vector<std::array<vtkIdType, 2>> seen;
  for (const auto& range : this->Ranges)
  {
    auto chunk = std::upper_bound(chunks.begin(), chunks.end(), range[0],
      [](vtkIdType place, const vtkSpatialOrder::Chunk& c) { return place < c.End; });
    for (; chunk != chunks.end() && chunk->First < range[1]; ++chunk)
    {
      if (std::any_of(planes.begin(), planes.end(),
            [&](const std::array<double, 4>& plane) { return IsOutside(chunk->Bounds, plane); }))
      {
        continue;
      }
      const std::array<vtkIdType, 2> part = { std::max(range[0], chunk->First),
        std::min(range[1], chunk->End) };
      if (!seen.empty() && seen.back()[1] == part[0])
      {
        seen.back()[1] = part[1];
      }
      else
      {
        seen.push_back(part);
      }
    }
  }
  this->Ranges = seen;
}
