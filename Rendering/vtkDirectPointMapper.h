// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDirectPointMapper
 * @brief   draws bare, noisy positions as a smooth lit surface, with no normals and no radii
 *
 * For raw scans: nothing is asked of the points but their positions, and nothing is computed of
 * them beforehand but one sampling distance. The points are projected into an image buffer that is
 * so much coarser than the picture that its cells are as large as the sampling distance. In each
 * cell the nearest point is kept (pass 1) and the farthest one within a tolerance behind it (pass
 * 2); their average (pass 3) is less noisy than either. A plane fitted to the points of nine cells
 * gives a normal, oriented to the viewer (pass 4), and a splat with a Gaussian kernel brings it to
 * the picture's resolution (pass 5). After: H. Kawata, T. Kanai, Direct Point Rendering on GPU (in
 * Japanese: GPU による直接的ポイントレンダリング).
 *
 * The defaults are what measures best. SetToPublished() turns the departures off; then this is the
 * algorithm as published.
 *
 * The superclass's Radius is the sampling distance here, if over 0; RadiusScale is a factor on it,
 * so that 0.5 makes the image buffer twice as fine. RadiusArray, normals of the input and face
 * culling are of no effect, and both sides of a surface are lit.
 *
 * @sa vtkPointSurfaceMapper vtkPullPushMapper vtkPointNormals
 */
#ifndef vtkDirectPointMapper_h
#define vtkDirectPointMapper_h

#include "vtkPointSurfaceMapper.h"

struct vtkDirectOptions;
struct vtkDirectParameters;

