// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointTexture
 * @brief   an actor's texture as colours of points
 *
 * A pixel of a surface buffer has room for a colour or for texture coordinates. Where points have
 * colours, the texture is looked up at each point and multiplied onto its colour, as VTK does it
 * pixel by pixel: it is then as fine as the points are.
 */
#ifndef vtkPointTexture_h
#define vtkPointTexture_h

#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkTexture;
class vtkUnsignedCharArray;

namespace vtkPointTexture
{
/**
 * RGBA of each point: its colour, of one to four components, times what the texture has at its
 * texture coordinates, wrapped, transformed and interpolated as the texture says. There are as many
 * coordinates as colours. The texture's input is up to date; nullptr if it has none.
 */
vtkSmartPointer<vtkUnsignedCharArray> Multiply(
  vtkUnsignedCharArray* colors, vtkDataArray* coordinates, vtkTexture* texture);
}

#endif
