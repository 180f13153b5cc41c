// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMaskFillOpenGL
 * @brief   the step that fills holes with the surface around them, by shaders
 *
 * After Rosenthal and Linsen 2008, sections 4 and 5; see vtkMaskFillOptions. Before each iteration
 * the GPU counts the pixels that it would fill, and none is run for nothing.
 *
 * @sa vtkMaskFillCPU
 */
#ifndef vtkMaskFillOpenGL_h
#define vtkMaskFillOpenGL_h

#include "vtkSurfaceStepOpenGL.h"

#include <array>

struct vtkMaskFillOptions;

class vtkMaskFillOpenGL
{
public:
  vtkMaskFillOpenGL();

  /**
   * Fills `surface` within `rectangle` (x, y, x end, y end), with `spare` of the same layers to
   * work in; the two change places so that `surface` is the result. Returns the number of
   * iterations that filled a pixel. Adds the passes over the screen to `passes`.
   */
  int Run(vtkOpenGLRenderWindow* window, const vtkMaskFillOptions& options,
    const std::array<int, 4>& rectangle, vtkSurfaceTarget*& surface, vtkSurfaceTarget*& spare,
    int& passes);

  void ReleaseGraphicsResources();

private:
  vtkSurfaceStepOpenGL Fill;
  vtkSurfaceStepOpenGL Count;
};

#endif
