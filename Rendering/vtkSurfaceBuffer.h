// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceBuffer
 * @brief   a finished surface buffer, the view that it is of, and the splats that it was drawn
 * from, where a mapper keeps them
 */
#ifndef vtkSurfaceBuffer_h
#define vtkSurfaceBuffer_h

#include "vtkPointSurfaceView.h"
#include "vtkSurfaceTarget.h"

#include <array>
#include <vector>

struct vtkSurfaceBuffer
{
  vtkPointSurfaceView View;
  vtkSurfaceTarget Target;
  vtkSurfaceTarget Lesser; ///< of pixels that show two surfaces, the one with less samples
  vtkSurfaceTarget Splats;
  /// Where there may be a surface, in pixels of the target: x, y, x end, y end.
  std::vector<std::array<int, 4>> Bands;
  std::vector<std::array<int, 4>> LesserTiles; ///< where there may be a lesser surface, likewise
  bool Valid = false;
  bool HasCoverage = false; ///< the normals' length is the share of the pixel that is covered by it
  unsigned long LastUse = 0;
};

#endif
