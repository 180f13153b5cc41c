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
class Resolver
{
public:
  Resolver(
    const vtkPointSurfaceView& view, const vtkSurfacePixels& samples, vtkSurfacePixels& pixels)
    : Samples(samples)
    , Pixels(pixels)
    , Factor(view.Supersampling)
    , DepthStep(static_cast<float>(2.0 * view.MeanRadius))
  {
  }

  void operator()(vtkIdType firstRow, vtkIdType lastRow) const
  {
    const int width = this->Pixels.Rectangle[2] - this->Pixels.Rectangle[0];
    for (vtkIdType row = firstRow; row < lastRow; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        this->ResolvePixel(column, static_cast<int>(row));
      }
    }
  }

private:
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

  void ResolvePixel(int column, int row) const
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
      return;
    }

    float nearest = std::numeric_limits<float>::max();
    for (int i = 0; i < count; ++i)
    {
      nearest = std::min(nearest, this->Samples.Surface[4 * covered[i] + 3]);
    }
    auto isInFront = [&](size_t sample)
    { return this->Samples.Surface[4 * sample + 3] <= nearest + this->DepthStep; };
    const auto inFront = std::count_if(covered, covered + count, isInFront);
    const bool takeFront = 2 * inFront >= count;
    const int kept =
      static_cast<int>(std::remove_if(covered, covered + count,
                         [&](size_t sample) { return isInFront(sample) != takeFront; }) -
        covered);
    this->Average(pixel, covered, kept, static_cast<float>(count) / (this->Factor * this->Factor));
  }

  void Average(size_t pixel, const size_t* kept, int count, float coverage) const
  {
    float* surface = &this->Pixels.Surface[4 * pixel];
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
    if (!this->Pixels.Id.empty())
    {
      this->Pixels.Id[pixel] = this->Samples.Id[kept[0]];
    }
    for (int k = 0; k < 4 && !this->Pixels.Color.empty(); ++k)
    {
      float sum = 0.0f;
      for (int i = 0; i < count; ++i)
      {
        sum += this->Samples.Color[4 * kept[i] + k];
      }
      this->Pixels.Color[4 * pixel + k] = sum / count;
    }
  }

  const vtkSurfacePixels& Samples;
  vtkSurfacePixels& Pixels;
  const int Factor;
  const float DepthStep;
};
}

void vtkResolveCPU::Run(
  const vtkPointSurfaceView& view, const vtkSurfacePixels& samples, vtkSurfacePixels& pixels)
{
  const auto r = view.GetPixelRectangle();
  pixels.Allocate(
    { r[0], r[1], r[0] + r[2], r[1] + r[3] }, !samples.Id.empty(), !samples.Color.empty());
  Resolver resolver(view, samples, pixels);
  vtkSMPTools::For(0, r[3], resolver);
}
