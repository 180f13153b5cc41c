// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOutlineTrimCPU.h"

#include "vtkPointSurfaceVectorize.h"
#include "vtkPullPushParameters.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace
{
constexpr int BlockSize = vtkSurfaceImage::BlockSize;
constexpr int Radius = vtkSurfaceImage::Radius;
constexpr int Depth = vtkSurfaceImage::IntervalX;
constexpr int CenterX = vtkSurfaceImage::CenterX;
constexpr int CenterY = vtkSurfaceImage::CenterY;

/// Of the pixels of a block, or of those beside them.
struct Side
{
  const float* Radii;
  const float* Depths;
};

/// Which pixels of a block may have to be trimmed: their points lie to one side of the centre, and
/// on the other side there is nothing or something that is farther away. Returns how many.
VTK_POINT_SURFACE_CLONES
int FindCandidates(const Side& own, const Side (&sides)[4], const float* centersX,
  const float* centersY, float largestOffset, unsigned char* found)
{
  int count = 0;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < BlockSize; ++i)
  {
    const float end = own.Depths[i] + own.Radii[i];
    int open[4]; // left, right, below, above
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      open[k] = (sides[k].Radii[i] > 0.0f ? 0 : 1) | (sides[k].Depths[i] > end ? 1 : 0);
    }
    const int right = centersX[i] > largestOffset ? open[0] : 0;
    const int left = centersX[i] < -largestOffset ? open[1] : 0;
    const int above = centersY[i] > largestOffset ? open[2] : 0;
    const int below = centersY[i] < -largestOffset ? open[3] : 0;
    const int candidate = own.Radii[i] > 0.0f ? right | left | above | below : 0;
    found[i] = static_cast<unsigned char>(candidate);
    count += candidate;
  }
  return count;
}

/// How a surface goes on from one pixel to another.
enum Neighbor
{
  GoesOn,
  Nothing,
  Behind
};

/// The centre of a pixel's disc in eye coordinates.
std::array<float, 3> GetPosition(
  const vtkPullPushParameters& parameters, vtkSurfaceImage& image, int x, int y)
{
  const float place[2] = { static_cast<float>(x) + 0.5f + image.GetRow(y, CenterX)[x],
    static_cast<float>(y) + 0.5f + image.GetRow(y, CenterY)[x] };
  const float depth = image.GetRow(y, Depth)[x];
  std::array<float, 3> position;
  for (int k = 0; k < 2; ++k)
  {
    position[k] = parameters.EyeRay[2 + k] + place[k] * parameters.EyeRayStep[2 + k] +
      depth * (parameters.EyeRay[k] + place[k] * parameters.EyeRayStep[k]);
  }
  position[0] -= parameters.Shear * position[1];
  position[2] = -depth;
  return position;
}

/// What is at the pixel (x + dx, y + dy), from the pixel (x, y) on.
Neighbor GetNeighbor(
  const vtkPullPushParameters& parameters, vtkSurfaceImage& image, int x, int y, int dx, int dy)
{
  const int otherX = x + dx;
  const int otherY = y + dy;
  if (otherX < 0 || otherY < 0 || otherX >= image.GetWidth() || otherY >= image.GetHeight())
  {
    return GoesOn; // for all that is known
  }
  if (!(image.GetRow(otherY, Radius)[otherX] > 0.0f))
  {
    return Nothing;
  }
  const float radius = image.GetRow(y, Radius)[x];
  const auto own = GetPosition(parameters, image, x, y);
  const auto other = GetPosition(parameters, image, otherX, otherY);
  // distance from the plane of the pixel's disc, by how much it is farther away
  float distance = 0.0f;
  for (int k = 0; k < 3; ++k)
  {
    distance += image.GetRow(y, k)[x] * (other[k] - own[k]);
  }
  const bool isFarther = -other[2] > -own[2] + radius;
  return isFarther && std::abs(distance) > radius ? Behind : GoesOn;
}
}

