// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSurfaceMapper
 * @brief   draws a point cloud as the closed, lit surface that it stands for
 *
 * The abstract base of the mappers of this module. It owns what they share: the upload of the
 * points, the surface buffer (for each pixel the eye depth, the eye-space normal, the colour and
 * the id of a point), shading through VTK's own shader template, and statistics. A subclass says
 * how the surface buffer is made from the points.
 *
 * A mapper takes the place of vtkPolyDataMapper: lights, materials, lookup tables, depth against
 * other props come from VTK. The input is any vtkPointSet; its points are drawn, whether they are
 * in cells or not. Normals come from the point data, else they are estimated once
 * (vtkPointNormals), as
 * radii are: the mapper's progress events tell of it, and AbortExecute stops it until the next
 * frame. vtkProperty's
 * BackfaceCulling drops points whose normal faces away (as the papers do, for closed surfaces with
 * outward normals); without it, VTK's default, all points are drawn, whichever way their normals
 * point, and the surface is lit from both sides. Flat interpolation is drawn smooth: a cloud has no
 * facets.
 *
 * Input that cannot be drawn as it is gets a warning that names the array, the value and the
 * remedy, and a frame all the same: points with a coordinate that is not finite are left out;
 * normals that are zero or not finite are taken as facing the viewer; radii that are not positive
 * and finite become the mean of the others; radii larger than the cloud become its diagonal.
 *
 * The input may also be a tree of point sets (vtkMultiBlockDataSet, vtkPartitionedDataSet,
 * vtkPartitionedDataSetCollection), with what vtkCompositePolyDataMapper2 offers for its blocks:
 * visibility, pickability, colour and opacity of each. All opaque blocks are reconstructed as one
 * cloud, so that they close each other's gaps, and so are all translucent ones.
 *
 * Of points with a ghost array (vtkGhostType) those are not drawn that it hides (HIDDENPOINT).
 * Copies of another process' points (DUPLICATEPOINT, as vtkGhostPointsGenerator makes them) take
 * part in the surface, but the pixels that come from them lie behind those of the process that has
 * the points: where pictures are put together by depth, each pixel is that of a process that knows
 * all around it. Translucent surfaces, which are blended, are drawn without these pixels.
 *
 * @sa vtkPullPushMapper vtkSurfaceSplatMapper vtkPointSpacing vtkPointNormals vtkIsosurfacePoints
 */
#ifndef vtkPointSurfaceMapper_h
#define vtkPointSurfaceMapper_h

#include "vtkCompositePointMapper.h"
#include "vtkPointSurfaceModule.h" // for export macro
#include "vtkSmartPointer.h"       // for vtkSmartPointer

#include <array>  // for std::array
#include <memory> // for std::unique_ptr
#include <set>    // for std::set
#include <string> // for std::string
#include <vector> // for std::vector

class vtkDrawablePoints;
class vtkDuplicatePoints;
class vtkImageData;
class vtkOpenGLRenderWindow;
class vtkOpenGLVertexBufferObjectCache;
class vtkShaderProgram;
class vtkJointSurface;
class vtkSurfaceImage;
class vtkSurfaceTarget;
struct vtkDrawnClouds;
struct vtkJointSurfaceMember;
struct vtkPointProjectionOptions;
struct vtkPointSurfaceView;
struct vtkSurfaceBuffer;
struct vtkSurfacePixels;

