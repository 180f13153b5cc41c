// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceTarget
 * @brief   the layers of an image that a step writes in one go and the next step reads
 *
 * A set of textures of one size (normals, depths, colours, ids: see Layer) and the framebuffer
 * to write them. Every step takes and returns such targets; shaders name the layers by the macros
 * and samplers that GetOutputDeclarations() and GetInputDeclarations() write.
 */
#ifndef vtkSurfaceTarget_h
#define vtkSurfaceTarget_h

#include "vtkNew.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;
struct vtkSurfacePixels;

class vtkSurfaceTarget
{
public:
  enum Layer
  {
    Shape,    ///< xyz: eye-space normal; w: radius in eye units, 0 where the pixel is invalid
    Interval, ///< x, y: least and largest eye depth; zw: displacement of the ellipse's centre
    Surface,  ///< xyz: eye-space normal; w: eye depth, 0 where there is no surface
    Id,       ///< point id + 1 (an unsigned integer), 0 where there is none
    Color,    ///< RGBA, or texture coordinates in xy
    Nearness, ///< x, y: 1 / depth of the nearest front and back of a surface, 0 where there is none
    Sum,      ///< xyz: weighted sum of normals; w: of depths, or the number of points with a Change
    Weight,   ///< x: sum of weights
    Change,   ///< sums of what points differ by in depth (x), radius (y), and centre (zw)
    NumberOfLayers
  };

  vtkSurfaceTarget();
  ~vtkSurfaceTarget();

  /**
   * Makes the target `width` x `height` with these layers, and a depth buffer if asked. Does
   * nothing when it is so already.
   */
  void Allocate(vtkOpenGLRenderWindow* window, int width, int height,
    const std::vector<Layer>& layers, bool depthBuffer = false);
  void ReleaseGraphicsResources(vtkWindow* window);

  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  const std::vector<Layer>& GetLayers() const { return this->Layers; }
  bool Has(Layer layer) const;

  /**
   * Lets the target have the depth buffer of another one, of the same size, in place of its own.
   */
  void ShareDepthBuffer(vtkOpenGLRenderWindow* window, vtkSurfaceTarget& owner);

  ///@{
  /**
   * Binds the framebuffer for writing all layers, or only `layers`, the first ones of them, with
   * the viewport over all of it.
   */
  void BindForWriting(vtkOpenGLRenderWindow* window);
  void BindForWriting(vtkOpenGLRenderWindow* window, const std::vector<Layer>& layers);
  ///@}

  /**
   * Sets the layers that are bound for writing to 0 and the depth buffer to `depth`, within
   * `rectangle` (x, y, width, height) at least, to which drawing is confined from then on.
   */
  void Clear(
    vtkOpenGLRenderWindow* window, const std::array<int, 4>& rectangle, float depth = 1.0f);

  ///@{
  /**
   * Binds the layers to texture units, and tells a program by the names of
   * GetInputDeclarations(prefix).
   */
  void Activate();
  void SetSamplers(vtkShaderProgram* program, const std::string& prefix);
  void Deactivate();
  ///@}

  /**
   * GLSL: a sampler for each layer, named prefix + "Shape", "Interval", ...; and a macro
   * HAS_ID or HAS_COLOR where the target has these layers.
   */
  static std::string GetInputDeclarations(
    const std::vector<Layer>& layers, const std::string& prefix);

  /**
   * GLSL: a fragment output for each layer, by the macros OUT_SHAPE, OUT_INTERVAL, OUT_SURFACE,
   * OUT_ID, OUT_COLOR. WRITE_ID(value) and WRITE_COLOR(value) do nothing where there is no such
   * layer.
   */
  static std::string GetOutputDeclarations(const std::vector<Layer>& layers);

  /**
   * Copies rectangles (x, y, x end, y end) of pixels to the layers Surface, and Id and Color where
   * the target has them. Returns how many bytes that are.
   */
  size_t Upload(vtkOpenGLRenderWindow* window, const vtkSurfacePixels& pixels,
    const std::vector<std::array<int, 4>>& rectangles);

  /**
   * Copies `rectangle` (x, y, x end, y end) of a layer: four floats or an id a pixel, rows of which
   * are `stride` pixels apart. Returns how many bytes that are.
   */
  size_t Upload(vtkOpenGLRenderWindow* window, Layer layer, const std::array<int, 4>& rectangle,
    const void* values, int stride);

  ///@{
  /**
   * Copies a layer to memory, from the lower left pixel on: four floats or one id + 1 a pixel, 0
   * outside of the rectangles (x, y, width, height), where steps leave what was there before.
   */
  std::vector<float> ReadFloats(
    vtkOpenGLRenderWindow* window, Layer layer, const std::vector<std::array<int, 4>>& rectangles);
  std::vector<unsigned int> ReadIds(
    vtkOpenGLRenderWindow* window, const std::vector<std::array<int, 4>>& rectangles);
  ///@}

private:
  vtkSurfaceTarget(const vtkSurfaceTarget&) = delete;
  void operator=(const vtkSurfaceTarget&) = delete;

  vtkTextureObject* GetTexture(Layer layer) const { return this->Textures[layer]; }
  void Read(
    vtkOpenGLRenderWindow* window, Layer layer, const std::array<int, 4>& rectangle, void* pixels);

  int Width = 0;
  int Height = 0;
  std::vector<Layer> Layers;
  std::vector<Layer> WrittenLayers; // by BindForWriting()
  vtkNew<vtkTextureObject> Textures[NumberOfLayers];
  vtkNew<vtkTextureObject> DepthBuffer;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
};

#endif
