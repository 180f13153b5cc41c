// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSplattingOpenGL
 * @brief   the step from points to a surface buffer by splats, by OpenGL
 *
 * A geometry shader makes each point the rectangle around its splat. All are drawn twice: for the
 * visible depths, and to blend what lies there; once more for ids, where they are wanted; a last
 * pass over the image takes the means.
 */
#ifndef vtkSurfaceSplattingOpenGL_h
#define vtkSurfaceSplattingOpenGL_h

#include "vtkPointProjectionOpenGL.h"
#include "vtkSplatMeanOpenGL.h"
#include "vtkSurfaceTarget.h"

#include <vector>

class vtkOpenGLRenderWindow;
class vtkWindow;
struct vtkSurfaceSplatParameters;

class vtkSurfaceSplattingOpenGL
{
public:
  vtkSurfaceSplattingOpenGL();
  ~vtkSurfaceSplattingOpenGL();

  ///@{
  /**
   * Finds the depths that are visible of the clouds' points, then fills `surface` within the
   * parameters' rectangle.
   */
  void FindDepths(vtkOpenGLRenderWindow* window, const vtkSurfaceSplatParameters& parameters,
    const std::vector<vtkPointProjectionOpenGL::Cloud>& clouds);
  void BlendSplats(vtkOpenGLRenderWindow* window, const vtkSurfaceSplatParameters& parameters,
    const std::vector<vtkPointProjectionOpenGL::Cloud>& clouds, vtkSurfaceTarget& surface);
  ///@}

  /**
   * Passes over the points or the image of the last run.
   */
  int GetPasses() const { return this->Passes; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkSurfaceSplattingOpenGL(const vtkSurfaceSplattingOpenGL&) = delete;
  void operator=(const vtkSurfaceSplattingOpenGL&) = delete;

  void DrawSplats(vtkOpenGLRenderWindow* window, const vtkSurfaceSplatParameters& parameters,
    const std::vector<vtkPointProjectionOpenGL::Cloud>& clouds, int use, vtkSurfaceTarget& target);

  vtkSurfaceTarget Visible;
  vtkSurfaceTarget Sums;
  vtkSurfaceTarget Ids;
  vtkSplatMeanOpenGL Mean;
  int Passes = 0;
};

#endif
