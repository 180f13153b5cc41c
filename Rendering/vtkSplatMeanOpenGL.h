// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSplatMeanOpenGL
 * @brief   the pass from weighted sums of splats to a surface buffer
 *
 * The last step of all mappers that blend splats by OpenGL; see vtkSplatMeanFS.glsl.
 */
#ifndef vtkSplatMeanOpenGL_h
#define vtkSplatMeanOpenGL_h

#include "vtkSurfaceTarget.h"

#include <array>
#include <map>
#include <memory>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkScreenPass;

class vtkSplatMeanOpenGL
{
public:
  vtkSplatMeanOpenGL();
  ~vtkSplatMeanOpenGL();

  /**
   * Fills `surface` within a rectangle (x, y, width, height). `sums` has the layers Sum and Weight,
   * and Color if `surface` has it; `ids` has the id of the heaviest splat, and is only read if
   * `surface` has the layer Id.
   */
  void Run(vtkOpenGLRenderWindow* window, const std::array<int, 4>& rectangle,
    vtkSurfaceTarget& sums, vtkSurfaceTarget& ids, vtkSurfaceTarget& surface);

  void ReleaseGraphicsResources();

private:
  vtkSplatMeanOpenGL(const vtkSplatMeanOpenGL&) = delete;
  void operator=(const vtkSplatMeanOpenGL&) = delete;

  std::map<std::vector<vtkSurfaceTarget::Layer>, std::unique_ptr<vtkScreenPass>> Passes;
};

#endif
