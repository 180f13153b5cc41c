// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceStepOpenGL
 * @brief   a step that is one fragment shader from one target to another
 *
 * The shader reads the layers of its input by samplers named "inSurface", "inColor", ... and writes
 * those of its output; a program is made for each combination of layers that it meets.
 */
#ifndef vtkSurfaceStepOpenGL_h
#define vtkSurfaceStepOpenGL_h

#include "vtkSurfaceTarget.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkScreenPass;
class vtkShaderProgram;

class vtkSurfaceStepOpenGL
{
public:
  explicit vtkSurfaceStepOpenGL(const std::string& fragmentShader);
  ~vtkSurfaceStepOpenGL();

  /**
   * Runs the shader over `rectangle` (x, y, x end, y end) of `output`; `setUniforms` gets the
   * program when it is current. The uniforms "begin" and "end" are the rectangle's.
   */
  void Run(vtkOpenGLRenderWindow* window, vtkSurfaceTarget& input, vtkSurfaceTarget& output,
    const std::array<int, 4>& rectangle, const std::function<void(vtkShaderProgram*)>& setUniforms);

  void ReleaseGraphicsResources();

private:
  using Layers = std::vector<vtkSurfaceTarget::Layer>;

  std::string FragmentShader;
  std::map<std::pair<Layers, Layers>, std::unique_ptr<vtkScreenPass>> Passes;
};

#endif
