// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointBlocks.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeRange.h"
#include "vtkDataSetAttributes.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <sstream>

vtkPointBlocks::vtkPointBlocks()
  : Cloud(vtkSmartPointer<vtkPolyData>::New())
{
}

vtkPointBlocks::~vtkPointBlocks() = default;

vtkPolyData* vtkPointBlocks::GetCloud() const
{
  return this->Cloud;
}

void vtkPointBlocks::Update(vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes,
  bool normals, const std::vector<std::string>& arrays)
{
  this->Composite = input && !vtkPointSet::SafeDownCast(input);
  this->Blocks.clear();
  this->Skipped.clear();
  unsigned int flatIndex = 0;
  if (input)
  {
    this->Visit(input, attributes, vtkPointBlock(), flatIndex);
  }

  Source source;
  source.Arrays = arrays;
  source.Data.emplace_back(input, input ? input->GetMTime() : 0);
  for (const vtkPointBlock& block : this->Blocks)
  {
    source.Data.emplace_back(block.Data, block.Data->GetMTime());
  }
  if (!(source == this->CloudSource))
  {
    this->CloudSource = source;
    this->MakeCloud(input, normals, arrays);
  }
}

void vtkPointBlocks::Visit(vtkDataObject* object, vtkCompositeDataDisplayAttributes* attributes,
  vtkPointBlock inherited, unsigned int& flatIndex)
{
  if (attributes)
  {
    if (attributes->HasBlockVisibility(object))
    {
      inherited.Visible = attributes->GetBlockVisibility(object);
    }
    if (attributes->HasBlockPickability(object))
    {
      inherited.Pickable = attributes->GetBlockPickability(object);
    }
    if (attributes->HasBlockOpacity(object))
    {
      inherited.HasOpacity = true;
      inherited.Opacity = attributes->GetBlockOpacity(object);
    }
    if (attributes->HasBlockColor(object))
    {
      inherited.HasColor = true;
      attributes->GetBlockColor(object, inherited.Color.data());
    }
  }

  inherited.FlatIndex = flatIndex++;
  if (auto* tree = vtkDataObjectTree::SafeDownCast(object))
  {
    for (vtkDataObject* child : vtk::Range(tree, vtk::DataObjectTreeOptions::None))
    {
      child ? this->Visit(child, attributes, inherited, flatIndex) : void(++flatIndex);
    }
    return;
  }
  auto* data = vtkPointSet::SafeDownCast(object);
  if (!data)
  {
    std::ostringstream line;
    line << "Block " << inherited.FlatIndex << " is a " << object->GetClassName()
         << ", which is no vtkPointSet; it is not drawn.";
    this->Skipped.push_back(line.str());
    return;
  }
  inherited.Data = data;
  inherited.Count = data->GetNumberOfPoints();
  if (inherited.Count > 0)
  {
    inherited.First =
      this->Blocks.empty() ? 0 : this->Blocks.back().First + this->Blocks.back().Count;
    this->Blocks.push_back(inherited);
  }
}

//------------------------------------------------------------------------------
void vtkPointBlocks::MakeCloud(
  vtkDataObject* input, bool normals, const std::vector<std::string>& arrays)
{
  this->Remarks = this->Skipped;
  if (this->Blocks.size() < 2)
  {
    this->Arrays.clear();
  }
  if (auto* cloud = vtkPolyData::SafeDownCast(input))
  {
    this->Cloud = cloud;
    return;
  }
  this->Cloud = vtkSmartPointer<vtkPolyData>::New();
  if (this->Blocks.empty())
  {
    this->Cloud->SetPoints(vtkNew<vtkPoints>());
    return;
  }
  if (this->Blocks.size() == 1)
  {
    this->Cloud->SetPoints(this->Blocks[0].Data->GetPoints());
    this->Cloud->GetPointData()->ShallowCopy(this->Blocks[0].Data->GetPointData());
    return;
  }

  std::vector<vtkDataArray*> coordinates;
  for (const vtkPointBlock& block : this->Blocks)
  {
    coordinates.push_back(block.Data->GetPoints()->GetData());
  }
  this->Points->SetData(this->Arrays["(coordinates)"].Join(coordinates));
  this->Cloud->SetPoints(this->Points);
  if (normals)
  {
    this->JoinAttribute(vtkDataSetAttributes::NORMALS, "normals");
  }
  this->JoinAttribute(vtkDataSetAttributes::TCOORDS, "texture coordinates");
  for (const std::string& name : arrays)
  {
    this->Cloud->GetPointData()->AddArray(this->JoinNamed(name));
  }
  this->Cloud->GetPointData()->AddArray(this->JoinNamed(vtkDataSetAttributes::GhostArrayName()));
}

