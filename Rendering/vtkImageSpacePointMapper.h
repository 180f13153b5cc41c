// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkImageSpacePointMapper
 * @brief   draws a point cloud as a surface by filling the gaps between one-pixel projections
 *
 * Each point is projected to one pixel; pixels of the background amid the surface, and pixels that
 * show a hidden surface through a gap, take the values of their nearest neighbour, again and again;
 * then the surface is smoothed. After: P. Rosenthal, L. Linsen, Image-space Point Cloud Rendering,
 * Computer Graphics International 2008. The method is for dense clouds: it closes gaps where points
 * project about two pixels apart or less; vtkPullPushMapper reaches farther. The radius of the
 * points only tells how far apart they are.
 *
 * The steps are passes too (vtkBackgroundFillPass and those named there), for what other mappers
 * draw; silhouettes and feature lines (sections 7 and 8) are passes alone.
 *
 * The defaults are what measures best; with SetToPublished(), and vtkProperty's BackfaceCulling on,
 * this is the algorithm as published.
 *
 * @sa vtkPointSurfaceMapper vtkPullPushMapper vtkBackgroundFillPass vtkSilhouettePass
 */
#ifndef vtkImageSpacePointMapper_h
#define vtkImageSpacePointMapper_h

#include "vtkPointSurfaceMapper.h"

class VTKPOINTSURFACE_EXPORT vtkImageSpacePointMapper : public vtkPointSurfaceMapper
{
public:
  static vtkImageSpacePointMapper* New();
  vtkTypeMacro(vtkImageSpacePointMapper, vtkPointSurfaceMapper);

  /**
   * Turns the departures from the paper off: FillWithinDiscs and KeepOutlines are off after it,
   * FarPlaneLayerDistance, SmoothAcrossLayers and SmoothLitColors are on, and there is one
   * iteration of smoothing with the kernel AlleviatedGaussian.
   */
  void SetToPublished();

  ///@{
  /**
   * Iterations at most of the fill of background pixels (section 4), -1 to 1000. Each takes a pixel
   * off every side of a hole; they end when there is nothing left to fill. -1, the default: as many
   * as the projected distance of the points asks for, so that real gaps stay open. The paper used 1
   * to 3.
   */
  vtkSetClampMacro(MaximumBackgroundFills, int, -1, 1000);
  vtkGetMacro(MaximumBackgroundFills, int);
  ///@}

  ///@{
  /**
   * The same for pixels that show a hidden surface (section 5).
   */
  vtkSetClampMacro(MaximumOccludedFills, int, -1, 1000);
  vtkGetMacro(MaximumOccludedFills, int);
  ///@}

  ///@{
  /**
   * Before all fills by masks, give pixels that are empty or show a hidden surface the values of a
   * point not more than three pixels away in whose disc they lie, half as wide as its radius: of
   * the surface in front, the one whose disc's centre is nearest. This closes most of the gaps in
   * one pass, from the right neighbour, fills outlines up to where the discs end, and cuts cleanly
   * along clipping planes. A lone point stays one pixel. The paper has no discs. Default on.
   */
  vtkSetMacro(FillWithinDiscs, bool);
  vtkGetMacro(FillWithinDiscs, bool);
  vtkBooleanMacro(FillWithinDiscs, bool);
  ///@}

  ///@{
  /**
   * Fill only what has the surface on all sides, no more pixels away than half of the iterations
   * at most, in eight directions. The paper's masks alone, which this adds to, fill each stair of
   * an outline too, once an iteration. Where a regular grid's rows run along one of the directions
   * the gap between them stays: a cross on a vtkSphereSource that is seen along its axis, which
   * FillWithinDiscs closes. Default on.
   */
  vtkSetMacro(KeepOutlines, bool);
  vtkGetMacro(KeepOutlines, bool);
  vtkBooleanMacro(KeepOutlines, bool);
  ///@}

  ///@{
  /**
   * Distance between two layers of surface (section 5), along the view direction in the units of
   * world coordinates: what is farther back than this is hidden, and is not smoothed with what is
   * in front. 0, the default: four times the mean radius of the points, whatever the camera.
   */
  vtkSetClampMacro(LayerDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LayerDistance, double);
  ///@}

  ///@{
  /**
   * Take 0.0001 times the distance of the far plane for LayerDistance, as the paper does. Default
   * off.
   */
  vtkSetMacro(FarPlaneLayerDistance, bool);
  vtkGetMacro(FarPlaneLayerDistance, bool);
  vtkBooleanMacro(FarPlaneLayerDistance, bool);
  ///@}

  ///@{
  /**
   * Iterations of smoothing (section 6), 0 to 100; default 1, as in the paper.
   */
  vtkSetClampMacro(SmoothingIterations, int, 0, 100);
  vtkGetMacro(SmoothingIterations, int);
  ///@}

