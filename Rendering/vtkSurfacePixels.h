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

#include <array>
#include <cstddef>
#include <vector>

struct vtkSurfacePixels
{
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
};

#endif