class VTKPOINTSURFACE_EXPORT vtkPointSurfaceMapper : public vtkCompositePointMapper
{
public:
  vtkTypeMacro(vtkPointSurfaceMapper, vtkCompositePointMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Name of the point array (one component) with the radius of each point, in the units of the
   * points' coordinates. Default: none. Which radius is used: this array if it is named; else
   * Radius if that is over 0; else an array named "radius", as vtkIsosurfacePoints and
   * vtkPointSpacing make it; else an estimate from the data, made once (vtkPointSpacing).
   */
  vtkSetStringMacro(RadiusArray);
  vtkGetStringMacro(RadiusArray);
  ///@}

  ///@{
  /**
   * One radius for all points, in the units of their coordinates; 0 (the default) means that there
   * is none. See RadiusArray for the order in which sources of the radius are tried. A radius that
   * is too small leaves holes; one that is twice too large costs little: 1.5 to 2 times the mean
   * spacing is a good value.
   */
  vtkSetClampMacro(Radius, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Radius, double);
  ///@}

  ///@{
  /**
   * Factor on all radii, wherever they come from: 1e-6 to 1e6; default 1. Uploads nothing.
   */
  vtkSetClampMacro(RadiusScale, double, 1e-6, 1e6);
  vtkGetMacro(RadiusScale, double);
  ///@}

  ///@{
  /**
   * Samples along each side of a pixel, 1 to 4; default 1. The surface buffer is made that many
   * times finer and then averaged: smoother normals; edges where one part of the cloud hides
   * another, blended by the shares that both have of a pixel (depth, id and, in a joint surface,
   * material are of the part with the larger share); and outlines that blend with what has
   * been drawn before (so draw what lies behind first, or give the window multisamples: there
   * outlines blend by the share of samples that they cover, whatever is drawn first, without
   * supersampling too). The cost grows with the number of samples. 2 and 4 are better than 1, by
   * vtkPullPushMapper 3 may not be: a torus of 100,000 points, zoomed in four times, is at 38.74,
   * 39.20, 37.37 and 39.12 dB with 1 to 4. A value for which the viewport would be larger than a
   * texture can be, or have more than 2^25 samples, is lowered, with a warning.
   */
  vtkSetClampMacro(Supersampling, int, 1, 4);
  vtkGetMacro(Supersampling, int);
  ///@}

  /**
   * What makes the surface buffer from the points.
   */
  enum BackendType
  {
    Automatic, ///< CPU where OpenGL is run by the processor too, else OpenGL
    OpenGL,    ///< shaders
    CPU        ///< threaded C++ (vtkSMPTools); only the finished surface buffer is uploaded
  };

  ///@{
  /**
   * What makes the surface buffer; see BackendType. Both make the same picture, and shading is
   * VTK's with both. A mapper that has no CPU form uses OpenGL, with a warning where CPU was asked
   * for. Where the window's context lacks what OpenGL needs here (targets of floats, large points
   * or texture buffers) CPU takes its place, with a warning that names it; a context without
   * textures of floats or integers gets an error, and the cloud is not drawn. Default Automatic.
   */
  vtkSetClampMacro(Backend, int, Automatic, CPU);
  vtkGetMacro(Backend, int);
  void SetBackendToAutomatic() { this->SetBackend(Automatic); }
  void SetBackendToOpenGL() { this->SetBackend(OpenGL); }
  void SetBackendToCPU() { this->SetBackend(CPU); }
  ///@}

  /**
   * The back end that the last frame was made with, OpenGL or CPU; Automatic before the first one.
   */
  vtkGetMacro(LastFrameBackend, int);

  ///@{
  /**
   * What the last frame cost: points sent to projection (those that may be in the picture); the
   * rectangle of the viewport that was worked on (x, y, width, height in pixels from its lower left
   * corner), and how many pixels of it were lit, once or, at edges, twice: on the CPU back end, in
   * bands of rows, those from the first to the last with a surface, else all; levels of the image
   * pyramid above the finest one, and passes over images; how often a surface buffer was made (0
   * when one of an earlier frame still held). In a frame that made none, points, levels and passes
   * are 0.
   */
  vtkGetMacro(LastFramePointsDrawn, vtkIdType);
  vtkGetVector4Macro(LastFrameRectangle, int);
  vtkGetMacro(LastFramePixelsShaded, vtkIdType);
  vtkGetMacro(LastFrameLevels, int);
  vtkGetMacro(LastFramePasses, int);
  vtkGetMacro(LastFrameReconstructions, int);
  ///@}

  ///@{
  /**
   * Bytes that the last frame sent to OpenGL: of the cloud, that is of its coordinates, normals,
   * radii, colours, ids to draw, means of thinned points and colour table; and, on the CPU back end,
   * of the surface buffer. The first is 0 unless the data or its colours have changed, or points
   * are thinned to groups of another size than ever before (vtkSurfaceSplatMapper::SetThinPoints);
   * on the CPU back end, where the cloud stays in memory, it is a few bytes once. The second is 0
   * when a surface buffer of an earlier frame still held.
   */
  vtkGetMacro(LastFrameBytesUploaded, vtkIdType);
  vtkGetMacro(LastFrameSurfaceBytesUploaded, vtkIdType);
  ///@}

  ///@{
  /**
   * Milliseconds that the last frame spent in a stage; 0 for a stage that did not run. By OpenGL's
   * timer, waiting until the frame is finished; on the CPU back end the first two by the clock, the
   * upload being a part of Reconstruct.
   */
  double GetLastFrameProjectMilliseconds();
  double GetLastFrameReconstructMilliseconds();
  double GetLastFrameShadeMilliseconds();
  ///@}

  /**
   * Copies the surface buffer that the last frame was shaded from into `buffer`: an image with a
   * pixel for each pixel of the viewport, the origin at its lower left. It is that of the last
   * frame in which VTK drew this mapper: of an actor that is hidden or culled VTK tells no mapper.
   * Eye space is the camera's view space, except for a camera whose eye is not at that space's
   * origin (off-axis, stereo, among the points in parallel projection): then it is the eye's own,
   * which looks across the screen. Point arrays: "Normals" (float, 3 components, eye space, unit
   * length, oriented as the points' normals, 0 where there is no surface), "Depth" (float, distance
   * from the eye along its z axis in world units, 0 where there is no surface), "Coverage" (float,
   * share of the pixel's samples with a surface); "Colors" (float, 4 components, 0 to 1) if the
   * cloud has colours; "PointIds" (int, -1 where there is no surface) if RecordPointIds is on.
   * Returns false, with an error, when nothing has been rendered yet.
   */
  bool ReadSurfaceBuffer(vtkImageData* buffer);

  ///@{
  /**
   * Carry the id of a point in every pixel of the surface buffer, in every frame. Selection asks
   * for ids by itself, so this is for ReadSurfaceBuffer alone. Default off.
   */
  vtkSetMacro(RecordPointIds, bool);
  vtkGetMacro(RecordPointIds, bool);
  vtkBooleanMacro(RecordPointIds, bool);
  ///@}

  /**
   * Whether OpenGL is run by the processor, as far as the name of the current context's renderer
   * tells. False without a context.
   */
  static bool IsSoftwareRasterizer();

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkPointSurfaceMapper();
  ~vtkPointSurfaceMapper() override;

  /**
   * Whether the subclass makes use of the points' normals (see the superclass) and radii. What it
   * does not need is neither estimated nor uploaded, and faults in it are not warned of. Points
   * without normals face the viewer in ProjectPoints(), and are not culled; without radii the
   * view's radii are 0, and projected points have the radius 1. Both true by default.
   */
  virtual bool NeedsRadii() const { return true; }

  /**
   * How far the image that the subclass works on is to reach over the viewport where the cloud
   * does, in radii of the points: as far as what is outside has a part in what is inside. 0 by
   * default.
   */
  virtual double GetRim() const { return 0.0; }

  /**
   * For a subclass that needs no radii but the sampling distance of the cloud, which then is the
   * radius of all points: the quantile that vtkSamplingDistance estimates it by. Below 0, the
   * default: it is not needed.
   */
  virtual double GetNeededSamplingQuantile() const { return -1.0; }

  /**
   * Whether ProjectPoints() is used. If not, no point is uploaded, nor are normals estimated: the
   * subclass uploads what it draws, from GetDrawablePoints(), the normals of GetBlocks() and
   * GetPointColor(), whenever the view's DataTime changes. True by default.
   */
  virtual bool UsesProjection() const { return true; }

  /**
   * How far from a point its part of the surface reaches, on average and at most, in the points'
   * units: the view's MeanRadius and LargestRadius. By default the points' radii.
   */
  virtual void GetReach(double& mean, double& largest) const;

  ///@{
  /**
   * The points of the frame, the colour or texture coordinates that are carried for one, and when
   * these last changed.
   */
  const vtkDrawablePoints& GetDrawablePoints() const;
  std::array<float, 4> GetPointColor(vtkIdType id) const;
  vtkMTimeType GetPointColorsTime() const;
  ///@}

  /**
   * Makes the surface buffer of `view` from the uploaded points: fills `surface`, whose layers are
   * allocated, within the view's rectangle. OpenGL's state is as a step needs it: no blending, no
   * depth test; the framebuffer is restored by the caller. Sets the levels and passes of the
   * statistics.
   */
  virtual void MakeSurfaceBuffer(
    vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view, vtkSurfaceTarget& surface) = 0;

  /**
   * Whether the normals' length is the share of the pixel that the surface covers, to blend by;
   * with Supersampling it is so whatever this returns. Default false.
   */
  virtual bool MakesCoverage() const { return false; }

  /**
   * Whether fewer points are drawn where pixels cannot tell them apart, see GetDrawnClouds() and
   * vtkPointThinning. Default false.
   */
  virtual bool ThinsPoints() const { return false; }

  /**
   * For subclasses: whether other processes have the rest of the cloud (vtkGhostPointsGenerator).
   */
  bool IsPart() const;

  /**
   * For subclasses: which points are copies of those of other processes, for shaders, to be
   * deactivated by who calls; nullptr where none are or this context cannot tell.
   */
  vtkDuplicatePoints* ActivateDuplicates();

  /**
   * What MakeSurfaceBuffer() needs and the current context lacks, in the words of vtkContextNeeds;
   * empty where it lacks nothing. Then MakeSurfacePixels() is called in its place, with a warning.
   */
  virtual std::string FindLackOfOpenGL();

  ///@{
  /**
   * MakeSurfaceBuffer() by the processor, for subclasses that can: makes the pixels of the view's
   * rectangle, with ids and colours if asked. What it is given is what ProjectPoints() wants.
   */
  virtual bool HasCPUForm() const { return false; }
  virtual void MakeSurfacePixels(
    const vtkPointSurfaceView&, bool vtkNotUsed(ids), bool vtkNotUsed(colors), vtkSurfacePixels&)
  {
  }
  ///@}

  /**
   * Draws each point to at most one pixel of `projected`, for subclasses to start from. The target
   * gets the layers Shape and Interval, and Id and Color where `surface` has them. With `farthest`
   * the points are drawn once more, to that: of each pixel the farthest point that lies within the
   * options' depth tolerance behind the nearest one.
   */
  void ProjectPoints(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
    const vtkPointProjectionOptions& options, const vtkSurfaceTarget& surface,
    vtkSurfaceTarget& projected, vtkSurfaceTarget* farthest = nullptr);
  void ProjectPoints(const vtkPointSurfaceView& view, const vtkPointProjectionOptions& options,
    bool ids, bool colors, vtkSurfaceImage& projected, vtkSurfaceImage* farthest = nullptr);

  ///@{
  /**
   * For subclasses that draw points by steps of their own in place of ProjectPoints(): the clouds,
   * for the back end of the frame, less what lies outside of the image by more than `reach` radii.
   * Their points are counted for the statistics; if they are to be thinned (see vtkPointThinning),
   * the views have larger radii to match. For those that draw something else than points: the
   * mappers of the clouds, of this class all, and their views; one, but in vtkPointSurfacePass.
   * What the subclass does from BeginProjection() to EndProjection() is timed as projection, the
   * rest as reconstruction.
   */
  vtkDrawnClouds GetDrawnClouds(
    const vtkPointSurfaceView& view, int thinning = 1, double reach = 0.0);
  const std::vector<vtkJointSurfaceMember>& GetMembers() const;
  void BeginProjection();
  void EndProjection();
  ///@}

  /**
   * For subclasses that show what they started from: copies what ProjectPoints() drew for `view`
   * into `buffer`, an image of all that the steps worked on, the rim too. Point arrays: "Normals",
   * "Radius", "Depth" and "Displacement", and "Colors" and "PointIds" where there are such layers.
   * False, with an error, before the first frame.
   */
  bool ReadProjection(const vtkPointSurfaceView& view, vtkSurfaceTarget& projected,
    vtkSurfaceImage& projectedByCPU, vtkImageData* buffer);

  /**
   * The window of the last frame; nullptr before the first one.
   */
  vtkOpenGLRenderWindow* GetLastWindow() const;

  /**
   * The view of the surface buffer that is being shaded.
   */
  const vtkPointSurfaceView& GetShadedView() const;

  /**
   * For subclasses that shade what the surface buffer is drawn from: a target that is kept with it,
   * of the surface buffer that is being made or shaded.
   */
  vtkSurfaceTarget& GetSplats();

  ///@{
  /**
   * Adds a layer as vtkSurfaceTarget and vtkSurfaceImage return it to `image`: `components` of the
   * four, from `first` on; ids from -1 as the array "PointIds".
   */
  static void AddLayer(vtkImageData* image, const std::vector<float>& layer, const char* name,
    int first, int components);
  static void AddIds(vtkImageData* image, const std::vector<unsigned int>& layer);
  /**
   * Empties `image` and gives it the extent of one that the steps work on: its pixel (0, 0) is the
   * viewport's lower left one, and `rim` pixels around the viewport are there too.
   */
  static void SetImageExtent(vtkImageData* image, int width, int height, int rim);
  ///@}

  // What VTK calls while it renders; see vtkOpenGLPolyDataMapper.
  void AddArrayNames(std::vector<std::string>& names) override;
  void ComputeBounds() override;
  void UpdateCameraShiftScale(vtkRenderer* renderer, vtkActor* actor) override;
  int CanUseTextureMapForColoring(vtkDataObject* input) override;
  bool GetNeedToRebuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  std::vector<std::pair<vtkTexture*, std::string>> GetTextures(vtkActor* actor) override;
  void BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void BuildIBO(vtkRenderer*, vtkActor*, vtkPolyData*) override {}
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;
  void GetShaderTemplate(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderEdges(std::map<vtkShader::Type, vtkShader*>, vtkRenderer*, vtkActor*) override
  {
  }
  void SetMapperShaderParameters(
    vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override;
  bool GetNeedToRebuildShaders(
    vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override;
  bool HaveWideLines(vtkRenderer*, vtkActor*) override { return false; }
  bool DrawingEdges(vtkRenderer*, vtkActor*) override { return false; }

  char* RadiusArray = nullptr;
  double Radius = 0.0;
  double RadiusScale = 1.0;
  int Supersampling = 1;
  bool RecordPointIds = false;
  int Backend = Automatic;

  int LastFrameBackend = Automatic;
  vtkIdType LastFramePointsDrawn = 0;
  int LastFrameRectangle[4] = { 0, 0, 0, 0 };
  vtkIdType LastFramePixelsShaded = 0;
  int LastFrameLevels = 0;
  int LastFramePasses = 0;
  int LastFrameReconstructions = 0;
  vtkIdType LastFrameBytesUploaded = 0;
  vtkIdType LastFrameSurfaceBytesUploaded = 0;

private:
  vtkPointSurfaceMapper(const vtkPointSurfaceMapper&) = delete;
  void operator=(const vtkPointSurfaceMapper&) = delete;

  void ExamineContext(vtkOpenGLRenderWindow* window);
  void ChooseBackend();
  // Whether only stand-ins of the points' arrays are uploaded, as ProjectPoints() by OpenGL is not.
  bool UploadsStandIns() const { return this->LastFrameBackend == CPU || !this->UsesProjection(); }
  void UpdateDrawablePoints();
  // The array if it has a tuple for each point; else nullptr, with a warning.
  vtkDataArray* RequireTuples(vtkDataArray* array, const char* what);
  // The image of the actor's texture if points have coordinates of it, else nullptr.
  vtkImageData* GetTextureOfPoints(vtkActor* actor);
  // Normals for the buffers; where there are none, one that stands in for them.
  vtkSmartPointer<vtkDataArray> GetNormals();
  // By the components of its buffers VTK knows what its shaders have to do; where nothing but that
  // is needed of them, a tuple of zeros is enough.
  void UploadStandIn(
    const char* attribute, vtkDataArray* array, vtkOpenGLVertexBufferObjectCache* cache);
  int GetPossibleSupersampling(const int viewport[2]);
  std::set<std::string> GetBufferNames() const;
  void CountBytesUploaded();
  void DrawBlocks(vtkRenderer* renderer, vtkActor* actor, const vtkPointBlockGroup& blocks);
  vtkPointSurfaceView GetView(
    vtkRenderer* renderer, vtkActor* actor, const vtkPointBlockGroup& blocks);
  void FindOrMakeSurfaceBuffer(vtkRenderer* renderer, const vtkPointSurfaceView& view);
  void MakeBuffer(
    vtkSurfaceBuffer& surface, const vtkPointSurfaceView& view, bool ids, bool colors);
  void ShadeSurfaceBuffer(vtkRenderer* renderer, vtkActor* actor);
  /// Draws rectangles of the surface buffer (x, y, x end, y end); returns of how many pixels.
  vtkIdType DrawRectangles(vtkShaderProgram* program, const std::vector<std::array<int, 4>>& bands);
  /// What pixels that show two surfaces show behind, or less, of.
  void DrawLesserSurface(vtkShaderProgram* program);

  // The cloud as a part of a joint surface; see vtkPointSurfacePass.
  friend class vtkPointSurfacePass;
  void SetJointSurface(vtkJointSurface* joint);
  void MakeJointSurface(const vtkJointSurface& joint);
  bool BeginsFrame() const;
  bool HasDuplicates() const;
  bool CanTellDuplicates(); ///< warns where they are there, and the context cannot hold them
  // Whether this call of VTK's was for the cloud to join, not to be drawn.
  bool JoinSurface(vtkActor* actor, const vtkPointSurfaceView& view);
  bool FindJointSurface(const vtkPointSurfaceView& view);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
