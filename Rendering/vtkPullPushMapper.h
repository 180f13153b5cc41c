// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPullPushMapper
 * @brief   draws a point cloud as a surface by pull-push interpolation of one-pixel projections
 *
 * Each point is projected to one pixel; a pyramid of coarser images is built from them (pull) and
 * used to fill the pixels between points and to overwrite those that a surface in front occludes
 * (push); elliptical box filters, the projections of the points' discs, limit how far a point
 * reaches. After: R. Marroquim, M. Kraus, P. R. Cavalcanti, Efficient Point-Based Rendering Using
 * Image Reconstruction, Symposium on Point-Based Graphics 2007. The cost is that of one pixel a
 * point plus that of the viewport, whatever the radii are.
 *
 * The defaults are what measures best; with SetToPublished(), and vtkProperty's BackfaceCulling on,
 * this is the algorithm as published.
 *
 * @sa vtkPointSurfaceMapper vtkPointSpacing
 */
#ifndef vtkPullPushMapper_h
#define vtkPullPushMapper_h

#include "vtkPointSurfaceMapper.h"

struct vtkPullPushOptions;

class VTKPOINTSURFACE_EXPORT vtkPullPushMapper : public vtkPointSurfaceMapper
{
public:
  static vtkPullPushMapper* New();
  vtkTypeMacro(vtkPullPushMapper, vtkPointSurfaceMapper);

  /**
   * Turns every departure from the paper, the properties below, off.
   */
  void SetToPublished();

  ///@{
  /**
   * Put a disc's centre where the point falls in its pixel; in the paper (section 3.2) it lies at
   * the pixel's centre. Default on.
   */
  vtkSetMacro(SubpixelCenters, bool);
  vtkGetMacro(SubpixelCenters, bool);
  vtkBooleanMacro(SubpixelCenters, bool);
  ///@}

  ///@{
  /**
   * Average the points that fall in one pixel, those that are behind the nearest one by no more
   * than its radius, or, where projected radii are under 1.4 pixels, than its plane is within the
   * pixel; in the paper (section 3.1) the nearest one stays alone. Default on.
   */
  vtkSetMacro(AveragePoints, bool);
  vtkGetMacro(AveragePoints, bool);
  vtkBooleanMacro(AveragePoints, bool);
  ///@}

  ///@{
  /**
   * Let the ray through a pixel meet the disc itself, and take the depth of that point; the paper
   * (section 3.2) takes the orthogonal projection of the disc and its least depth. Default on.
   */
  vtkSetMacro(PerspectiveDiscs, bool);
  vtkGetMacro(PerspectiveDiscs, bool);
  vtkBooleanMacro(PerspectiveDiscs, bool);
  ///@}

  ///@{
  /**
   * Weight by (1 - e) (1 + b) in the push phase, e being the square of the distance from a disc's
   * centre, 1 at its edge, b the paper's weights (section 3.3): 9, 3, 3, 1 of 16. That is 0.15 dB
   * nearer to the true surface, on average over the benchmark's models, than (1 - e)^2. Default on.
   */
  vtkSetMacro(DistanceWeights, bool);
  vtkGetMacro(DistanceWeights, bool);
  vtkBooleanMacro(DistanceWeights, bool);
  ///@}

  ///@{
  /**
   * Where projected radii are under 2.5 pixels, give a coarser pixel a radius that covers the discs
   * below it; the paper (section 3.2) takes the mean of their radii, which leaves holes there.
   * Default on.
   */
  vtkSetMacro(UnionRadii, bool);
  vtkGetMacro(UnionRadii, bool);
  vtkBooleanMacro(UnionRadii, bool);
  ///@}

  ///@{
  /**
   * Fill single pixels that are empty, or (with culling off) show the back of a surface through a
   * gap in its front, by the masks of Rosenthal and Linsen 2008 (section 6), which where radii are
   * under 8 pixels leave the corners of a stepped outline open; this paper leaves all of them as
   * they are. Default on.
   */
  vtkSetMacro(FillPixels, bool);
  vtkGetMacro(FillPixels, bool);
  vtkBooleanMacro(FillPixels, bool);
  ///@}

  ///@{
  /**
   * In the push phase too, average only pixels near the frontmost one (within twice its depth
   * interval), much as the pull phase does; the paper (section 3.3) averages all of them, which
   * mixes two surfaces at their borders. With culling off, discs that face away also give way to
   * discs before them that face the viewer, but where their normals are nearly opposite, as those
   * of one sheet are whose normals point to either side. Default on.
   */
  vtkSetMacro(DepthTestInPush, bool);
  vtkGetMacro(DepthTestInPush, bool);
  vtkBooleanMacro(DepthTestInPush, bool);
  ///@}

