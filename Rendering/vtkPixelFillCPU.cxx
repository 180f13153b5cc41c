// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPixelFillCPU.h"

#include "vtkPointSurfaceVectorize.h"
#include "vtkPullPushParameters.h"
#include "vtkSurfacePixels.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr int Ring[8][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, 1 }, { -1, 0 }, { -1, -1 },
  { 0, -1 }, { 1, -1 } };
constexpr float Infinite = 3.4e38f;

/// The longest run of neighbours along the ring that are not in `mask`.
int GetLongestRun(unsigned int mask)
{
  int run = 0;
  int longest = 0;
  for (int i = 0; i < 12; ++i) // once around, and on by the longest run that matters
  {
    run = mask >> (i & 7) & 1 ? 0 : run + 1;
    longest = std::max(longest, run);
  }
  return longest;
}
}

void vtkPixelFillCPU::Run(const vtkPullPushParameters& parameters, vtkSurfacePixels& pixels)
{
  const int rows = pixels.Rectangle[3] - pixels.Rectangle[1];
  if (static_cast<int>(this->Rows.size()) < rows)
  {
    this->Rows.resize(rows);
  }
  constexpr int Grain = 16;
  vtkSMPTools::For(0, rows, Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int row = static_cast<int>(begin); row < end; ++row)
      {
        this->FillRow(parameters, pixels, row);
      }
    });
  for (int row = 0; row < rows; ++row)
  {
    for (const Filled& filled : this->Rows[row])
    {
      std::copy_n(filled.Surface, 4, &pixels.Surface[4 * filled.Pixel]);
      if (!pixels.Id.empty())
      {
        pixels.Id[filled.Pixel] = filled.Id;
      }
      if (!pixels.Color.empty())
      {
        std::copy_n(filled.Color, 4, &pixels.Color[4 * filled.Pixel]);
      }
    }
  }
}

namespace
{
/// Whether the pixels of a row are part of a surface, with an empty one at each end.
VTK_POINT_SURFACE_CLONES
void FindSurface(const float* surface, int width, unsigned char* found)
{
  found[0] = 0;
  found[width + 1] = 0;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int x = 0; x < width; ++x)
  {
    found[x + 1] = surface[4 * x + 3] > 0.0f ? 1 : 0;
  }
}

/// Whether the pixels of a row show the back of a surface: the normal points along the ray.
VTK_POINT_SURFACE_CLONES
void FindBacks(
  const float* surface, int width, float rayX, float rayY, float step, unsigned char* backs)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int x = 0; x < width; ++x)
  {
    const float along = surface[4 * x] * (rayX + static_cast<float>(x) * step) +
      surface[4 * x + 1] * rayY - surface[4 * x + 2];
    backs[x] = along > 0.0f ? 1 : 0;
  }
}

/// Which pixels of a row may be filled: backs, and empty ones with neighbours on two sides.
VTK_POINT_SURFACE_CLONES
void FindCandidates(const unsigned char* const (&found)[3], const unsigned char* backs, int width,
  unsigned char* candidates)
{
  const unsigned char* below = found[0];
  const unsigned char* row = found[1];
  const unsigned char* above = found[2];
  VTK_POINT_SURFACE_INDEPENDENT
  for (int x = 0; x < width; ++x)
  {
    const unsigned char left = below[x] | row[x] | above[x];
    const unsigned char right = below[x + 2] | row[x + 2] | above[x + 2];
    const unsigned char down = below[x] | below[x + 1] | below[x + 2];
    const unsigned char up = above[x] | above[x + 1] | above[x + 2];
    const unsigned char amid = (left & right) | (down & up);
    const unsigned char empty = row[x + 1] ^ 1;
    candidates[x] = static_cast<unsigned char>((empty & amid) | backs[x]);
  }
}
}

