// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSplatMapper
 * @brief   draws a point cloud as a surface by blending the projections of its points' discs
 *
 * Each point's disc becomes an ellipse on the screen, a splat. A first pass over the splats finds
 * the visible depth of each pixel, a second one blends the normals, depths and colours of what lies
 * near that depth. After: M. Zwicker, H. Pfister, J. van Baar, M. Gross, Surface Splatting,
 * SIGGRAPH 2001, and M. Botsch, L. Kobbelt, High-Quality Point-Based Rendering on Modern GPUs,
 * Pacific Graphics 2003; with weights that end in place of a Gaussian. On the CPU back end the
 * splats are sorted into tiles that fit into the processor's cache.
 *
 * Fronts are not blended with backs: where both lie within the tolerance the front is seen, as with
 * vtkProperty's BackfaceCulling.
 *
 * @sa vtkPointSurfaceMapper vtkPullPushMapper vtkPointSpacing
 */
#ifndef vtkSurfaceSplatMapper_h
#define vtkSurfaceSplatMapper_h

#include "vtkPointSurfaceMapper.h"

struct vtkSurfaceSplatOptions;

class VTKPOINTSURFACE_EXPORT vtkSurfaceSplatMapper : public vtkPointSurfaceMapper
{
public:
  static vtkSurfaceSplatMapper* New();
  vtkTypeMacro(vtkSurfaceSplatMapper, vtkPointSurfaceMapper);

  ///@{
  /**
   * How far a splat is blended, in radii of its disc, 1 to 3: where other discs cover a pixel, and
   * to close gaps between discs. The weight is (1 - e)^4, e being the square of the distance from
   * the disc's centre, 1 where blending ends. More smooths noise in normals and positions, and
   * detail. Default 1.25.
   */
  vtkSetClampMacro(BlendRadius, double, 1.0, 3.0);
  vtkGetMacro(BlendRadius, double);
  ///@}

  ///@{
  /**
   * How far behind the visible depth a splat may lie to be blended, in radii of its own, 0 to 100;
   * two pixels' sizes are added. Less keeps thin sheets apart, more lets noisy points blend.
   * Default 2.
   */
  vtkSetClampMacro(DepthTolerance, double, 0.0, 100.0);
  vtkGetMacro(DepthTolerance, double);
  ///@}

  ///@{
  /**
   * Where projected radii are so small that pixels cannot tell the points apart, draw the means of
   * 2, 3, 4, 6, 8, 12, ... points that follow each other in space, with radii that are larger to
   * match: up to 1.1 pixels. A part of a cloud (vtkGhostPointsGenerator) is not thinned: other
   * processes would make other groups. Default on.
   */
  vtkSetMacro(ThinPoints, bool);
  vtkGetMacro(ThinPoints, bool);
  vtkBooleanMacro(ThinPoints, bool);
  ///@}

  void PrintSelf(ostream& os, vtkIndent indent) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkSurfaceSplatMapper();
  ~vtkSurfaceSplatMapper() override;

  void MakeSurfaceBuffer(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
    vtkSurfaceTarget& surface) override;
  bool ThinsPoints() const override { return this->ThinPoints && !this->IsPart(); }
  bool HasCPUForm() const override { return true; }
  void MakeSurfacePixels(
    const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface) override;

  double BlendRadius = 1.25;
  double DepthTolerance = 2.0;
  bool ThinPoints = true;

private:
  vtkSurfaceSplatMapper(const vtkSurfaceSplatMapper&) = delete;
  void operator=(const vtkSurfaceSplatMapper&) = delete;

  vtkSurfaceSplatOptions GetOptions() const;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