class VTKPOINTSURFACE_EXPORT vtkDirectPointMapper : public vtkPointSurfaceMapper
{
public:
  static vtkDirectPointMapper* New();
  vtkTypeMacro(vtkDirectPointMapper, vtkPointSurfaceMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Turns every departure from the paper off: SamplingQuantile becomes 0, PublishedResolution,
   * FarthestPoints and ShadeBeforeSplatting are turned on, the other properties below off.
   */
  void SetToPublished();

  ///@{
  /**
   * Which quantile of the distances from points to their nearest neighbours at another position is
   * the sampling distance, 0 to 1. The paper (section 3.1) takes the least of them, 0, which a
   * single pair of near points spoils. It is estimated once, from 10000 of the points, from all of
   * them for 0, and not at all where Radius is set. A part of a cloud that is spread over processes
   * has the distance of the whole, by the quantile of vtkGhostPointsGenerator instead. Default
   * 0.98, in clouds sampled at random 1.1 times the distance of an even grid of as many points.
   */
  vtkSetClampMacro(SamplingQuantile, double, 0.0, 1.0);
  vtkGetMacro(SamplingQuantile, double);
  ///@}

  ///@{
  /**
   * Choose the resolution of the image buffer by the paper's equations 2 and 3, in perspective.
   * They depend on the units of the coordinates and on the clipping range, and so on other actors:
   * of use only to compare. The cloud's centroid is taken as the centre of its bounding box. Off, a
   * cell is as large as the sampling distance at the middle of the cloud's depths. Either way it is
   * no smaller than a pixel. Default off.
   */
  vtkSetMacro(PublishedResolution, bool);
  vtkGetMacro(PublishedResolution, bool);
  vtkBooleanMacro(PublishedResolution, bool);
  ///@}

  ///@{
  /**
   * Gamma, how far behind the nearest point of a cell another point still is of the same surface,
   * as a fraction of the diagonal of the cloud's bounding box: 0 to 1; default 0.0075. The paper
   * (section 3.2) finds 0.005 to 0.01 good.
   */
  vtkSetClampMacro(DepthTolerance, double, 0.0, 1.0);
  vtkGetMacro(DepthTolerance, double);
  ///@}

  ///@{
  /**
   * Do pass 2: use the farthest point of a cell, too. Off saves the time of a projection and takes
   * the noise of the nearest points as it is. Default on, as in the paper.
   */
  vtkSetMacro(FarthestPoints, bool);
  vtkGetMacro(FarthestPoints, bool);
  vtkBooleanMacro(FarthestPoints, bool);
  ///@}

  ///@{
  /**
   * Fit planes to the points of 49 cells, with weights that fall to 0 within three cells, first to
   * those not too far before or behind the cell's own points (or, where depths step evenly from
   * cell to cell, the slope that they follow), then to those near that plane; in the paper (section
   * 3.3) all points of 9 cells count the same. Surfaces at different depths do not mix, grazing
   * ones stay whole, noise is less, and normals change less as points move from cell to cell: this
   * is the remedy against flicker. Default on.
   */
  vtkSetMacro(WeightedNormals, bool);
  vtkGetMacro(WeightedNormals, bool);
  vtkBooleanMacro(WeightedNormals, bool);
  ///@}

  ///@{
  /**
   * Splats are discs in the plane of their cell, with that plane's depth; in the paper
   * (section 3.4) they are squares of one depth. Default on.
   */
  vtkSetMacro(PlaneSplats, bool);
  vtkGetMacro(PlaneSplats, bool);
  vtkBooleanMacro(PlaneSplats, bool);
  ///@}

  ///@{
  /**
   * Average only splats near the frontmost one of a pixel; the paper (section 3.4) averages all of
   * them, which mixes two surfaces at their borders. Default on.
   */
  vtkSetMacro(DepthTestInSplats, bool);
  vtkGetMacro(DepthTestInSplats, bool);
  vtkBooleanMacro(DepthTestInSplats, bool);
  ///@}

  ///@{
  /**
   * Where points are too sparse for the image buffer, take cells 2 or 4 times as large: for
   * clouds of uneven density, and for what lies near to the eye. The paper has cells of one size.
   * Default on.
   */
  vtkSetMacro(AdaptiveResolution, bool);
  vtkGetMacro(AdaptiveResolution, bool);
  vtkBooleanMacro(AdaptiveResolution, bool);
  ///@}

  ///@{
  /**
   * Light splats and average their colours, as the paper does (sections 3.3 and 3.4). Off, their
   * normals are averaged and each pixel is lit once: the error of pictures is the same within 0.1
   * dB, with noise too, and shading takes many times less, as a splat is lit anew for each pixel
   * that it covers. Depths are the same either way. Default off.
   */
  vtkSetMacro(ShadeBeforeSplatting, bool);
  vtkGetMacro(ShadeBeforeSplatting, bool);
  vtkBooleanMacro(ShadeBeforeSplatting, bool);
  ///@}

  /**
   * The size in cells of the image buffer that the last surface buffer was made from.
   */
  vtkGetVector2Macro(LastFrameImageSize, int);

  /**
   * Milliseconds of the last frame's stage Reconstruct that went into normals (passes 3 and 4); the
   * rest of it are the splats (pass 5). On OpenGL's back end 0.
   */
  vtkGetMacro(LastFrameNormalsMilliseconds, double);

  /**
   * Copies the image buffer that the last surface buffer was made from: the nearest point of each
   * cell and the farthest one within the tolerance. Point arrays: "Depth" (float, distance from the
   * eye along the view direction in world units), "Valid" (float, 0 where no point fell),
   * "Displacement" (float, 2 components, in cells from the cell's centre to the point), "Colors"
   * (float, 4 components) if the cloud has colours, "PointIds" (int) if RecordPointIds is on. Field
   * data: "Projection" (16 doubles, the matrix from eye to clip coordinates by rows, for column
   * vectors; the image reaches over the viewport where the cloud does, and so does this), "Gamma"
   * (the tolerance in eye units), "Size" (2 ints, of the surface buffer in samples). Returns false,
   * with an error, when nothing has been rendered yet.
   */
  bool ReadImageBuffer(vtkImageData* nearest, vtkImageData* farthest);

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkDirectPointMapper();
  ~vtkDirectPointMapper() override;

  bool NeedsNormals() const override { return false; }
  bool NeedsRadii() const override { return false; }
  double GetRim() const override { return 5.0; } // cells: of a fit and of a splat
  double GetNeededSamplingQuantile() const override { return this->SamplingQuantile; }
  void MakeSurfaceBuffer(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
    vtkSurfaceTarget& surface) override;
  bool HasCPUForm() const override { return true; }
  void MakeSurfacePixels(
    const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface) override;
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override;

  double SamplingQuantile = 0.98;
  bool PublishedResolution = false;
  double DepthTolerance = 0.0075;
  bool FarthestPoints = true;
  bool WeightedNormals = true;
  bool PlaneSplats = true;
  bool DepthTestInSplats = true;
  bool AdaptiveResolution = true;
  bool ShadeBeforeSplatting = false;

  int LastFrameImageSize[2] = { 0, 0 };
  double LastFrameNormalsMilliseconds = 0.0;

private:
  vtkDirectPointMapper(const vtkDirectPointMapper&) = delete;
  void operator=(const vtkDirectPointMapper&) = delete;

  vtkDirectOptions GetOptions() const;
  bool IsAlone() const; // in its surface buffer, the ids of which are those of its points
  void RememberParameters(const vtkDirectParameters& parameters);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
