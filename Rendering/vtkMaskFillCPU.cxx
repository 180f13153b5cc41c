// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaskFillCPU.h"

#include "vtkMaskFillOptions.h"
#include "vtkPointSurfaceVectorize.h"
#include "vtkSurfacePixels.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <functional>

namespace
{
constexpr int Ring[8][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, 1 }, { -1, 0 }, { -1, -1 },
  { 0, -1 }, { 1, -1 } };
constexpr float Infinite = 3.4e38f;

/// Whether the bits of `length` neighbouring directions are set.
bool HasRun(unsigned int directions, int length)
{
  const unsigned int twice = directions | directions << 8; // around the ring's end
  unsigned int runs = twice;
  for (int i = 1; i < length; ++i)
  {
    runs &= twice >> i;
  }
  return (runs & 255u) != 0;
}

/// The depths of a row, with the background's at each end; a row outside is all background.
VTK_POINT_SURFACE_CLONES
void CopyDepths(const float* surface, int width, float* depths)
{
  depths[0] = 0.0f;
  depths[width + 1] = 0.0f;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int x = 0; x < width; ++x)
  {
    depths[x + 1] = surface ? surface[4 * x + 3] : 0.0f;
  }
}

/// Marks the pixels of a row that are of the kind to fill and have neighbours in front of them to
/// two opposite sides, as each has that no mask fits.
VTK_POINT_SURFACE_CLONES
void MarkCandidates(const float* below, const float* row, const float* above, int width,
  bool occluded, vtkDepthStep depthStep, unsigned char* candidates)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int x = 0; x < width; ++x)
  {
    const float depth = row[x + 1];
    const float limit =
      occluded ? depth - (depthStep.PerDepth * depth + depthStep.Constant) : Infinite;
    const float* rows[3] = { below + x, row + x, above + x };
    unsigned char front[3][3];
    VTK_POINT_SURFACE_UNROLL
    for (int j = 0; j < 3; ++j)
    {
      VTK_POINT_SURFACE_UNROLL
      for (int i = 0; i < 3; ++i)
      {
        const float d = rows[j][i];
        front[j][i] = static_cast<unsigned char>((d > 0.0f ? 1 : 0) & (d <= limit ? 1 : 0));
      }
    }
    const unsigned char left = front[0][0] | front[1][0] | front[2][0];
    const unsigned char right = front[0][2] | front[1][2] | front[2][2];
    const unsigned char down = front[0][0] | front[0][1] | front[0][2];
    const unsigned char up = front[2][0] | front[2][1] | front[2][2];
    const unsigned char kind = occluded == (depth > 0.0f) ? 1 : 0;
    candidates[x] = static_cast<unsigned char>(kind & ((left & right) | (down & up)));
  }
}
}

int vtkMaskFillCPU::Run(const vtkMaskFillOptions& options, vtkSurfacePixels& pixels)
{
  const auto& r = pixels.Rectangle;
  const int height = std::max(r[3] - r[1], 0);
  this->Candidates.resize(height);
  this->Rows.resize(height);
  this->Listed.resize(static_cast<size_t>(height) * std::max(r[2] - r[0], 0));
  constexpr int Grain = 16;
  auto forEachRow = [height](const std::function<void(int)>& run)
  {
    vtkSMPTools::For(0, height, Grain,
      [&run](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType row = begin; row < end; ++row)
        {
          run(static_cast<int>(row));
        }
      });
  };
  if (options.MaximumIterations > 0)
  {
    forEachRow([&](int row) { this->FindCandidates(options, pixels, row); });
  }
  for (int iteration = 0; iteration < options.MaximumIterations; ++iteration)
  {
    forEachRow([&](int row) { this->FindFillable(options, pixels, row); });
    bool changed = false;
    for (int row = 0; row < height; ++row)
    {
      for (const Filled& filled : this->Rows[row])
      {
        Write(filled, pixels);
        this->AddNeighbors(filled, r[2] - r[0], row);
        changed = true;
      }
    }
    if (!changed)
    {
      return iteration;
    }
  }
  return options.MaximumIterations;
}

void vtkMaskFillCPU::Write(const Filled& filled, vtkSurfacePixels& pixels)
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

