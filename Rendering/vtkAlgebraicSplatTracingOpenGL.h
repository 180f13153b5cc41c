// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAlgebraicSplatTracingOpenGL
 * @brief   the step from splats to a surface buffer
 *
 * Splats lie in a texture buffer for each order, of 32-bit RGBA: centre and radius; normal and
 * least height; u and largest height; the id of the point, its lower and upper half, then 0, 0;
 * coefficients. Colours, where there are any, lie in a buffer of their own. Each splat is one
 * instance of a rectangle.
 */
#ifndef vtkAlgebraicSplatTracingOpenGL_h
#define vtkAlgebraicSplatTracingOpenGL_h

#include "vtkAlgebraicSplat.h"
#include "vtkPointSurfaceView.h"
#include "vtkSplatMeanOpenGL.h"
#include "vtkSurfaceTarget.h"

#include "vtkNew.h"
#include "vtkType.h"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

class vtkDrawableSplats;
class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;
struct vtkAlgebraicSplatOptions;

class vtkAlgebraicSplatTracingOpenGL
{
public:
  using ColorSource = std::function<std::array<float, 4>(unsigned int)>;

  vtkAlgebraicSplatTracingOpenGL();
  ~vtkAlgebraicSplatTracingOpenGL();

  /**
   * Texels of a buffer for this many splats, were all of the highest order.
   */
  static vtkIdType GetLargestNumberOfTexels(vtkIdType splats);

  ///@{
  /**
   * Takes the splats; the colours of their points, in a byte for each component or a float. Returns
   * the number of bytes sent.
   */
  size_t Upload(vtkOpenGLRenderWindow* window, const vtkDrawableSplats& splats);
  size_t UploadColors(vtkOpenGLRenderWindow* window, const vtkDrawableSplats& splats,
    const ColorSource& color, bool inBytes);
  ///@}

  struct Cloud
  {
    vtkAlgebraicSplatTracingOpenGL* Uploaded = nullptr; ///< what the splats were uploaded to
    const vtkDrawableSplats* Splats = nullptr;
    vtkPointSurfaceView View;     ///< those in its ranges are drawn
    vtkIdType FirstId = 0;        ///< added to the ids of the splats' points
    bool HasColors = false;       ///< that were uploaded
    std::array<float, 4> Color{}; ///< without colours
  };

  /**
   * Fills `surface` within the view's rectangle from clouds that share its eye and its clipping
   * planes.
   */
  void Run(vtkOpenGLRenderWindow* window, const std::vector<Cloud>& clouds,
    const vtkPointSurfaceView& view, const vtkAlgebraicSplatOptions& options,
    vtkSurfaceTarget& surface);

  /**
   * Passes over the splats or the image of the last run.
   */
  int GetPasses() const { return this->Passes; }

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkAlgebraicSplatTracingOpenGL(const vtkAlgebraicSplatTracingOpenGL&) = delete;
  void operator=(const vtkAlgebraicSplatTracingOpenGL&) = delete;

  struct Group
  {
    int Stride = 0; // texels a splat
    vtkNew<vtkOpenGLBufferObject> Buffer;
    vtkNew<vtkTextureObject> Texels;
    vtkNew<vtkOpenGLBufferObject> ColorBuffer;
    vtkNew<vtkTextureObject> Colors;
  };

  void DrawClouds(vtkOpenGLRenderWindow* window, const std::vector<Cloud>& clouds,
    const vtkPointSurfaceView& view, const vtkAlgebraicSplatOptions& options,
    vtkSurfaceTarget* visible, vtkSurfaceTarget& target);
  static void DrawSplats(vtkOpenGLRenderWindow* window, const Cloud& cloud,
    const vtkAlgebraicSplatOptions& options, vtkSurfaceTarget* visible, vtkSurfaceTarget& target);

  std::array<Group, vtkAlgebraicSplat::MaximumOrder> Groups;
  std::array<double, 3> Origin{};
  vtkSurfaceTarget Visible;
  vtkSurfaceTarget Sums;
  vtkSurfaceTarget Ids;
  vtkSplatMeanOpenGL Mean;
  vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
  int Passes = 0;
};

#endif