void vtkPointBlocks::JoinAttribute(int attribute, const char* what)
{
  std::vector<vtkDataArray*> parts;
  unsigned int without = 0;
  for (const vtkPointBlock& block : this->Blocks)
  {
    vtkDataArray* part = block.Data->GetPointData()->GetAttribute(attribute);
    const bool fits = part && part->GetNumberOfTuples() == block.Count;
    fits ? parts.push_back(part) : void(without = block.FlatIndex);
  }
  if (parts.size() == this->Blocks.size())
  {
    this->Cloud->GetPointData()->SetAttribute(
      this->Arrays[std::string("(") + what + ")"].Join(parts), attribute);
  }
  else if (!parts.empty())
  {
    std::ostringstream line;
    line << "Block " << without << " has no " << what
         << " for its points, others have; those of all blocks are left out. Give all blocks "
         << what << ", or none.";
    this->Remarks.push_back(line.str());
  }
}

vtkDataArray* vtkPointBlocks::JoinNamed(const std::string& name)
{
  std::vector<vtkDataArray*> parts;
  unsigned int without = 0;
  for (const vtkPointBlock& block : this->Blocks)
  {
    vtkDataArray* part = block.Data->GetPointData()->GetArray(name.c_str());
    const bool fits = part && part->GetNumberOfTuples() == block.Count &&
      (parts.empty() || part->GetNumberOfComponents() == parts[0]->GetNumberOfComponents());
    fits ? parts.push_back(part) : void(without = block.FlatIndex);
  }
  if (parts.size() == this->Blocks.size())
  {
    vtkDataArray* joined = this->Arrays[name].Join(parts);
    joined->SetName(name.c_str());
    return joined;
  }
  if (!parts.empty())
  {
    std::ostringstream line;
    line << "Block " << without << " has no point array '" << name
         << "' with a value for each point, others have; it is left out of all blocks. Give it to "
            "all blocks.";
    this->Remarks.push_back(line.str());
  }
  return nullptr;
}

vtkDataArray* vtkPointBlocks::JoinedArray::Join(const std::vector<vtkDataArray*>& parts)
{
  std::vector<std::pair<vtkDataArray*, vtkMTimeType>> now;
  int type = parts[0]->GetDataType();
  vtkIdType count = 0;
  for (vtkDataArray* part : parts)
  {
    now.emplace_back(part, part->GetMTime());
    type = part->GetDataType() == type ? type : VTK_DOUBLE;
    count += part->GetNumberOfTuples();
  }
  if (this->Array && now == this->Parts)
  {
    return this->Array;
  }
  this->Parts = now;
  this->Array.TakeReference(vtkDataArray::CreateDataArray(type));
  this->Array->SetName(parts[0]->GetName());
  this->Array->SetNumberOfComponents(parts[0]->GetNumberOfComponents());
  this->Array->SetNumberOfTuples(count);
  vtkIdType first = 0;
  for (vtkDataArray* part : parts)
  {
    this->Array->InsertTuples(first, part->GetNumberOfTuples(), 0, part);
    first += part->GetNumberOfTuples();
  }
  return this->Array;
}

//------------------------------------------------------------------------------
const vtkPointBlock& vtkPointBlocks::GetBlockOf(vtkIdType point) const
{
  return *(std::upper_bound(this->Blocks.begin(), this->Blocks.end(), point,
             [](vtkIdType id, const vtkPointBlock& block) { return id < block.First; }) -
    1);
}

std::vector<vtkPointBlocks::Range> vtkPointBlocks::GetRanges(
  const std::vector<const vtkPointBlock*>& blocks, const std::vector<unsigned int>& ids)
{
  auto position = [&ids](vtkIdType id)
  {
    return ids.empty()
      ? id
      : static_cast<vtkIdType>(
          std::lower_bound(ids.begin(), ids.end(), static_cast<unsigned int>(id)) - ids.begin());
  };
  std::vector<Range> ranges;
  for (const vtkPointBlock* block : blocks)
  {
    const Range range = { position(block->First), position(block->First + block->Count) };
    if (!ranges.empty() && ranges.back()[1] == range[0])
    {
      ranges.back()[1] = range[1];
    }
    else if (range[0] < range[1])
    {
      ranges.push_back(range);
    }
  }
  return ranges;
}

void vtkPointBlocks::AddBounds(const vtkPointBlock& block, double bounds[6])
{
  // one component at a time, what is not finite left out
  for (int k = 0; k < 3; ++k)
  {
    double range[2];
    block.Data->GetPoints()->GetData()->GetFiniteRange(range, k);
    if (range[0] <= range[1])
    {
      const bool first = bounds[2 * k] > bounds[2 * k + 1];
      bounds[2 * k] = first ? range[0] : std::min(bounds[2 * k], range[0]);
      bounds[2 * k + 1] = first ? range[1] : std::max(bounds[2 * k + 1], range[1]);
    }
  }
}
