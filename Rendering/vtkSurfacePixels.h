// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfacePixels
 * @brief   a finished surface buffer in memory, as OpenGL takes it
 *
 * The layers of vtkSurfaceTarget of the same names, within a rectangle alone, row by row from its
 * lower left corner: four floats or an id a pixel. Layers that the frame does not need are empty.
 */
#ifndef vtkSurfacePixels_h
#define vtkSurfacePixels_h

#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

struct vtkSurfacePixels
{
  static constexpr int MaximumNumberOfBands = 64; ///< as vtkSurfaceBufferVS.glsl has room for

  std::array<int, 4> Rectangle{}; ///< x, y, x end, y end
  std::vector<float> Surface;
  std::vector<unsigned int> Id;
  std::vector<float> Color;

  void Allocate(const std::array<int, 4>& rectangle, bool ids, bool colors)
  {
    this->Rectangle = rectangle;
    const size_t size =
      static_cast<size_t>(rectangle[2] - rectangle[0]) * (rectangle[3] - rectangle[1]);
    this->Surface.resize(4 * size);
    this->Id.resize(ids ? size : 0);
    this->Color.resize(colors ? 4 * size : 0);
  }

  /**
   * Bands of the rectangle, as that one is given, one above the other: of each the columns from the
   * first to the last pixel with a surface. Those without one are left out.
   */
  std::vector<std::array<int, 4>> GetBands() const
  {
    constexpr int LeastHeight = 8;
    constexpr int BandsAtOnce = 4;
    const auto& r = this->Rectangle;
    const int height =
      std::max((r[3] - r[1] + MaximumNumberOfBands - 1) / MaximumNumberOfBands, LeastHeight);
    std::vector<std::array<int, 4>> bands((r[3] - r[1] + height - 1) / height);
    vtkSMPTools::For(0, static_cast<vtkIdType>(bands.size()), BandsAtOnce,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType i = begin; i < end; ++i)
        {
          const int y = r[1] + static_cast<int>(i) * height;
          bands[i] = this->GetBand(y, std::min(y + height, r[3]));
        }
      });
    bands.erase(std::remove_if(bands.begin(), bands.end(),
                  [](const std::array<int, 4>& band) { return band[0] >= band[2]; }),
      bands.end());
    return bands;
  }

  /**
   * Rectangles, one above the other, that hold these bands and all pixels about them that shading
   * may read.
   */
  std::vector<std::array<int, 4>> GetRead(const std::vector<std::array<int, 4>>& bands) const
  {
    constexpr int Reach = 2; // of psLeansOutward in vtkSurfaceBufferDec.glsl, and more than others'
    constexpr int LargestHeight = 48;
    const auto& r = this->Rectangle;
    std::vector<std::array<int, 4>> rectangles;
    std::array<int, 4> before{};
    for (const auto& band : bands)
    {
      const std::array<int, 4> grown = { std::max(band[0] - Reach, r[0]),
        std::max(band[1] - Reach, r[1]), std::min(band[2] + Reach, r[2]),
        std::min(band[3] + Reach, r[3]) };
      if (rectangles.empty() || grown[1] >= before[3])
      {
        rectangles.push_back(grown);
      }
      else
      {
        auto& last = rectangles.back();
        last[0] = std::min(last[0], grown[0]);
        last[2] = std::max(last[2], grown[2]);
        if (grown[3] - last[1] <= LargestHeight)
        {
          last[3] = grown[3];
        }
        else
        {
          rectangles.push_back(
            { std::min(before[0], grown[0]), before[3], std::max(before[2], grown[2]), grown[3] });
        }
      }
      before = grown;
    }
    return rectangles;
  }

private:
  std::array<int, 4> GetBand(int begin, int end) const
  {
    const auto& r = this->Rectangle;
    const size_t width = r[2] - r[0];
    auto isEmpty = [&](int row, size_t column)
    { return this->Surface[4 * ((row - r[1]) * width + column) + 3] <= 0.0f; };
    size_t first = width;
    size_t last = 0; // one past it
    for (int row = begin; row < end; ++row)
    {
      size_t column = 0;
      for (; column < first && isEmpty(row, column); ++column)
      {
      }
      first = column;
      for (column = width; column > std::max(first, last) && isEmpty(row, column - 1); --column)
      {
      }
      last = std::max(last, first < width ? column : 0);
    }
    return { r[0] + static_cast<int>(first), begin, r[0] + static_cast<int>(last), end };
  }
};

#endif
