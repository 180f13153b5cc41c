// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointProjectionOpenGL
 * @brief   the step from uploaded points to an image with at most one pixel a point
 *
 * Each point that survives culling, clipping and the depth test writes its normal, radius and
 * depth interval (and id and colour, where the target has these layers) to the one pixel that it
 * falls on (Marroquim, Kraus, Cavalcanti 2007, section 3.1). If the points of a pixel are to be
 * averaged, they are drawn a second time and added up by blending.
 */
#ifndef vtkPointProjectionOpenGL_h
#define vtkPointProjectionOpenGL_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkSurfaceTarget.h"
#include "vtkTimeStamp.h"
#include "vtkType.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLIndexBufferObject;
class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;
class vtkOpenGLVertexBufferObjectGroup;
class vtkScreenPass;
class vtkShaderProgram;
class vtkWindow;
struct vtkPointProjectionOptions;
struct vtkPointSurfaceView;

class vtkPointProjectionOpenGL
{
public:
  /**
   * What is drawn: vertex buffers by the names vertexMC, normalMC, radiusMC, scalarColor, tcoord
   * and colorTCoord.
   */
  struct Points
  {
    vtkOpenGLVertexBufferObjectGroup* Buffers = nullptr;
    double UniformRadius = 0.0; ///< 0: radiusMC has a radius for each point
    bool HaveNormals = true;    ///< else normalMC is not read: all points face the viewer
  };

  /**
   * Whether the layer Color has something to carry: colours, scalars to be mapped by texture, or
   * texture coordinates, the first of these that the points have.
   */
  static bool HasColors(vtkOpenGLVertexBufferObjectGroup* buffers);

  vtkPointProjectionOpenGL();
  ~vtkPointProjectionOpenGL();

  /**
   * Ids of the points to draw; an empty list stands for all of them. `time` is when they were last
   * changed; those that are there already are not sent again. Returns the bytes that were sent.
   */
  size_t UploadIds(const std::vector<unsigned int>& ids, vtkMTimeType time);

  /**
   * Draws the points of the view's ranges into `target`, which has the layers Shape and Interval at
   * least, and a depth buffer. With `nearest`, the result of such a run with centre depths, a pixel
   * gets the farthest point within the options' depth tolerance behind its nearest one. Returns the
   * number of points sent.
   */
  vtkIdType Draw(vtkOpenGLRenderWindow* window, const Points& points,
    const vtkPointSurfaceView& view, const vtkPointProjectionOptions& options,
    vtkSurfaceTarget& target, vtkSurfaceTarget* nearest = nullptr);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkPointProjectionOpenGL(const vtkPointProjectionOpenGL&) = delete;
  void operator=(const vtkPointProjectionOpenGL&) = delete;

  /// One way of drawing points: the attributes as its program takes them.
  struct Pass
  {
    vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
    vtkShaderProgram* BoundProgram = nullptr; // whose attributes VertexArray holds; not owned
    vtkTimeStamp BindTime;
  };

  vtkIdType DrawFirst(vtkOpenGLRenderWindow* window, const Points& points,
    const vtkPointSurfaceView& view, const vtkPointProjectionOptions& options,
    vtkSurfaceTarget& target, vtkSurfaceTarget* nearest);
  void DrawSums(vtkOpenGLRenderWindow* window, const Points& points,
    const vtkPointSurfaceView& view, const vtkPointProjectionOptions& options);
  void Average(vtkOpenGLRenderWindow* window, const vtkPointSurfaceView& view,
    const vtkPointProjectionOptions& options, vtkSurfaceTarget& target);
  vtkShaderProgram* ReadyProgram(vtkOpenGLRenderWindow* window, Pass& pass,
    const std::string& fragmentShader, const Points& points, const vtkPointSurfaceView& view,
    const vtkPointProjectionOptions& options);
  vtkIdType DrawRanges(Pass& pass, const vtkPointSurfaceView& view);
  void BindAttributes(Pass& pass, vtkShaderProgram* program, const Points& points);
  void SetUniforms(vtkShaderProgram* program, const Points& points, const vtkPointSurfaceView& view,
    const vtkPointProjectionOptions& options);

  vtkNew<vtkOpenGLIndexBufferObject> Ids;
  vtkMTimeType IdsTime = 0;
  Pass FirstPass;
  Pass SumPass;
  vtkSurfaceTarget Nearest; // where points are averaged, and their sums
  vtkSurfaceTarget Sums;
  std::map<std::vector<vtkSurfaceTarget::Layer>, std::unique_ptr<vtkScreenPass>> AveragePasses;
};

#endif
