// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointBlockDisplay.h"

#include "vtkActor.h"
#include "vtkMapper.h"
#include "vtkPointSet.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkTexture.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace
{
bool IsOpaque(const vtkPointBlock& block, vtkMapper* mapper, vtkActor* actor)
{
  const bool opaqueProperty = block.HasOpacity || actor->GetProperty()->GetOpacity() >= 1.0;
  const bool opaqueTexture = !actor->GetTexture() || !actor->GetTexture()->IsTranslucent();
  return opaqueProperty && opaqueTexture && !vtkPointBlockDisplay::IsTranslucent(block, mapper);
}

unsigned char ToByte(double value)
{
  return static_cast<unsigned char>(std::lround(255.0 * std::min(std::max(value, 0.0), 1.0)));
}

/// RGBA of a colour of one to four components, as VTK's lookup tables make them.
std::array<unsigned char, 4> GetColor(vtkUnsignedCharArray* colors, vtkIdType i)
{
  const int size = colors->GetNumberOfComponents();
  const unsigned char* c = colors->GetPointer(size * i);
  const unsigned char alpha = size % 2 == 0 ? c[size - 1] : 255;
  return size < 3 ? std::array<unsigned char, 4>{ c[0], c[0], c[0], alpha }
                  : std::array<unsigned char, 4>{ c[0], c[1], c[2], alpha };
}
}

bool vtkPointBlockDisplay::IsTranslucent(const vtkPointBlock& block, vtkMapper* mapper)
{
  if (block.HasOpacity && block.Opacity < 1.0)
  {
    return true;
  }
  if (block.HasColor || !mapper->GetScalarVisibility())
  {
    return false;
  }
  int ofCells = 0;
  vtkAbstractArray* scalars =
    vtkAbstractMapper::GetAbstractScalars(block.Data, mapper->GetScalarMode(),
      mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), ofCells);
  if (!scalars)
  {
    return false;
  }
  vtkScalarsToColors* table = mapper->GetLookupTable();
  table->Build();
  return table->IsOpaque(scalars, mapper->GetColorMode(), mapper->GetArrayComponent()) == 0;
}

std::vector<vtkPointBlockGroup> vtkPointBlockDisplay::GetGroups(
  const vtkPointBlocks& blocks, vtkMapper* mapper, vtkRenderer* renderer, vtkActor* actor)
{
  const bool selecting = renderer->GetSelector() != nullptr;
  // else VTK asks for one pass alone
  const bool split =
    !selecting && blocks.IsComposite() && !actor->GetForceOpaque() && !actor->GetForceTranslucent();
  vtkPointBlockGroup first;
  vtkPointBlockGroup translucent;
  for (const vtkPointBlock& block : blocks.GetBlocks())
  {
    if (block.Visible && (!selecting || block.Pickable))
    {
      (split && !IsOpaque(block, mapper, actor) ? translucent : first).push_back(&block);
    }
  }
  if (!split || !actor->IsRenderingTranslucentPolygonalGeometry())
  {
    return { first };
  }
  // VTK has no opaque pass for an actor with a translucent property
  return actor->HasOpaqueGeometry() ? std::vector<vtkPointBlockGroup>{ translucent }
                                    : std::vector<vtkPointBlockGroup>{ first, translucent };
}

//------------------------------------------------------------------------------
bool vtkPointBlockDisplay::NeedsJoinedColors(const vtkPointBlocks& blocks)
{
  const std::vector<vtkPointBlock>& all = blocks.GetBlocks();
  return all.size() > 1 ||
    std::any_of(all.begin(), all.end(),
      [](const vtkPointBlock& block) { return block.HasColor || block.HasOpacity; });
}

bool vtkPointBlockDisplay::HasOpacities(const vtkPointBlocks& blocks)
{
  const std::vector<vtkPointBlock>& all = blocks.GetBlocks();
  return std::any_of(
    all.begin(), all.end(), [](const vtkPointBlock& block) { return block.HasOpacity; });
}

vtkUnsignedCharArray* vtkPointBlockDisplay::JoinColors(const vtkPointBlocks& blocks,
  vtkProperty* property, const double* missing,
  const std::function<vtkUnsignedCharArray*(const vtkPointBlock&)>& getColors)
{
  const std::vector<vtkPointBlock>& all = blocks.GetBlocks();
  const bool withOpacity = HasOpacities(blocks);
  bool plain = !withOpacity && !missing;
  auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(all.empty() ? 0 : all.back().First + all.back().Count);
  for (const vtkPointBlock& block : all)
  {
    vtkUnsignedCharArray* scalars = block.HasColor ? nullptr : getColors(block);
    const bool given = scalars && scalars->GetNumberOfTuples() >= block.Count;
    plain = plain && !block.HasColor && !given;
    const double opacity = block.HasOpacity ? block.Opacity : property->GetOpacity();
    const double* one = block.HasColor ? block.Color.data()
      : missing                        ? missing
                                       : property->GetDiffuseColor();
    unsigned char* rgba = colors->GetPointer(4 * block.First);
    for (vtkIdType i = 0; i < block.Count; ++i, rgba += 4)
    {
      const std::array<unsigned char, 4> color = given
        ? GetColor(scalars, i)
        : std::array<unsigned char, 4>{ ToByte(one[0]), ToByte(one[1]), ToByte(one[2]), 255 };
      std::copy(color.begin(), color.end(), rgba);
      rgba[3] = withOpacity ? ToByte(opacity * color[3] / 255.0) : color[3];
    }
  }
  this->Colors = plain ? nullptr : colors;
  return this->Colors;
}