void vtkOutlineTrimCPU::Run(const vtkPullPushParameters& parameters, vtkSurfaceImage& projected)
{
  const auto& r = projected.GetRectangle();
  this->Rows.resize(std::max(this->Rows.size(), static_cast<size_t>(r[3] - r[1])));
  constexpr int Grain = 16;
  vtkSMPTools::For(r[1], r[3], Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType y = begin; y < end; ++y)
      {
        this->TrimRow(parameters, projected, static_cast<int>(y));
      }
    });
  for (int y = r[1]; y < r[3]; ++y)
  {
    for (const Trimmed& trimmed : this->Rows[y - r[1]])
    {
      for (int k = 0; k < projected.GetNumberOfPlanes(); ++k)
      {
        projected.GetRow(y, k)[trimmed.X] = trimmed.Values[k];
      }
      if (projected.HasIds())
      {
        projected.GetIds(y)[trimmed.X] = trimmed.Id;
      }
    }
  }
}

void vtkOutlineTrimCPU::TrimRow(
  const vtkPullPushParameters& parameters, vtkSurfaceImage& projected, int y)
{
  std::vector<Trimmed>& row = this->Rows[y - projected.GetRectangle()[1]];
  row.clear();
  auto getSide = [&](int x, int dy) {
    return Side{ projected.GetRow(y + dy, Radius) + x, projected.GetRow(y + dy, Depth) + x };
  };
  for (int block = projected.GetBlockBegin(); block < projected.GetBlockEnd(); ++block)
  {
    const int x = block * BlockSize;
    const Side sides[4] = { getSide(x - 1, 0), getSide(x + 1, 0), getSide(x, -1), getSide(x, 1) };
    unsigned char found[BlockSize];
    if (!projected.GetOccupied(y)[block] ||
      FindCandidates(getSide(x, 0), sides, projected.GetRow(y, CenterX) + x,
        projected.GetRow(y, CenterY) + x, parameters.LargestOffset, found) == 0)
    {
      continue;
    }
    for (int i = 0; i < BlockSize; ++i)
    {
      Trimmed trimmed;
      if (found[i] && TrimPixel(parameters, projected, x + i, y, trimmed))
      {
        row.push_back(trimmed);
      }
    }
  }
}

bool vtkOutlineTrimCPU::TrimPixel(const vtkPullPushParameters& parameters,
  vtkSurfaceImage& projected, int x, int y, Trimmed& trimmed)
{
  const float center[2] = { projected.GetRow(y, CenterX)[x], projected.GetRow(y, CenterY)[x] };
  auto neighbor = [&](int dx, int dy) { return GetNeighbor(parameters, projected, x, y, dx, dy); };
  float largest = parameters.LargestOffset;
  Neighbor other = GoesOn;
  int toOther[2] = { 0, 0 };
  for (int axis = 0; axis < 2; ++axis)
  {
    const int away = center[axis] > 0.0f ? -1 : 1;
    const int dx = axis == 0 ? away : 0;
    const int dy = axis == 1 ? away : 0;
    // of what is no wider than two pixels nothing would be left
    if (!(std::abs(center[axis]) > largest) || neighbor(-dx, -dy) != GoesOn ||
      neighbor(-2 * dx, -2 * dy) != GoesOn)
    {
      continue;
    }
    // an outline, not a gap of one pixel: the surface ends beside it too
    const Neighbor opposite = neighbor(dx, dy);
    if (opposite != GoesOn &&
      (neighbor(dx + dy, dy + dx) != GoesOn || neighbor(dx - dy, dy - dx) != GoesOn))
    {
      largest = std::abs(center[axis]);
      other = opposite;
      toOther[0] = dx;
      toOther[1] = dy;
    }
  }
  if (other == GoesOn)
  {
    return false;
  }
  trimmed = {};
  trimmed.X = x;
  if (other == Behind)
  {
    // as it is beside the pixel: its disc need not reach over here
    for (int k = 0; k < projected.GetNumberOfPlanes(); ++k)
    {
      trimmed.Values[k] = projected.GetRow(y + toOther[1], k)[x + toOther[0]];
    }
    trimmed.Id = projected.HasIds() ? projected.GetIds(y + toOther[1])[x + toOther[0]] : 0;
  }
  return true;
}
