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
  explicit vtkScreenPass(const std::string& fragmentShader);
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

  void ReleaseGraphicsResources();

private:
  vtkScreenPass(const vtkScreenPass&) = delete;
  void operator=(const vtkScreenPass&) = delete;

  std::string FragmentShader;
  vtkNew<vtkOpenGLVertexArrayObject> VertexArray;
};

#endif
