// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointBlockDisplay
 * @brief   which blocks of a mapper's input are drawn together, and in which colours
 *
 * As vtkCompositePolyDataMapper2 does it: a block has an opacity and a colour of its own, or those
 * of the nearest group above it, or the property's; opaque blocks are drawn in VTK's opaque pass,
 * the others in its translucent pass, pickable ones for selection.
 */
#ifndef vtkPointBlockDisplay_h
#define vtkPointBlockDisplay_h

#include "vtkCompositePointMapper.h" // for vtkPointBlockGroup
#include "vtkPointBlocks.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <vector>

class vtkActor;
class vtkMapper;
class vtkProperty;
class vtkRenderer;
class vtkUnsignedCharArray;

class vtkPointBlockDisplay
{
public:
  /**
   * Whether a block is translucent whatever the property says: by its opacity or its scalars.
   */
  static bool IsTranslucent(const vtkPointBlock& block, vtkMapper* mapper);

  /**
   * The blocks to draw in VTK's current pass; those of one group are reconstructed together.
   */
  static std::vector<vtkPointBlockGroup> GetGroups(
    const vtkPointBlocks& blocks, vtkMapper* mapper, vtkRenderer* renderer, vtkActor* actor);

  /**
   * Whether points need colours that are joined from those of blocks, not one array.
   */
  static bool NeedsJoinedColors(const vtkPointBlocks& blocks);

  /**
   * Whether the colours' alpha is all of the opacity, and the property's is not to be used.
   */
  static bool HasOpacities(const vtkPointBlocks& blocks);

  /**
   * RGBA of each point of the cloud, or nullptr if all blocks have the property's colour.
   * `getColors` returns the colours of a block's points by its scalars, or nullptr; `missing`, if
   * not null, is the RGB of blocks that have none.
   */
  vtkUnsignedCharArray* JoinColors(const vtkPointBlocks& blocks, vtkProperty* property,
    const double* missing,
    const std::function<vtkUnsignedCharArray*(const vtkPointBlock&)>& getColors);

private:
  vtkSmartPointer<vtkUnsignedCharArray> Colors;
};

#endif