void vtkPixelFillCPU::FillRow(
  const vtkPullPushParameters& parameters, const vtkSurfacePixels& pixels, int row)
{
  this->Rows[row].clear();
  const auto& r = pixels.Rectangle;
  const int width = r[2] - r[0];
  std::vector<unsigned char> marks(5 * (static_cast<size_t>(width) + 2), 0);
  auto marksAt = [&](int i) { return marks.data() + i * (static_cast<size_t>(width) + 2); };
  for (int i = 0; i < 3; ++i)
  {
    const int y = row + i - 1;
    if (y >= 0 && y < r[3] - r[1])
    {
      FindSurface(&pixels.Surface[4 * static_cast<size_t>(y) * width], width, marksAt(i));
    }
  }
  unsigned char* backs = marksAt(3);
  if (parameters.TwoSided)
  {
    const auto& ray = parameters.EyeRay;
    const auto& step = parameters.EyeRayStep;
    const float rayY = ray[1] + (static_cast<float>(r[1] + row) + 0.5f) * step[1];
    const float rayX =
      ray[0] - parameters.Shear * rayY + (static_cast<float>(r[0]) + 0.5f) * step[0];
    FindBacks(
      &pixels.Surface[4 * static_cast<size_t>(row) * width], width, rayX, rayY, step[0], backs);
  }
  unsigned char* candidates = marksAt(4);
  const unsigned char* found[3] = { marksAt(0), marksAt(1), marksAt(2) };
  FindCandidates(found, backs, width, candidates);
  for (int x = 0; x < width; ++x)
  {
    Filled filled;
    if (candidates[x] && this->FillPixel(parameters, pixels, x, row, filled))
    {
      this->Rows[row].push_back(filled);
    }
  }
}

bool vtkPixelFillCPU::FillPixel(const vtkPullPushParameters& parameters,
  const vtkSurfacePixels& pixels, int column, int row, Filled& filled) const
{
  const auto& r = pixels.Rectangle;
  const int width = r[2] - r[0];
  const int height = r[3] - r[1];
  const size_t pixel = static_cast<size_t>(row) * width + column;
  const float depth = pixels.Surface[4 * pixel + 3];
  const float limit = depth > 0.0f ? depth - parameters.DepthStep : Infinite;
  unsigned int mask = 0;
  size_t around[8];
  float nearest = Infinite;
  int front = 0;
  for (int i = 0; i < 8; ++i)
  {
    const int x = column + Ring[i][0];
    const int y = row + Ring[i][1];
    if (x < 0 || y < 0 || x >= width || y >= height)
    {
      continue;
    }
    around[i] = static_cast<size_t>(y) * width + x;
    const float d = pixels.Surface[4 * around[i] + 3];
    if (d > 0.0f && d < limit)
    {
      mask |= 1u << i;
      front = d < nearest ? i : front;
      nearest = std::min(nearest, d);
    }
  }
  constexpr int BackRun = 5;
  if (mask == 0 || GetLongestRun(mask) >= (depth > 0.0f ? BackRun : parameters.OpenRun))
  {
    return false;
  }

  filled = {};
  filled.Pixel = pixel;
  const float* main = &pixels.Surface[4 * around[front]];
  float weights = 0.0f;
  for (int i = 0; i < 8; ++i)
  {
    const float* other = mask >> i & 1 ? &pixels.Surface[4 * around[i]] : nullptr;
    if (!other || other[3] > nearest + 2.0f * parameters.DepthStep)
    {
      continue;
    }
    const float weight = (i & 1) == 0 ? 2.0f : 1.0f;
    const float side =
      other[0] * main[0] + other[1] * main[1] + other[2] * main[2] < 0.0f ? -1.0f : 1.0f;
    for (int k = 0; k < 4; ++k)
    {
      filled.Surface[k] += weight * (k < 3 ? side : 1.0f) * other[k];
      filled.Color[k] += pixels.Color.empty() ? 0.0f : weight * pixels.Color[4 * around[i] + k];
    }
    weights += weight;
  }
  const float* n = filled.Surface;
  const float size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  for (int k = 0; k < 3; ++k)
  {
    filled.Surface[k] = size < 1e-6f ? main[k] : filled.Surface[k] / size;
  }
  filled.Surface[3] /= weights;
  for (float& color : filled.Color)
  {
    color /= weights;
  }
  filled.Id = pixels.Id.empty() ? 0 : pixels.Id[around[front]];
  return true;
}
