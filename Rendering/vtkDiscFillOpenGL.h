// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDiscFillOpenGL
 * @brief   the step from projected points to a surface whose gaps their discs fill, by a shader
 *
 * See vtkDiscFillOptions. With a reach of 0 the points are left as they are.
 *
 * @sa vtkDiscFillCPU
 */
#ifndef vtkDiscFillOpenGL_h
#define vtkDiscFillOpenGL_h

#include "vtkSurfaceStepOpenGL.h"

#include <array>

struct vtkDiscFillOptions;

class vtkDiscFillOpenGL
{
public:
  vtkDiscFillOpenGL();

  /**
   * Makes `surface` of `projected`, within `rectangle` (x, y, x end, y end); the displacements are
   * those of SubpixelCenters.
   */
  void Run(vtkOpenGLRenderWindow* window, const vtkDiscFillOptions& options,
    const std::array<int, 4>& rectangle, vtkSurfaceTarget& projected, vtkSurfaceTarget& surface);

  void ReleaseGraphicsResources();

private:
  vtkSurfaceStepOpenGL Step;
};

#endif
