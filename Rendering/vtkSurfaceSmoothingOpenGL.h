// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSmoothingOpenGL
 * @brief   the step that smooths a surface buffer with a kernel of 3x3, by a shader
 *
 * Normals, depths and colours, of pixels with a surface alone (Rosenthal and Linsen 2008,
 * section 6); ids stay.
 *
 * @sa vtkSurfaceSmoothingCPU
 */
#ifndef vtkSurfaceSmoothingOpenGL_h
#define vtkSurfaceSmoothingOpenGL_h

#include "vtkSurfaceStepOpenGL.h"

#include <array>

struct vtkSurfaceSmoothingOptions;

class vtkSurfaceSmoothingOpenGL
{
public:
  vtkSurfaceSmoothingOpenGL();

  /**
   * Makes `smoothed` from `surface`, which has the same layers, within `rectangle` (x, y, x end,
   * y end).
   */
  void Run(vtkOpenGLRenderWindow* window, const vtkSurfaceSmoothingOptions& options,
    const std::array<int, 4>& rectangle, vtkSurfaceTarget& surface, vtkSurfaceTarget& smoothed);

  void ReleaseGraphicsResources();

private:
  vtkSurfaceStepOpenGL Step;
};

#endif
