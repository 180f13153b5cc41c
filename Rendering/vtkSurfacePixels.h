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
    const auto& r = this->Rectangle;
    const size_t width = r[2] - r[0];
    const int height =
      std::max((r[3] - r[1] + MaximumNumberOfBands - 1) / MaximumNumberOfBands, LeastHeight);
    auto isEmpty = [&](int row, size_t column)
    { return this->Surface[4 * ((row - r[1]) * width + column) + 3] <= 0.0f; };
    std::vector<std::array<int, 4>> bands;
    for (int y = r[1]; y < r[3]; y += height)
    {
      const int end = std::min(y + height, r[3]);
      size_t first = width;
      size_t last = 0; // one past it
      for (int row = y; row < end; ++row)
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
      if (first < last)
      {
        bands.push_back({ r[0] + static_cast<int>(first), y, r[0] + static_cast<int>(last), end });
      }
    }
    return bands;
  }
};

#endif
