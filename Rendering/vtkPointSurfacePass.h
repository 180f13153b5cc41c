// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSurfacePass
 * @brief   draws all opaque props, and reconstructs the clouds among them as one
 *
 * Ten clouds cost one reconstruction, and close each other's gaps: the picture is that of one
 * merged cloud, but for each actor's own material. It takes the place of vtkOpaquePass:
 *
 *     vtkNew<vtkRenderStepsPass> steps;
 *     steps->SetOpaquePass(vtkNew<vtkPointSurfacePass>());
 *     renderer->SetPass(steps);
 *
 * The clouds are those of actors with a vtkPointSurfaceMapper; the first one's properties say how
 * all are reconstructed. Clouds that do not fit to it are drawn by themselves: those of another
 * class of mapper; of another back end or supersampling; clipped by other planes; with scalars that
 * are mapped by texture, or texture coordinates; and, in parallel projection, clouds that reach
 * behind the camera's position. So are translucent clouds.
 *
 * vtkAlgebraicSplatMapper joins patches, each fitted to the points of its own cloud: they are
 * blended where they overlap, whatever cloud they are of.
 * vtkDirectPointMapper works at one sampling distance for all: the mean of those that the clouds
 * have or are given (SetRadius). That is the merged cloud's where clouds lie side by side; of
 * clouds that lie among each other, which are denser together than each one, it is larger.
 *
 * Clouds that are added one after the other and look alike (properties of the same values, no
 * textures, no shader replacements) are shaded at once; others each within the rectangle where
 * their points may be seen.
 *
 * Selection and hardware picking, which VTK's passes know nothing of, work as without passes.
 *
 * @sa vtkPointSurfaceMapper vtkRenderStepsPass vtkOpaquePass
 */
#ifndef vtkPointSurfacePass_h
#define vtkPointSurfacePass_h

#include "vtkOpenGLRenderPass.h"
#include "vtkPointSurfaceModule.h" // for export macro

#include <memory> // for std::unique_ptr

class VTKPOINTSURFACE_EXPORT vtkPointSurfacePass : public vtkOpenGLRenderPass
{
public:
  static vtkPointSurfacePass* New();
  vtkTypeMacro(vtkPointSurfacePass, vtkOpenGLRenderPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Render(const vtkRenderState* state) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  /**
   * Clouds that were reconstructed as one in the last frame; 0 when there were less than two.
   */
  vtkGetMacro(LastFrameJointClouds, int);

  /**
   * How often a part of the joint surface was shaded in the last frame: once for clouds that look
   * alike and were added one after the other; 0 when no clouds were joined.
   */
  vtkGetMacro(LastFrameShadings, int);

protected:
  vtkPointSurfacePass();
  ~vtkPointSurfacePass() override;

  int LastFrameJointClouds = 0;
  int LastFrameShadings = 0;

private:
  vtkPointSurfacePass(const vtkPointSurfacePass&) = delete;
  void operator=(const vtkPointSurfacePass&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
