// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkResolveOpenGL
 * @brief   the step from a supersampled surface buffer to one of the viewport's size
 *
 * Averages the samples of the surface that most of a pixel shows. The length of the resulting
 * normal is the share of the pixel's samples that are covered, for shading to blend outlines by.
 */
#ifndef vtkResolveOpenGL_h
#define vtkResolveOpenGL_h

#include "vtkSurfaceTarget.h"

#include <map>
#include <memory>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkScreenPass;
struct vtkPointSurfaceView;

class vtkResolveOpenGL
{
public:
  vtkResolveOpenGL();
  ~vtkResolveOpenGL();

  /**
   * Fills `surface` from `samples`, which has view.Supersampling times its width and height and
   * the same layers, within the view's rectangle.
   */
  void Run(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
    vtkSurfaceTarget& samples, vtkSurfaceTarget& surface);

  void ReleaseGraphicsResources();

private:
  vtkResolveOpenGL(const vtkResolveOpenGL&) = delete;
  void operator=(const vtkResolveOpenGL&) = delete;

  std::map<std::vector<vtkSurfaceTarget::Layer>, std::unique_ptr<vtkScreenPass>> Passes;
};

#endif