  /**
   * The kernels of table 1: weights of the pixel, of a neighbour along a side, and over a corner.
   */
  enum KernelType
  {
    Box,               ///< 1, 1, 1
    Gaussian,          ///< 4, 2, 1
    AlleviatedGaussian ///< 16, 2, 1
  };

  ///@{
  /**
   * The kernel that smooths; see KernelType. Default AlleviatedGaussian, which the paper prefers.
   */
  vtkSetClampMacro(SmoothingKernel, int, Box, AlleviatedGaussian);
  vtkGetMacro(SmoothingKernel, int);
  ///@}

  ///@{
  /**
   * Smooth over the edges between two layers of surface too, as the paper does. Default off.
   */
  vtkSetMacro(SmoothAcrossLayers, bool);
  vtkGetMacro(SmoothAcrossLayers, bool);
  vtkBooleanMacro(SmoothAcrossLayers, bool);
  ///@}

  ///@{
  /**
   * Light the points first and smooth the lit colours, as the paper does (section 3); there is one
   * iteration at most then. Default off: normals, depths and colours are smoothed, then lit.
   */
  vtkSetMacro(SmoothLitColors, bool);
  vtkGetMacro(SmoothLitColors, bool);
  vtkBooleanMacro(SmoothLitColors, bool);
  ///@}

  ///@{
  /**
   * Blend the pixels of the outline with what has been drawn before (section 7), so draw what lies
   * behind first. Of no effect with Supersampling, which does it better. Default off.
   * vtkDepthAntialiasingPass does it for edges within the surface too.
   */
  vtkSetMacro(AntialiasOutline, bool);
  vtkGetMacro(AntialiasOutline, bool);
  vtkBooleanMacro(AntialiasOutline, bool);
  ///@}

  ///@{
  /**
   * Iterations that filled a pixel in the last frame; 0 in a frame without holes, and in one that
   * made no surface buffer.
   */
  vtkGetMacro(LastFrameBackgroundFills, int);
  vtkGetMacro(LastFrameOccludedFills, int);
  ///@}

  ///@{
  /**
   * Milliseconds that the last frame spent in a step, all of its iterations; as
   * GetLastFrameReconstructMilliseconds(), of which they are parts.
   */
  double GetLastFrameBackgroundFillMilliseconds();
  double GetLastFrameOccludedFillMilliseconds();
  double GetLastFrameSmoothingMilliseconds();
  double GetLastFrameAntialiasingMilliseconds();
  ///@}

  /**
   * Copies the one-pixel projections that the last surface buffer was made from into `buffer`: an
   * image of what the steps worked on: the pixel (0, 0) is the viewport's lower left one (or its
   * first sample), and where the cloud goes on outside of the viewport, a rim around that, from
   * which pixels are filled too. Point arrays: "Normals" (float, 3 components, eye space), "Depth"
   * (float, distance from the eye along the view direction in world units, 0 where no point fell),
   * "Radius" (float, world units), "Displacement" (float, 2 components, from the pixel's centre to
   * the point, in pixels; 0 where FillWithinDiscs is off), "Colors" (float, 4 components) if the
   * cloud has colours, "PointIds" (int, -1 where no point fell) if RecordPointIds is on. Field
   * data, as the frame used them: "LayerDistance" (1 double), "MaximumFills" (2 ints, background
   * and occluded), "Reach" (2 ints, the pixels within which KeepOutlines looks for the surface; 0
   * where it is off) and "DiscReach" (1 int, the pixels to each side in which FillWithinDiscs looks
   * for points; 0 where it is off).
   * Returns false, with an error, when nothing has been rendered yet.
   */
  bool ReadProjectedBuffer(vtkImageData* buffer);

  void PrintSelf(ostream& os, vtkIndent indent) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkImageSpacePointMapper();
  ~vtkImageSpacePointMapper() override;

  void MakeSurfaceBuffer(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
    vtkSurfaceTarget& surface) override;
  bool HasCPUForm() const override { return true; }
  double GetRim() const override { return 2.0; } // what fills may take their values from
  void MakeSurfacePixels(
    const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface) override;
  bool MakesCoverage() const override;

  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetMapperShaderParameters(
    vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override;

  int MaximumBackgroundFills = -1;
  int MaximumOccludedFills = -1;
  bool FillWithinDiscs = true;
  bool KeepOutlines = true;
  double LayerDistance = 0.0;
  bool FarPlaneLayerDistance = false;
  int SmoothingIterations = 1;
  int SmoothingKernel = AlleviatedGaussian;
  bool SmoothAcrossLayers = false;
  bool SmoothLitColors = false;
  bool AntialiasOutline = false;

  int LastFrameBackgroundFills = 0;
  int LastFrameOccludedFills = 0;

private:
  vtkImageSpacePointMapper(const vtkImageSpacePointMapper&) = delete;
  void operator=(const vtkImageSpacePointMapper&) = delete;

  struct Plan;
  Plan MakePlan(const vtkPointSurfaceView& view) const;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
