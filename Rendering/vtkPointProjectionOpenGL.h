// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointProjectionOpenGL
 * @brief   the step from uploaded points to an image with at most one pixel a point
 *
 * Each point that survives culling, clipping and the depth test writes its normal, radius and
 * depth interval (and id and colour, where the target has these layers) to the one pixel that it
 * falls on (Marroquim, Kraus, Cavalcanti 2007, section 3.1). If the points of a pixel are to be
 * averaged, they are drawn a second time and added up by blending. The attributes are written here,
 * not fetched by id later for the pixels that are seen: averaging needs those of all points of a
 * pixel, and to write ids alone and fetch saves, at 512 x 512 on a software rasteriser, nothing
 * with 100,000 points and a sixth of the pass with two million.
 */
#ifndef vtkPointProjectionOpenGL_h
#define vtkPointProjectionOpenGL_h

#include "vtkNew.h"
#include "vtkPointSurfaceView.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceTarget.h"
#include "vtkThinnedPoints.h"
#include "vtkTimeStamp.h"
#include "vtkType.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkDataArray;
class vtkDrawablePoints;
class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;
class vtkOpenGLVertexBufferObjectGroup;
class vtkScreenPass;
class vtkShaderProgram;
class vtkWindow;
struct vtkPointProjectionOptions;

class vtkPointProjectionOpenGL
{
public:
  /**
   * A cloud to draw: its projection and view; vertex buffers by the names vertexMC, normalMC,
   * radiusMC, scalarColor, tcoord and colorTCoord. Thinned, the view's ranges are those of
   * GetDrawn(), and its radii are those of what stands for groups, see vtkPointThinning.
   */
  struct Cloud
  {
    vtkPointProjectionOpenGL* Projection = nullptr;
    vtkPointSurfaceView View;
    int Thinning = 1;
    vtkOpenGLVertexBufferObjectGroup* Buffers = nullptr;
    double UniformRadius = 0.0; ///< 0: radiusMC has a radius for each point
    bool HaveNormals = true;    ///< else normalMC is not read: all points face the viewer
    vtkIdType FirstId = 0;      ///< what the ids of the points begin with
    std::array<float, 4> Color{ 1.0f, 1.0f, 1.0f, 1.0f }; ///< where they have no colours
  };

  /**
   * Whether the layer Color has something to carry: colours, scalars to be mapped by texture, or
   * texture coordinates, the first of these that the points have.
   */
  static bool HasColors(vtkOpenGLVertexBufferObjectGroup* buffers);

  vtkPointProjectionOpenGL();
  ~vtkPointProjectionOpenGL();

  /**
   * The ids of the points in the order of the buffers. `time` is when they were last changed; those
   * that are there already are not sent again. Returns the bytes that were sent.
   */
  size_t UploadIds(const std::vector<unsigned int>& ids, vtkMTimeType time);

  /**
   * What UploadThinned() takes: the points, which have to outlive its use; what the layer Color
   * carries of them, nullptr for none; and how their coordinates are uploaded.
   */
  void SetPoints(
    const vtkDrawablePoints* points, vtkDataArray* colors, const vtkThinnedPoints::Frame& frame);

  using Ranges = std::vector<std::array<vtkIdType, 2>>;

  ///@{
  /**
   * What is drawn of the points in groups of a size, see vtkPointThinning: it has to be uploaded
   * before it is drawn, is sent once and kept; returns the bytes that were sent. And the ranges of
   * it which are ranges of points.
   */
  size_t UploadThinned(int size);
  Ranges GetDrawn(int size, const Ranges& ranges) const;
  ///@}