  ///@{
  /**
   * Where the cloud's typical radius is projected to under 2.5 pixels (of those that are drawn,
   * more than are shown with Supersampling), average a pixel of the finest level that stays with
   * the coarser ones around it whose discs cover it at its depth, by their weights there, so that
   * dense clouds flicker less; in the paper (section 3.3) it stays as it is. Its id is its own
   * point's. Default on.
   */
  vtkSetMacro(BlendPixels, bool);
  vtkGetMacro(BlendPixels, bool);
  vtkBooleanMacro(BlendPixels, bool);
  ///@}

  ///@{
  /**
   * Show a point in its own pixel only where its disc covers the pixel's centre, to within a fifth
   * of a pixel, more where projected radii are under 2.5 pixels; and where they are under 1.4
   * pixels, so that several points are averaged in a pixel, only where these do not lie aside of
   * its centre by more than a quarter of a pixel, with an outline on the other side, and the
   * surface is three pixels wide or more: else it is empty, or shows what is behind. In the paper
   * (section 3.3) a point stays in its pixel whatever part of it the disc covers, so that outlines
   * lie half a pixel outside of the surface's. Default on.
   */
  vtkSetMacro(TrimOutlines, bool);
  vtkGetMacro(TrimOutlines, bool);
  vtkBooleanMacro(TrimOutlines, bool);
  ///@}

  ///@{
  /**
   * Where projected radii are so small that pixels cannot tell the points apart, draw the means of
   * 2, 3, 4, 6, 8, 12, ... points that follow each other in space, with radii that are larger to
   * match: up to 0.8 pixels; in the paper all points are drawn. A part of a cloud
   * (vtkGhostPointsGenerator) is not thinned: other processes would make other groups. Default on.
   */
  vtkSetMacro(ThinPoints, bool);
  vtkGetMacro(ThinPoints, bool);
  vtkBooleanMacro(ThinPoints, bool);
  ///@}

  /**
   * Copies the one-pixel projections that the last surface buffer was made from into `buffer`: an
   * image of what the steps worked on: the pixel (0, 0) is the viewport's lower left one (or its
   * first sample), and where the cloud goes on outside of the viewport, a rim around that, whose
   * points' discs may reach into it, is there too. Point arrays: "Normals" (float, 3
   * components, eye space), "Radius" (float, eye units, 0 where no point fell), "Depth" (float,
   * distance from the eye along the view direction in world units), "Displacement" (float, 2
   * components, in pixels from the pixel's centre to the disc's), "Colors" (float, 4 components) if
   * the cloud has colours, "PointIds" (int, -1 where no point fell) if RecordPointIds is on. Field
   * data: "Projection" (16 doubles, the matrix from eye to clip coordinates by rows, for column
   * vectors), "Levels" (int, levels of the pyramid above the finest one). Returns false, with an
   * error, when nothing has been rendered yet.
   */
  bool ReadProjectedBuffer(vtkImageData* buffer);

  void PrintSelf(ostream& os, vtkIndent indent) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkPullPushMapper();
  ~vtkPullPushMapper() override;

  void MakeSurfaceBuffer(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
    vtkSurfaceTarget& surface) override;
  bool ThinsPoints() const override { return this->ThinPoints && !this->IsPart(); }
  bool HasCPUForm() const override { return true; }
  double GetRim() const override { return 1.0; } // discs
  std::string FindLackOfOpenGL() override;
  void MakeSurfacePixels(
    const vtkPointSurfaceView& view, bool ids, bool colors, vtkSurfacePixels& surface) override;

  bool SubpixelCenters = true;
  bool AveragePoints = true;
  bool PerspectiveDiscs = true;
  bool DistanceWeights = true;
  bool UnionRadii = true;
  bool FillPixels = true;
  bool DepthTestInPush = true;
  bool BlendPixels = true;
  bool TrimOutlines = true;
  bool ThinPoints = true;

private:
  vtkPullPushMapper(const vtkPullPushMapper&) = delete;
  void operator=(const vtkPullPushMapper&) = delete;

  vtkPullPushOptions GetOptions() const;
  vtkPointProjectionOptions GetProjectionOptions(const vtkPointSurfaceView& view) const;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
