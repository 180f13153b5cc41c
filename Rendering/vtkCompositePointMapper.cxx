// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCompositePointMapper.h"

#include "vtkKeptArray.h"
#include "vtkPointBlockDisplay.h"
#include "vtkPointBlocks.h"
#include "vtkPointCloudPipeline.h"
#include "vtkPointSelectionBuffers.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkColorTransferFunction.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkFloatArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkOpenGLHelper.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <set>

class vtkCompositePointMapper::vtkInternals
{
public:
  vtkPointBlocks Blocks;
  vtkSmartPointer<vtkCompositeDataDisplayAttributes> Attributes;
  vtkPointBlockDisplay Display;
  vtkDataSet* Mapped = nullptr;                      // whose colours VTK has; only compared
  vtkSmartPointer<vtkUnsignedCharArray> PointColors; // made from colours of cells
  vtkKeptArray Colors;
  vtkKeptArray ColorCoordinates;
  std::set<std::string> Warnings; // that have been given
};

vtkCompositePointMapper::vtkCompositePointMapper()
  : Internals(new vtkInternals)
{
}

vtkCompositePointMapper::~vtkCompositePointMapper() = default;

//------------------------------------------------------------------------------
vtkExecutive* vtkCompositePointMapper::CreateDefaultExecutive()
{
  return vtkPointCloudPipeline::New();
}

int vtkCompositePointMapper::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

void vtkCompositePointMapper::RenderPiece(vtkRenderer* renderer, vtkActor* actor)
{
  if (!this->GetInputDataObject(0, 0))
  {
    this->Superclass::RenderPiece(renderer, actor); // says so
    return;
  }
  if (!this->Static)
  {
    this->GetInputAlgorithm()->Update();
  }
  this->UpdateBlocks();
  auto* pipeline = static_cast<vtkPointCloudPipeline*>(this->GetExecutive());
  pipeline->SetStandIn(this->GetBlocks().GetCloud());
  this->Superclass::RenderPiece(renderer, actor);
  pipeline->SetStandIn(nullptr);
}

void vtkCompositePointMapper::UpdateCameraShiftScale(vtkRenderer* renderer, vtkActor* actor)
{
  // the first virtual function after VTK has taken the input
  static_cast<vtkPointCloudPipeline*>(this->GetExecutive())->SetStandIn(nullptr);
  this->Superclass::UpdateCameraShiftScale(renderer, actor);
}

void vtkCompositePointMapper::ComputeBounds()
{
  this->UpdateBlocks();
  vtkMath::UninitializeBounds(this->Bounds);
  for (const vtkPointBlock& block : this->GetBlocks().GetBlocks())
  {
    if (block.Visible)
    {
      vtkPointBlocks::AddBounds(block, this->Bounds);
    }
  }
}

//------------------------------------------------------------------------------
const vtkPointBlocks& vtkCompositePointMapper::GetBlocks() const
{
  return this->Internals->Blocks;
}

void vtkCompositePointMapper::UpdateBlocks()
{
  std::vector<std::string> names;
  this->AddArrayNames(names);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  this->Internals->Blocks.Update(
    this->GetInputDataObject(0, 0), this->Internals->Attributes, this->NeedsNormals(), names);
}

std::vector<vtkPointBlockGroup> vtkCompositePointMapper::GetBlockGroups(
  vtkRenderer* renderer, vtkActor* actor)
{
  return vtkPointBlockDisplay::GetGroups(this->GetBlocks(), this, renderer, actor);
}

bool vtkCompositePointMapper::HasTranslucentPolygonalGeometry()
{
  this->UpdateBlocks();
  const std::vector<vtkPointBlock>& blocks = this->GetBlocks().GetBlocks();
  return std::any_of(blocks.begin(), blocks.end(),
    [this](const vtkPointBlock& block)
    { return block.Visible && vtkPointBlockDisplay::IsTranslucent(block, this); });
}

bool vtkCompositePointMapper::HasOpaqueGeometry()
{
  this->UpdateBlocks();
  return this->GetBlocks().IsComposite() || !this->HasTranslucentPolygonalGeometry();
}

