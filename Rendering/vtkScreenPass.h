// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkScreenPass
 * @brief   one fragment shader run over a rectangle of a target
 *
 * The program, and a primitive that fills the viewport without vertex data (vtkOpenGLQuadHelper
 * warns when a shader does not use its texture coordinates). The scissor cuts it to the rectangle.
 */
#ifndef vtkScreenPass_h
#define vtkScreenPass_h

#include "vtkNew.h"

#include <string>

class vtkOpenGLRenderWindow;
class vtkOpenGLVertexArrayObject;
class vtkShaderProgram;

class vtkScreenPass
{
public:
  /**
   * `vertexShader` is for passes that are drawn by points; by default the viewport is filled.
   */
  explicit vtkScreenPass(const std::string& fragmentShader, const std::string& vertexShader = "");
  ~vtkScreenPass();

  /**
   * Makes the program current and returns it, to set its uniforms; nullptr if it does not compile
   * (VTK's shader cache has reported why).
   */
  vtkShaderProgram* Ready(vtkOpenGLRenderWindow* window);

  /**
   * Draws over x, y, width, height in pixels of the target that is bound for writing.
   */
  void Draw(vtkOpenGLRenderWindow* window, int x, int y, int width, int height);

  /**
   * Draws `count` points, cut to x, y, width, height in the same way: the vertex shader places them
   * by their numbers.
   */
  void DrawPoints(
    vtkOpenGLRenderWindow* window, int x, int y, int width, int height, int count, float size);

  void ReleaseGraphicsResources();

private:
  vtkScreenPass(const vtkScreenPass&) = delete;
  void operator=(const vtkScreenPass&) = delete;

  void DrawPrimitives(vtkOpenGLRenderWindow* window, int x, int y, int width, int height,
    unsigned int mode, int count);

  std::string FragmentShader;
  std::string VertexShader;
  vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
};

#endif
