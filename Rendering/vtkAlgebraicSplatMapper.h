// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAlgebraicSplatMapper
 * @brief   draws a surface of polynomial patches, ray by ray
 *
 * Takes what vtkAlgebraicSplats makes, fresh or from a file, as it is. The ray through each pixel
 * of the rectangle around a splat meets its polynomial, in the splat's own frame, at the first root
 * inside the disc; splats that overlap near the frontmost one are blended with Gaussian weights.
 * After: N. K. Bolla, P. J. Narayanan, Algebraic Splats Representation for Point Based Models,
 * section 3. One departure is part of the design: the paper blends shaded colours, here normals,
 * depths and colours are blended and shaded once, so that all of VTK's lights and materials hold.
 * By a headlight both ways are equally far from the truth, within a twentieth.
 *
 * Where a ray may meet a splat several times, the first root is found in double precision. A
 * context without GL_ARB_gpu_shader_fp64 has floats for that: of roots that all but touch, one too
 * far may be taken, or none.
 *
 * The points of the input are splats: selection returns their ids, and the array `InputPointIds`
 * leads on to the points that they were fitted to. An input without a splat's arrays gives an
 * error, and nothing is drawn. RadiusArray, Radius and RadiusScale do not change splats.
 *
 * @sa vtkAlgebraicSplats vtkPointSurfaceMapper
 */
#ifndef vtkAlgebraicSplatMapper_h
#define vtkAlgebraicSplatMapper_h

#include "vtkPointSurfaceMapper.h"

struct vtkAlgebraicSplatOptions;

class VTKPOINTSURFACE_EXPORT vtkAlgebraicSplatMapper : public vtkPointSurfaceMapper
{
public:
  static vtkAlgebraicSplatMapper* New();
  vtkTypeMacro(vtkAlgebraicSplatMapper, vtkPointSurfaceMapper);

  /**
   * Sets the properties below as the paper has them.
   */
  void SetToPublished();

  ///@{
  /**
   * Delta: splats within this share of the frontmost one's depth behind it are blended with it
   * (section 3.2), 0 to 1. Default 0.005.
   */
  vtkSetClampMacro(DepthShift, double, 0.0, 1.0);
  vtkGetMacro(DepthShift, double);
  ///@}

  ///@{
  /**
   * The weight of a splat in the blend is exp(-WeightFalloff d^2), d being the distance from its
   * centre within its plane, 1 at the edge of its disc; 0 to 100. The paper (section 3.2) has some
   * Gaussian: with 1 the weight at the edge is that of the fit at a distance of h, which leaves
   * seams there. Default 4.
   */
  vtkSetClampMacro(WeightFalloff, double, 0.0, 100.0);
  vtkGetMacro(WeightFalloff, double);
  ///@}

  ///@{
  /**
   * Never blend the front of a surface with the back of one: where the two sides of a thin part lie
   * within DepthShift, their normals would cancel (not in the paper). Default on.
   */
  vtkSetMacro(SeparateSides, bool);
  vtkGetMacro(SeparateSides, bool);
  vtkBooleanMacro(SeparateSides, bool);
  ///@}

  void PrintSelf(ostream& os, vtkIndent indent) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkAlgebraicSplatMapper();
  ~vtkAlgebraicSplatMapper() override;

  void AddArrayNames(std::vector<std::string>& names) override;
  void ComputeBounds() override;
  void BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  bool UsesProjection() const override { return false; }
  bool NeedsRadii() const override { return false; }
  void GetReach(double& mean, double& largest) const override;
  void MakeSurfaceBuffer(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
    vtkSurfaceTarget& surface) override;
  bool HasCPUForm() const override { return true; }
  std::string FindLackOfOpenGL() override;
  void MakeSurfacePixels(
    const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface) override;

  double DepthShift = 0.005;
  double WeightFalloff = 4.0;
  bool SeparateSides = true;

private:
  vtkAlgebraicSplatMapper(const vtkAlgebraicSplatMapper&) = delete;
  void operator=(const vtkAlgebraicSplatMapper&) = delete;

  vtkAlgebraicSplatOptions GetOptions() const;
  void UploadSplats(vtkOpenGLRenderWindow* window, bool colors); // what has changed

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
