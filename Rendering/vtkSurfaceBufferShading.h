// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceBufferShading
 * @brief   makes VTK's fragment template shade a surface buffer
 *
 * VTK's polydata template, after all of VTK's replacements and those of render passes and users,
 * reads varyings that its vertex shader would have written. Here one screen-filling primitive is
 * drawn instead: each varying becomes a global variable, set from the surface buffer at the top of
 * main(), and the fragment's depth comes from there too. Prepare() goes before VTK's replacements,
 * Finish() after them.
 */
#ifndef vtkSurfaceBufferShading_h
#define vtkSurfaceBufferShading_h

#include "vtkSurfaceTarget.h"

#include <string>
#include <vector>

namespace vtkSurfaceBufferShading
{
/**
 * Adds the declarations for a surface buffer with these layers, a marker for the fetch, and the
 * discard of empty pixels. With `duplicates`, which takes the layer Id, pixels of points that other
 * processes have too lie somewhat farther away (vtkDuplicatePoints).
 */
void Prepare(
  std::string& fragmentShader, const std::vector<vtkSurfaceTarget::Layer>& layers, bool duplicates);

/**
 * Turns varyings into globals, sets them at the marker, and writes the depth if nobody does.
 */
void Finish(std::string& fragmentShader);

/**
 * Lets the vertex shader hand the fragment shader's uniforms on to it, as flat varyings that take
 * so many vectors at most: software looks a uniform up at every pixel anew, a flat varying hardly
 * ever.
 */
void HandOnUniforms(std::string& vertexShader, std::string& fragmentShader, int vectors);

/**
 * Turns the finished main() into a function psShade(), which sets psGone where it would discard the
 * fragment, and adds `main`, which calls it.
 */
void CallFromMain(std::string& fragmentShader, const std::string& main);
}

#endif
