// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkContextNeeds
 * @brief   what the mappers and passes ask of an OpenGL context, and what of it is missing
 *
 * VTK asks for OpenGL 3.2, which promises all of this but the sizes. Not every driver keeps what it
 * promises, so it is tried, on one pixel. Each function returns what the current context lacks, in
 * words that go on after "This OpenGL context ", and nothing where it lacks nothing. State of
 * OpenGL stays as it was; errors of it are cleared.
 */
#ifndef vtkContextNeeds_h
#define vtkContextNeeds_h

#include "vtkType.h"

#include <string>

class vtkContextNeeds
{
public:
  /**
   * To shade a surface buffer, whoever has made it: textures of the layers of vtkSurfaceTarget.
   */
  static std::string FindLackOfTextures();

  /**
   * To make one by shaders: targets of such layers and of a depth, several at once.
   */
  static std::string FindLackOfTargets();

  /**
   * To draw points of a size, in pixels.
   */
  static std::string FindLackOfPointSize(int size);

  /**
   * To read a buffer of this many texels in a shader.
   */
  static std::string FindLackOfTextureBuffers(vtkIdType texels);
};

#endif