/// Directions, of those in `beyond`, in which there is no surface in front within reach.
unsigned int vtkMaskFillCPU::FindOpenDirections(const vtkMaskFillOptions& options,
  const vtkSurfacePixels& pixels, int column, int row, float limit, unsigned int beyond)
{
  const auto& r = pixels.Rectangle;
  const int width = r[2] - r[0];
  const int height = r[3] - r[1];
  unsigned int open = beyond;
  for (int i = 0; i < 8; ++i)
  {
    for (int far = 2; far <= options.Reach && (open & 1u << i) != 0; ++far)
    {
      const int x = column + far * Ring[i][0];
      const int y = row + far * Ring[i][1];
      if (x < 0 || y < 0 || x >= width || y >= height)
      {
        break;
      }
      const float depth = pixels.Surface[4 * (static_cast<size_t>(y) * width + x) + 3];
      if (depth > 0.0f && depth <= limit)
      {
        open &= ~(1u << i);
      }
    }
  }
  return open;
}

void vtkMaskFillCPU::FindCandidates(
  const vtkMaskFillOptions& options, const vtkSurfacePixels& pixels, int row)
{
  const auto& r = pixels.Rectangle;
  const int width = r[2] - r[0];
  const int height = r[3] - r[1];
  std::vector<float> depths(3 * (static_cast<size_t>(width) + 2));
  float* rows[3];
  for (int j = 0; j < 3; ++j)
  {
    const int y = row + j - 1;
    rows[j] = depths.data() + j * (static_cast<size_t>(width) + 2);
    CopyDepths(y >= 0 && y < height ? &pixels.Surface[4 * static_cast<size_t>(y) * width] : nullptr,
      width, rows[j]);
  }
  unsigned char* marks = &this->Listed[static_cast<size_t>(row) * width];
  MarkCandidates(rows[0], rows[1], rows[2], width, options.Occluded, options.DepthStep, marks);
  this->Candidates[row].clear();
  for (int x = 0; x < width; ++x)
  {
    if (marks[x])
    {
      this->Candidates[row].push_back(x);
    }
  }
}

void vtkMaskFillCPU::AddNeighbors(const Filled& filled, int width, int row)
{
  const int column = static_cast<int>(filled.Pixel % width);
  const int height = static_cast<int>(this->Candidates.size());
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, height - 1); ++y)
  {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, width - 1); ++x)
    {
      unsigned char& listed = this->Listed[static_cast<size_t>(y) * width + x];
      if (!listed)
      {
        listed = 1;
        this->Candidates[y].push_back(x);
      }
    }
  }
}

void vtkMaskFillCPU::FindFillable(
  const vtkMaskFillOptions& options, const vtkSurfacePixels& pixels, int row)
{
  const auto& r = pixels.Rectangle;
  const int width = r[2] - r[0];
  const int height = r[3] - r[1];
  std::vector<Filled>& fillable = this->Rows[row];
  fillable.clear();
  auto fill = [&](int x)
  {
    const size_t pixel = static_cast<size_t>(row) * width + x;
    const float own = pixels.Surface[4 * pixel + 3];
    if (options.Occluded != (own > 0.0f))
    {
      this->Listed[pixel] = 0;
      return true; // not of the kind: no candidate any longer
    }
    const float limit = options.Occluded ? own - options.DepthStep.At(own) : Infinite;
    unsigned int beyond = 0;
    float nearest = Infinite;
    size_t source = 0;
    for (int i = 0; i < 8; ++i)
    {
      const int nx = x + Ring[i][0];
      const int ny = row + Ring[i][1];
      const bool inside = nx >= 0 && ny >= 0 && nx < width && ny < height;
      const size_t neighbor = static_cast<size_t>(ny) * width + nx;
      const float depth = inside ? pixels.Surface[4 * neighbor + 3] : 0.0f;
      const bool inFront = depth > 0.0f && depth <= limit;
      beyond |= inFront ? 0u : 1u << i;
      if (inFront && depth < nearest)
      {
        nearest = depth;
        source = neighbor;
      }
    }
    if (HasRun(beyond, 5) ||
      (options.Reach > 0 && HasRun(FindOpenDirections(options, pixels, x, row, limit, beyond), 3)))
    {
      return false;
    }
    Filled filled = {};
    filled.Pixel = pixel;
    std::copy_n(&pixels.Surface[4 * source], 4, filled.Surface);
    filled.Id = pixels.Id.empty() ? 0 : pixels.Id[source];
    if (!pixels.Color.empty())
    {
      std::copy_n(&pixels.Color[4 * source], 4, filled.Color);
    }
    fillable.push_back(filled);
    this->Listed[pixel] = 0;
    return true;
  };
  // the others may be filled when more is around them
  std::vector<int>& columns = this->Candidates[row];
  columns.erase(std::remove_if(columns.begin(), columns.end(), fill), columns.end());
}
