// SPDX-License-Identifier: BSD-3-Clause
#include "vtkResolveCPU.h"

#include "vtkPointSurfaceView.h"
#include "vtkSurfacePixels.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
constexpr int TileSize = 8; // of pixels that show two surfaces: few, along edges

using Tiles = std::vector<std::array<int, 4>>;

class Resolver
{
public:
  Resolver(const vtkPointSurfaceView& view, const vtkSurfacePixels& samples,
    vtkSurfacePixels& pixels, vtkSurfacePixels& lesser, std::vector<Tiles>& tiles)
    : Samples(samples)
    , Pixels(pixels)
    , Lesser(lesser)
    , TilesOfRows(tiles)
    , Factor(view.Supersampling)
    , DepthStep(static_cast<float>(2.0 * view.MeanRadius))
  {
  }

  /// Of rows of tiles.
  void operator()(vtkIdType begin, vtkIdType end) const
  {
    const int height = this->Pixels.Rectangle[3] - this->Pixels.Rectangle[1];
    for (auto row = static_cast<int>(begin); row < end; ++row)
    {
      this->ResolveRows(
        TileSize * row, std::min(TileSize * (row + 1), height), this->TilesOfRows[row]);
    }
  }

private:
  void ResolveRows(int bottom, int top, Tiles& tiles) const
  {
    const auto& r = this->Pixels.Rectangle;
    std::vector<char> hasTwo((r[2] - r[0] + TileSize - 1) / TileSize);
    this->ClearLesser(bottom, top);
    for (int row = bottom; row < top; ++row)
    {
      for (int column = 0; column < r[2] - r[0]; ++column)
      {
        hasTwo[column / TileSize] |= this->ResolvePixel(column, row);
      }
    }
    for (int i = 0; i < static_cast<int>(hasTwo.size()); ++i)
    {
      const int right = std::min(r[0] + TileSize * (i + 1), r[2]);
      if (hasTwo[i] && i > 0 && hasTwo[i - 1])
      {
        tiles.back()[2] = right; // neighbours become one
      }
      else if (hasTwo[i])
      {
        tiles.push_back({ r[0] + TileSize * i, r[1] + bottom, right, r[1] + top });
      }
    }
  }

  void ClearLesser(int bottom, int top) const
  {
    const size_t width = this->Pixels.Rectangle[2] - this->Pixels.Rectangle[0];
    std::fill(this->Lesser.Surface.begin() + 4 * width * bottom,
      this->Lesser.Surface.begin() + 4 * width * top, 0.0f);
    if (!this->Lesser.Id.empty())
    {
      std::fill(this->Lesser.Id.begin() + width * bottom, this->Lesser.Id.begin() + width * top, 0);
    }
  }

  /// Indices of the samples of a pixel that have a surface; returns how many.
  int GatherSamples(int column, int row, size_t (&covered)[16]) const
  {
    const auto& r = this->Samples.Rectangle;
    const int x = this->Factor * (column + this->Pixels.Rectangle[0]);
    const int y = this->Factor * (row + this->Pixels.Rectangle[1]);
    int count = 0;
    for (int j = std::max(y, r[1]); j < std::min(y + this->Factor, r[3]); ++j)
    {
      for (int i = std::max(x, r[0]); i < std::min(x + this->Factor, r[2]); ++i)
      {
        const size_t sample = static_cast<size_t>(j - r[1]) * (r[2] - r[0]) + (i - r[0]);
        if (this->Samples.Surface[4 * sample + 3] > 0.0f)
        {
          covered[count++] = sample;
        }
      }
    }
    return count;
  }