//------------------------------------------------------------------------------
int vtkCompositePointMapper::CanUseTextureMapForColoring(vtkDataObject* input)
{
  return vtkPointBlockDisplay::NeedsJoinedColors(this->GetBlocks())
    ? 0
    : this->Superclass::CanUseTextureMapForColoring(input);
}

namespace
{
/// The RGB of a table for values that are not numbers; nullptr if it has none.
const double* GetNanColor(vtkScalarsToColors* table)
{
  auto* lookup = vtkLookupTable::SafeDownCast(table);
  auto* function = vtkColorTransferFunction::SafeDownCast(table);
  return lookup ? lookup->GetNanColor() : function ? function->GetNanColor() : nullptr;
}
}

vtkDataArray* vtkCompositePointMapper::GetPointColors(vtkActor* actor)
{
  vtkInternals& internals = *this->Internals;
  if (!vtkPointBlockDisplay::NeedsJoinedColors(internals.Blocks))
  {
    const std::vector<vtkPointBlock>& blocks = internals.Blocks.GetBlocks();
    return internals.Colors.Keep(blocks.empty() ? nullptr : this->MapPointColors(blocks[0].Data));
  }
  const double* missing = this->ScalarVisibility && this->ColorMissingArraysWithNanColor
    ? GetNanColor(this->GetLookupTable())
    : nullptr;
  return internals.Colors.Keep(internals.Display.JoinColors(internals.Blocks, actor->GetProperty(),
    missing, [this](const vtkPointBlock& block) { return this->MapPointColors(block.Data); }));
}

vtkDataArray* vtkCompositePointMapper::GetPointColorCoordinates()
{
  return this->Internals->ColorCoordinates.Keep(this->ColorCoordinates);
}

void vtkCompositePointMapper::WarnOnce(const std::string& text)
{
  if (this->Internals->Warnings.insert(text).second)
  {
    vtkWarningMacro(<< text);
  }
}

void vtkCompositePointMapper::ForgetWarnings()
{
  this->Internals->Warnings.clear();
}

vtkUnsignedCharArray* vtkCompositePointMapper::MapPointColors(vtkDataSet* input)
{
  if (this->Colors && input != this->Internals->Mapped)
  {
    // VTK takes the colours of other data for those of this
    this->Colors->UnRegister(this);
    this->Colors = nullptr;
  }
  this->Internals->Mapped = input;
  int ofCells = 0;
  vtkUnsignedCharArray* colors = this->MapScalars(input, 1.0, ofCells);
  if (!colors || !ofCells)
  {
    return colors;
  }
  vtkNew<vtkUnsignedCharArray> ofPoints;
  ofPoints->SetNumberOfComponents(colors->GetNumberOfComponents());
  ofPoints->SetNumberOfTuples(input->GetNumberOfPoints());
  ofPoints->Fill(255);
  this->Internals->PointColors = ofPoints;
  const vtkIdType tuple = this->FieldDataTupleId;
  if (this->ScalarMode == VTK_SCALAR_MODE_USE_FIELD_DATA && tuple >= 0)
  {
    // one colour for all, as VTK does it
    if (tuple >= colors->GetNumberOfTuples())
    {
      this->WarnOnce("FieldDataTupleId is " + std::to_string(tuple) +
        ", but the array of field data has only " + std::to_string(colors->GetNumberOfTuples()) +
        " tuples; it is not used.");
      return nullptr;
    }
    for (vtkIdType id = 0; id < input->GetNumberOfPoints(); ++id)
    {
      ofPoints->SetTuple(id, tuple, colors);
    }
    return ofPoints;
  }
  // A point has the colour of the last cell that uses it.
  const vtkIdType count = std::min(input->GetNumberOfCells(), colors->GetNumberOfTuples());
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < count; ++cell)
  {
    input->GetCellPoints(cell, ids);
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      ofPoints->SetTuple(ids->GetId(i), cell, colors);
    }
  }
  return ofPoints;
}

