// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOutlineCoverageCPU.h"

#include "vtkSurfacePixels.h"

#include "vtkMath.h"
#include "vtkSMPTools.h"

#include <cstdlib>

void vtkOutlineCoverageCPU::Run(const std::array<int, 2>& size, vtkSurfacePixels& pixels)
{
  // only normals are written and only depths are read, so that it can be done in place
  const auto& r = pixels.Rectangle;
  const int width = r[2] - r[0];
  auto isBackground = [&](int x, int y)
  {
    if (x < 0 || y < 0 || x >= size[0] || y >= size[1])
    {
      return false; // not known, outside of the viewport
    }
    const bool inside = x >= r[0] && y >= r[1] && x < r[2] && y < r[3];
    return !inside ||
      !(pixels.Surface[4 * (static_cast<size_t>(y - r[1]) * width + x - r[0]) + 3] > 0.0f);
  };
  auto coverRow = [&](int y)
  {
    for (int x = r[0]; x < r[2]; ++x)
    {
      if (isBackground(x, y))
      {
        continue;
      }
      float* normal = &pixels.Surface[4 * (static_cast<size_t>(y - r[1]) * width + x - r[0])];
      vtkMath::Normalize(normal);
      if (!(isBackground(x - 1, y) || isBackground(x + 1, y) || isBackground(x, y - 1) ||
            isBackground(x, y + 1)))
      {
        continue;
      }
      int covered = 0;
      for (int i = 0; i < 9; ++i)
      {
        const int dx = i % 3 - 1;
        const int dy = i / 3 - 1;
        covered += isBackground(x + dx, y + dy) ? 0 : 4 >> (std::abs(dx) + std::abs(dy));
      }
      vtkMath::MultiplyScalar(normal, static_cast<float>(covered) / 16.0f);
    }
  };
  constexpr int Grain = 16;
  vtkSMPTools::For(r[1], r[3], Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType y = begin; y < end; ++y)
      {
        coverRow(static_cast<int>(y));
      }
    });
}
