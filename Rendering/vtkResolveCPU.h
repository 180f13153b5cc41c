// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkResolveCPU
 * @brief   the step from a supersampled surface buffer to one of the viewport's size, by the
 *          processor
 *
 * The same as vtkResolveFS.glsl.
 */
#ifndef vtkResolveCPU_h
#define vtkResolveCPU_h

#include <array>
#include <vector>

struct vtkPointSurfaceView;
struct vtkSurfacePixels;

class vtkResolveCPU
{
public:
  /**
   * Makes `pixels` from `samples`, which are those of the view's rectangle; `lesser` gets the other
   * surface of the pixels that show two. Returns where these are: tiles (x, y, x end, y end), row
   * by row from below.
   */
  static std::vector<std::array<int, 4>> Run(const vtkPointSurfaceView& view,
    const vtkSurfacePixels& samples, vtkSurfacePixels& pixels, vtkSurfacePixels& lesser);
};

#endif
