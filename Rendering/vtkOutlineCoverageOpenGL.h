// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOutlineCoverageOpenGL
 * @brief   the step that makes the outline of a surface buffer blend with what lies behind
 *
 * A pixel beside the background, where the Laplace filter of the depths is large whatever its
 * threshold (Rosenthal and Linsen 2008, section 7), counts as covered by the Gaussian mean of its
 * 3x3 pixels; shading blends by that share, the length of the normal.
 *
 * @sa vtkOutlineCoverageCPU vtkDepthAntialiasingPass
 */
#ifndef vtkOutlineCoverageOpenGL_h
#define vtkOutlineCoverageOpenGL_h

#include "vtkSurfaceStepOpenGL.h"

#include <array>

class vtkOutlineCoverageOpenGL
{
public:
  vtkOutlineCoverageOpenGL();

  /**
   * Makes `result` from `surface`, which has the same layers, within `rectangle` (x, y, x end,
   * y end). What is outside of the targets counts as covered, the rest outside of the rectangle as
   * background.
   */
  void Run(vtkOpenGLRenderWindow* window, const std::array<int, 4>& rectangle,
    vtkSurfaceTarget& surface, vtkSurfaceTarget& result);

  void ReleaseGraphicsResources();

private:
  vtkSurfaceStepOpenGL Step;
};

#endif