void vtkCompositePointMapper::SetPropertyShaderParameters(
  vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetPropertyShaderParameters(helper, renderer, actor);
  if (vtkPointBlockDisplay::HasOpacities(this->GetBlocks()))
  {
    helper.Program->SetUniformf("opacityUniform", 1.0f); // all of it is in the colours
  }
}

//------------------------------------------------------------------------------
void vtkCompositePointMapper::UpdateMaximumPointCellIds(vtkRenderer* renderer, vtkActor*)
{
  // of what is drawn, which is ids of the cloud, and of what is told
  vtkIdType point = this->GetBlocks().GetCloud()->GetNumberOfPoints() - 1;
  vtkIdType cell = point;
  for (const vtkPointBlock& block : this->GetBlocks().GetBlocks())
  {
    auto addIds = [](vtkDataArray* ids, vtkIdType& largest)
    { largest = ids ? std::max(largest, static_cast<vtkIdType>(ids->GetRange()[1])) : largest; };
    addIds(block.Data->GetPointData()->GetArray(this->PointIdArrayName), point);
    addIds(block.Data->GetCellData()->GetArray(this->CellIdArrayName), cell);
    cell = std::max(cell, block.Data->GetNumberOfCells() - 1);
  }
  renderer->GetSelector()->UpdateMaximumPointId(point);
  renderer->GetSelector()->UpdateMaximumCellId(cell);
}

void vtkCompositePointMapper::ProcessSelectorPixelBuffers(
  vtkHardwareSelector* selector, std::vector<unsigned int>& pixelOffsets, vtkProp*)
{
  if (this->PopulateSelectionSettings)
  {
    vtkPointSelectionBuffers buffers;
    buffers.PointIds = this->PointIdArrayName;
    buffers.ProcessIds = this->ProcessIdArrayName;
    buffers.CellIds = this->CellIdArrayName;
    buffers.CompositeIds = this->CompositeIdArrayName;
    buffers.Process(selector, pixelOffsets, this->GetBlocks());
  }
}

//------------------------------------------------------------------------------
vtkMTimeType vtkCompositePointMapper::GetMTime()
{
  const auto& attributes = this->Internals->Attributes;
  return std::max(this->Superclass::GetMTime(), attributes ? attributes->GetMTime() : 0);
}

void vtkCompositePointMapper::SetCompositeDataDisplayAttributes(
  vtkCompositeDataDisplayAttributes* attributes)
{
  if (this->Internals->Attributes != attributes)
  {
    this->Internals->Attributes = attributes;
    this->Modified();
  }
}

vtkCompositeDataDisplayAttributes* vtkCompositePointMapper::GetCompositeDataDisplayAttributes()
{
  return this->Internals->Attributes;
}

vtkCompositeDataDisplayAttributes* vtkCompositePointMapper::ModifyAttributes()
{
  if (!this->Internals->Attributes)
  {
    this->Internals->Attributes = vtkSmartPointer<vtkCompositeDataDisplayAttributes>::New();
  }
  this->Modified(); // not all of their methods say that they change them
  return this->Internals->Attributes;
}

vtkDataObject* vtkCompositePointMapper::GetNode(unsigned int index)
{
  vtkDataObject* input = this->GetInputDataObject(0, 0);
  vtkDataObject* node =
    input ? vtkCompositeDataDisplayAttributes::DataObjectFromIndex(index, input) : nullptr;
  if (!node)
  {
    vtkErrorMacro("The input has no block with the flat index "
      << index << ". Set the input, and update what makes it, before its blocks.");
  }
  return node;
}

//------------------------------------------------------------------------------
void vtkCompositePointMapper::SetBlockVisibility(unsigned int index, bool visible)
{
  if (vtkDataObject* node = this->GetNode(index))
  {
    this->ModifyAttributes()->SetBlockVisibility(node, visible);
  }
}

