// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPixelFillCPU.h"

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

/// Whether a pixel shows the back of a surface: its normal points along the ray.
bool IsBack(const vtkPullPushParameters& parameters, const float* surface, int x, int y)
{
  const float ray[2] = { parameters.EyeRay[0] +
      (static_cast<float>(x) + 0.5f) * parameters.EyeRayStep[0],
    parameters.EyeRay[1] + (static_cast<float>(y) + 0.5f) * parameters.EyeRayStep[1] };
  return parameters.TwoSided && surface[0] * ray[0] + surface[1] * ray[1] - surface[2] > 0.0f;
}

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

void vtkPixelFillCPU::FillRow(
  const vtkPullPushParameters& parameters, const vtkSurfacePixels& pixels, int row)
{
  this->Rows[row].clear();
  const auto& r = pixels.Rectangle;
  const int width = r[2] - r[0];
  const float* surface = &pixels.Surface[4 * static_cast<size_t>(row) * width];
  for (int column = 0; column < width; ++column)
  {
    const float* pixel = surface + 4 * column;
    Filled filled;
    if ((pixel[3] == 0.0f || IsBack(parameters, pixel, r[0] + column, r[1] + row)) &&
      this->FillPixel(parameters, pixels, column, row, filled))
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
  if (mask == 0 || GetLongestRun(mask) >= 5)
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
