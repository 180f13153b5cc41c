// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceSmoothingCPU.h"

#include "vtkSurfacePixels.h"
#include "vtkSurfaceSmoothingOptions.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>

namespace
{
class Smoother
{
public:
  Smoother(const vtkSurfaceSmoothingOptions& options, const vtkSurfacePixels& surface,
    vtkSurfacePixels& smoothed)
    : Options(options)
    , Surface(surface)
    , Smoothed(smoothed)
    , Width(surface.Rectangle[2] - surface.Rectangle[0])
    , Height(surface.Rectangle[3] - surface.Rectangle[1])
  {
  }

  void operator()(vtkIdType firstRow, vtkIdType lastRow) const
  {
    for (vtkIdType row = firstRow; row < lastRow; ++row)
    {
      for (int column = 0; column < this->Width; ++column)
      {
        this->SmoothPixel(column, static_cast<int>(row));
      }
    }
  }

private:
  void SmoothPixel(int column, int row) const
  {
    const size_t pixel = static_cast<size_t>(row) * this->Width + column;
    const float* own = &this->Surface.Surface[4 * pixel];
    float* result = &this->Smoothed.Surface[4 * pixel];
    if (!(own[3] > 0.0f))
    {
      std::fill_n(result, 4, 0.0f);
      if (!this->Surface.Color.empty())
      {
        std::copy_n(&this->Surface.Color[4 * pixel], 4, &this->Smoothed.Color[4 * pixel]);
      }
      return;
    }
    const float weights[3] = { this->Options.Center, this->Options.Side, this->Options.Corner };
    float sum[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
    float color[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
    float total = 0.0f;
    const float step = this->Options.DepthStep.At(own[3]);
    for (int y = std::max(row - 1, 0); y <= std::min(row + 1, this->Height - 1); ++y)
    {
      for (int x = std::max(column - 1, 0); x <= std::min(column + 1, this->Width - 1); ++x)
      {
        const size_t place = static_cast<size_t>(y) * this->Width + x;
        const float* other = &this->Surface.Surface[4 * place];
        if (!(other[3] > 0.0f) || std::abs(other[3] - own[3]) > step)
        {
          continue;
        }
        const float weight = weights[(x != column) + (y != row)];
        const float alike = own[0] * other[0] + own[1] * other[1] + own[2] * other[2];
        const float side = this->Options.TwoSided && alike < 0.0f ? -weight : weight;
        for (int k = 0; k < 3; ++k)
        {
          sum[k] += side * other[k];
        }
        sum[3] += weight * (other[3] - own[3]);
        total += weight;
        for (int k = 0; k < 4 && !this->Surface.Color.empty(); ++k)
        {
          color[k] += weight * this->Surface.Color[4 * place + k];
        }
      }
    }
    const float size = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    for (int k = 0; k < 3; ++k)
    {
      result[k] = size < 1e-6f * total ? own[k] : sum[k] / size;
    }
    result[3] = own[3] + sum[3] / total;
    for (int k = 0; k < 4 && !this->Surface.Color.empty(); ++k)
    {
      this->Smoothed.Color[4 * pixel + k] = color[k] / total;
    }
  }

  const vtkSurfaceSmoothingOptions& Options;
  const vtkSurfacePixels& Surface;
  vtkSurfacePixels& Smoothed;
  const int Width;
  const int Height;
};
}

void vtkSurfaceSmoothingCPU::Run(const vtkSurfaceSmoothingOptions& options,
  const vtkSurfacePixels& surface, vtkSurfacePixels& smoothed)
{
  smoothed.Allocate(surface.Rectangle, !surface.Id.empty(), !surface.Color.empty());
  smoothed.Id = surface.Id;
  constexpr int Grain = 16;
  const Smoother smoother(options, surface, smoothed);
  vtkSMPTools::For(0, surface.Rectangle[3] - surface.Rectangle[1], Grain, smoother);
}