bool vtkCompositePointMapper::GetBlockVisibility(unsigned int index)
{
  vtkDataObject* node = this->GetNode(index);
  const auto& attributes = this->Internals->Attributes;
  return node && attributes && attributes->HasBlockVisibility(node)
    ? attributes->GetBlockVisibility(node)
    : true;
}

void vtkCompositePointMapper::RemoveBlockVisibility(unsigned int index)
{
  if (vtkDataObject* node = this->GetNode(index))
  {
    this->ModifyAttributes()->RemoveBlockVisibility(node);
  }
}

void vtkCompositePointMapper::RemoveBlockVisibilities()
{
  this->ModifyAttributes()->RemoveBlockVisibilities();
}

//------------------------------------------------------------------------------
void vtkCompositePointMapper::SetBlockPickability(unsigned int index, bool pickable)
{
  if (vtkDataObject* node = this->GetNode(index))
  {
    this->ModifyAttributes()->SetBlockPickability(node, pickable);
  }
}

bool vtkCompositePointMapper::GetBlockPickability(unsigned int index)
{
  vtkDataObject* node = this->GetNode(index);
  const auto& attributes = this->Internals->Attributes;
  return node && attributes && attributes->HasBlockPickability(node)
    ? attributes->GetBlockPickability(node)
    : true;
}

void vtkCompositePointMapper::RemoveBlockPickability(unsigned int index)
{
  if (vtkDataObject* node = this->GetNode(index))
  {
    this->ModifyAttributes()->RemoveBlockPickability(node);
  }
}

void vtkCompositePointMapper::RemoveBlockPickabilities()
{
  this->ModifyAttributes()->RemoveBlockPickabilities();
}

//------------------------------------------------------------------------------
void vtkCompositePointMapper::SetBlockOpacity(unsigned int index, double opacity)
{
  if (vtkDataObject* node = this->GetNode(index))
  {
    this->ModifyAttributes()->SetBlockOpacity(node, opacity);
  }
}

double vtkCompositePointMapper::GetBlockOpacity(unsigned int index)
{
  vtkDataObject* node = this->GetNode(index);
  const auto& attributes = this->Internals->Attributes;
  return node && attributes && attributes->HasBlockOpacity(node) ? attributes->GetBlockOpacity(node)
                                                                 : 1.0;
}

void vtkCompositePointMapper::RemoveBlockOpacity(unsigned int index)
{
  if (vtkDataObject* node = this->GetNode(index))
  {
    this->ModifyAttributes()->RemoveBlockOpacity(node);
  }
}

void vtkCompositePointMapper::RemoveBlockOpacities()
{
  this->ModifyAttributes()->RemoveBlockOpacities();
}

//------------------------------------------------------------------------------
void vtkCompositePointMapper::SetBlockColor(unsigned int index, const double color[3])
{
  if (vtkDataObject* node = this->GetNode(index))
  {
    this->ModifyAttributes()->SetBlockColor(node, color);
  }
}

void vtkCompositePointMapper::SetBlockColor(unsigned int index, double r, double g, double b)
{
  const double color[3] = { r, g, b };
  this->SetBlockColor(index, color);
}

void vtkCompositePointMapper::GetBlockColor(unsigned int index, double color[3])
{
  std::fill_n(color, 3, 1.0);
  vtkDataObject* node = this->GetNode(index);
  const auto& attributes = this->Internals->Attributes;
  if (node && attributes && attributes->HasBlockColor(node))
  {
    attributes->GetBlockColor(node, color);
  }
}

void vtkCompositePointMapper::RemoveBlockColor(unsigned int index)
{
  if (vtkDataObject* node = this->GetNode(index))
  {
    this->ModifyAttributes()->RemoveBlockColor(node);
  }
}

void vtkCompositePointMapper::RemoveBlockColors()
{
  this->ModifyAttributes()->RemoveBlockColors();
}

void vtkCompositePointMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CompositeDataDisplayAttributes: " << this->Internals->Attributes.Get() << "\n";
  os << indent << "ColorMissingArraysWithNanColor: " << this->ColorMissingArraysWithNanColor
     << "\n";
}
