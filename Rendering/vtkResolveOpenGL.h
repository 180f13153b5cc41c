// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkResolveOpenGL
 * @brief   the step from a supersampled surface buffer to one of the viewport's size
 *
 * Averages the samples of the surface that most of a pixel shows, and those of the other one where
 * there are two. The length of the resulting normal is the share of the pixel's samples that the
 * surface covers, for shading to blend edges by.
 */
#ifndef vtkResolveOpenGL_h
#define vtkResolveOpenGL_h

#include "vtkSurfaceTarget.h"

#include <map>
#include <memory>
#include <utility>
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
   * Fills `surface`, or with `lesser` that with the other surface of pixels that show two, from
   * `samples`, which has view.Supersampling times its width and height and the same layers, within
   * the view's rectangle.
   */
  void Run(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
    vtkSurfaceTarget& samples, vtkSurfaceTarget& surface, bool lesser);

  void ReleaseGraphicsResources();

private:
  vtkResolveOpenGL(const vtkResolveOpenGL&) = delete;
  void operator=(const vtkResolveOpenGL&) = delete;

  using Kind = std::pair<std::vector<vtkSurfaceTarget::Layer>, int>; // layers, supersampling

  std::map<Kind, std::unique_ptr<vtkScreenPass>> Passes;
};

#endif