  /// Whether it shows two surfaces.
  bool ResolvePixel(int column, int row) const
  {
    const size_t pixel =
      static_cast<size_t>(row) * (this->Pixels.Rectangle[2] - this->Pixels.Rectangle[0]) + column;
    float* surface = &this->Pixels.Surface[4 * pixel];
    size_t covered[16];
    const int count = this->GatherSamples(column, row, covered);
    std::fill_n(surface, 4, 0.0f);
    if (!this->Pixels.Id.empty())
    {
      this->Pixels.Id[pixel] = 0;
    }
    if (!this->Pixels.Color.empty())
    {
      std::fill_n(&this->Pixels.Color[4 * pixel], 4, 0.0f);
    }
    if (count == 0)
    {
      return false;
    }

    float nearest = std::numeric_limits<float>::max();
    float farthest = 0.0f;
    for (int i = 0; i < count; ++i)
    {
      const float depth = this->Samples.Surface[4 * covered[i] + 3];
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
    const float limit = std::max(nearest + this->DepthStep, 0.5f * (nearest + farthest));
    auto isInFront = [&](size_t sample) { return this->Samples.Surface[4 * sample + 3] <= limit; };
    const auto inFront = std::count_if(covered, covered + count, isInFront);
    const bool takeFront = 2 * inFront >= count;
    const int kept = inFront == count
      ? count
      : static_cast<int>(std::stable_partition(covered, covered + count,
                           [&](size_t sample) { return isInFront(sample) == takeFront; }) -
          covered);
    const int all = this->Factor * this->Factor;
    // where the background is seen too, the surface with more samples stands for both
    const bool two = kept < count && count == all;
    this->Average(this->Pixels, pixel, covered, kept, two ? kept : count);
    if (two)
    {
      this->Average(this->Lesser, pixel, covered + kept, count - kept, count - kept);
      this->PutBehind(pixel);
    }
    return two;
  }

  /// Lets the lesser surface be drawn before the other one and be hidden where that is.
  void PutBehind(size_t pixel) const
  {
    float& depth = this->Lesser.Surface[4 * pixel + 3];
    depth = std::max(depth, this->Pixels.Surface[4 * pixel + 3] + this->DepthStep);
    if (!this->Lesser.Id.empty())
    {
      this->Lesser.Id[pixel] = this->Pixels.Id[pixel];
    }
  }

  /// The mean of some samples; the normal's length is the share of `covered` samples.
  void Average(
    vtkSurfacePixels& pixels, size_t pixel, const size_t* kept, int count, int covered) const
  {
    const float coverage = static_cast<float>(covered) / (this->Factor * this->Factor);
    float* surface = &pixels.Surface[4 * pixel];
    const float* first = &this->Samples.Surface[4 * kept[0]];
    for (int i = 0; i < count; ++i)
    {
      const float* sample = &this->Samples.Surface[4 * kept[i]];
      const float alike = sample[0] * first[0] + sample[1] * first[1] + sample[2] * first[2];
      const float side = alike < 0.0f ? -1.0f : 1.0f;
      for (int k = 0; k < 3; ++k)
      {
        surface[k] += side * sample[k];
      }
      surface[3] += sample[3];
    }
    const float size =
      std::sqrt(surface[0] * surface[0] + surface[1] * surface[1] + surface[2] * surface[2]);
    for (int k = 0; k < 3; ++k)
    {
      surface[k] = coverage * (size < 1e-6f ? first[k] : surface[k] / size);
    }
    surface[3] /= count;
    if (!pixels.Id.empty())
    {
      pixels.Id[pixel] = this->Samples.Id[kept[0]];
    }
    for (int k = 0; k < 4 && !pixels.Color.empty(); ++k)
    {
      float sum = 0.0f;
      for (int i = 0; i < count; ++i)
      {
        sum += this->Samples.Color[4 * kept[i] + k];
      }
      pixels.Color[4 * pixel + k] = sum / count;
    }
  }

  const vtkSurfacePixels& Samples;
  vtkSurfacePixels& Pixels;
  vtkSurfacePixels& Lesser;
  std::vector<Tiles>& TilesOfRows;
  const int Factor;
  const float DepthStep;
};
}

std::vector<std::array<int, 4>> vtkResolveCPU::Run(const vtkPointSurfaceView& view,
  const vtkSurfacePixels& samples, vtkSurfacePixels& pixels, vtkSurfacePixels& lesser)
{
  const auto r = view.GetPixelRectangle();
  for (vtkSurfacePixels* made : { &pixels, &lesser })
  {
    made->Allocate(
      { r[0], r[1], r[0] + r[2], r[1] + r[3] }, !samples.Id.empty(), !samples.Color.empty());
  }
  std::vector<Tiles> tilesOfRows((r[3] + TileSize - 1) / TileSize);
  Resolver resolver(view, samples, pixels, lesser, tilesOfRows);
  vtkSMPTools::For(0, static_cast<vtkIdType>(tilesOfRows.size()), resolver);
  Tiles all;
  for (const Tiles& tiles : tilesOfRows)
  {
    all.insert(all.end(), tiles.begin(), tiles.end());
  }
  return all;
}
