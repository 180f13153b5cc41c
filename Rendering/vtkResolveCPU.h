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

struct vtkPointSurfaceView;
struct vtkSurfacePixels;

class vtkResolveCPU
{
public:
  /**
   * Makes `pixels` from `samples`, which are those of the view's rectangle.
   */
  static void Run(
    const vtkPointSurfaceView& view, const vtkSurfacePixels& samples, vtkSurfacePixels& pixels);
};

#endif
