// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDuplicatePoints
 * @brief   tells shaders which points are copies of those of another process
 *
 * A buffer texture with a byte a point, four a texel: 1.0 for a copy, else 0.0.
 */
#ifndef vtkDuplicatePoints_h
#define vtkDuplicatePoints_h

#include "vtkNew.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;
class vtkWindow;

class vtkDuplicatePoints
{
public:
  vtkDuplicatePoints();
  ~vtkDuplicatePoints();

  /**
   * What the current context lacks to hold so many points; see vtkContextNeeds.
   */
  static std::string FindLack(size_t points);

  /**
   * Binds the texture of these bytes (255 for a copy), made anew where `time` is not that of the
   * last call.
   */
  void Activate(
    vtkOpenGLRenderWindow* window, const std::vector<unsigned char>& points, vtkMTimeType time);
  void SetSampler(vtkShaderProgram* program, const char* name);
  void Deactivate();
  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkDuplicatePoints(const vtkDuplicatePoints&) = delete;
  void operator=(const vtkDuplicatePoints&) = delete;

  vtkNew<vtkOpenGLBufferObject> Buffer;
  vtkNew<vtkTextureObject> Texels;
  vtkMTimeType Time = 0;
};

#endif