  /**
   * Draws the points of the views' ranges of clouds into `target`, which has the layers Shape and
   * Interval at least, Id as the last one where points are averaged, and a depth buffer; all views
   * have one rectangle, which is emptied before.
   * With `nearest`, the result of such a run with centre depths, a pixel gets the farthest point
   * within the options' depth tolerance behind its nearest one.
   */
  void Draw(vtkOpenGLRenderWindow* window, const std::vector<Cloud>& clouds,
    const vtkPointProjectionOptions& options, vtkSurfaceTarget& target,
    vtkSurfaceTarget* nearest = nullptr);

  /**
   * For steps that draw points in another way: draws those of the views' ranges of clouds to the
   * target that is bound, by shaders of which the first follows vtkPointAttributes.glsl.
   * `setUniforms` is called with the program. Each `use` of shaders has a number.
   */
  static constexpr int NumberOfUses = 3;
  struct Shaders
  {
    std::string Vertex;
    std::string Geometry;
    std::string Fragment;
  };
  static void DrawBy(vtkOpenGLRenderWindow* window, const std::vector<Cloud>& clouds,
    const Shaders& shaders, int use, const std::function<void(vtkShaderProgram*)>& setUniforms);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkPointProjectionOpenGL(const vtkPointProjectionOpenGL&) = delete;
  void operator=(const vtkPointProjectionOpenGL&) = delete;

  /// Thinned points, uploaded.
  struct Uploaded
  {
    std::vector<unsigned int> Firsts; // of the groups
    vtkNew<vtkOpenGLBufferObject> Ids, Positions, Normals, Radii, Colors;
  };

  /// One way of drawing points: the attributes as its program takes them.
  struct Pass
  {
    vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
    vtkShaderProgram* BoundProgram = nullptr; // whose attributes VertexArray holds; not owned
    int BoundThinning = 1;                    // and of which size of groups
    vtkTimeStamp BindTime;
  };

  void DrawFirst(vtkOpenGLRenderWindow* window, const std::vector<Cloud>& clouds,
    const vtkPointProjectionOptions& options, vtkSurfaceTarget& target, vtkSurfaceTarget* nearest);
  void DrawSums(vtkOpenGLRenderWindow* window, const std::vector<Cloud>& clouds,
    const vtkPointProjectionOptions& options, vtkSurfaceTarget& target);
  void Average(vtkOpenGLRenderWindow* window, const std::array<int, 4>& rectangle,
    const vtkPointProjectionOptions& options, vtkSurfaceTarget& target);
  static vtkShaderProgram* ReadyProgram(vtkOpenGLRenderWindow* window, Pass& pass,
    const std::string& drawn, const std::string& fragmentShader, const Cloud& cloud,
    const vtkPointProjectionOptions& options);
  static vtkShaderProgram* ReadyShaders(
    vtkOpenGLRenderWindow* window, Pass& pass, const Shaders& shaders, const Cloud& cloud);
  static void DrawRanges(Pass& pass, const Cloud& cloud);
  void BindAttributes(Pass& pass, vtkShaderProgram* program, const Cloud& cloud);
  static void BindThinned(Pass& pass, vtkShaderProgram* program, const Cloud& cloud);
  static void BindIds(vtkShaderProgram* program, vtkOpenGLBufferObject* ids);
  static void SetUniforms(vtkShaderProgram* program, const Cloud& cloud);

  vtkNew<vtkOpenGLBufferObject> Ids;
  vtkMTimeType IdsTime = 0;
  const vtkDrawablePoints* Points = nullptr;
  vtkSmartPointer<vtkDataArray> Colors;
  vtkThinnedPoints::Frame Frame;
  std::map<int, Uploaded> Thinned; // by the size of groups
  vtkThinnedPoints::Source ThinnedSource;
  vtkTimeStamp PointsTime;
  Pass FirstPass;
  Pass SumPass;
  std::array<Pass, NumberOfUses> OtherPasses;
  vtkSurfaceTarget Sums; // of the points that share a pixel, but for the nearest one
  std::map<std::vector<vtkSurfaceTarget::Layer>, std::unique_ptr<vtkScreenPass>> AveragePasses;
};

#endif
