// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSelectionBuffers.h"

#include "vtkPointBlocks.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkHardwareSelector.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnsignedIntArray.h"

#include <functional>
#include <map>

namespace
{
/// The id of a point of the cloud that was drawn at a pixel.
vtkIdType ReadPoint(vtkHardwareSelector* selector, unsigned int pixel)
{
  const unsigned char* low = selector->GetRawPixelBuffer(vtkHardwareSelector::POINT_ID_LOW24);
  const unsigned char* high = selector->GetRawPixelBuffer(vtkHardwareSelector::POINT_ID_HIGH24);
  return low[pixel] | (low[pixel + 1] << 8) | (low[pixel + 2] << 16) |
    (high ? static_cast<vtkIdType>(high[pixel]) << 24 : 0);
}

void Write24Bits(unsigned char* rgb, vtkIdType value)
{
  for (int k = 0; k < 3; ++k, value >>= 8)
  {
    rgb[k] = static_cast<unsigned char>(value & 0xff);
  }
}

template <typename T>
T* GetArray(vtkFieldData* data, const char* name)
{
  return name ? T::SafeDownCast(data->GetAbstractArray(name)) : nullptr;
}

/// For each point of a block a cell that uses it: the last one, whose colour it has.
std::vector<vtkIdType> GetCellOfPoints(vtkPointSet* data)
{
  std::vector<vtkIdType> cells(data->GetNumberOfPoints());
  for (size_t i = 0; i < cells.size(); ++i)
  {
    cells[i] = static_cast<vtkIdType>(i); // a point without a cell stands for one
  }
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, points);
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      cells[points->GetId(i)] = cell;
    }
  }
  return cells;
}
}

void vtkPointSelectionBuffers::Process(vtkHardwareSelector* selector,
  const std::vector<unsigned int>& pixels, const vtkPointBlocks& blocks) const
{
  const int pass = selector->GetCurrentPass();
  if (!selector->GetRawPixelBuffer(vtkHardwareSelector::POINT_ID_LOW24) ||
    !selector->GetPixelBuffer(pass))
  {
    return; // this pass comes once more, when points are known
  }
  auto rewrite = [&](const std::function<vtkIdType(const vtkPointBlock&, vtkIdType)>& getId)
  {
    const bool high =
      pass == vtkHardwareSelector::POINT_ID_HIGH24 || pass == vtkHardwareSelector::CELL_ID_HIGH24;
    for (unsigned int pixel : pixels)
    {
      const vtkIdType point = ReadPoint(selector, pixel);
      const vtkPointBlock& block = blocks.GetBlockOf(point);
      const vtkIdType id = getId(block, point - block.First);
      Write24Bits(selector->GetPixelBuffer(pass) + pixel, high ? id >> 24 : id);
    }
  };
  std::map<unsigned int, std::vector<vtkIdType>> cellsOfBlocks;
  auto getCell = [&](const vtkPointBlock& block, vtkIdType point)
  {
    std::vector<vtkIdType>& cells = cellsOfBlocks[block.FlatIndex];
    cells = cells.empty() ? GetCellOfPoints(block.Data) : cells;
    return cells[point];
  };

  switch (pass)
  {
    case vtkHardwareSelector::POINT_ID_LOW24:
    case vtkHardwareSelector::POINT_ID_HIGH24:
      rewrite(
        [this](const vtkPointBlock& block, vtkIdType point)
        {
          auto* ids = GetArray<vtkIdTypeArray>(block.Data->GetPointData(), this->PointIds);
          return ids ? ids->GetValue(point) : point;
        });
      break;
    case vtkHardwareSelector::CELL_ID_LOW24:
    case vtkHardwareSelector::CELL_ID_HIGH24:
      rewrite(
        [&](const vtkPointBlock& block, vtkIdType point)
        {
          auto* ids = GetArray<vtkIdTypeArray>(block.Data->GetCellData(), this->CellIds);
          const vtkIdType cell = getCell(block, point);
          return ids && cell < ids->GetNumberOfTuples() ? ids->GetValue(cell) : cell;
        });
      break;
    case vtkHardwareSelector::COMPOSITE_INDEX_PASS:
      rewrite(
        [&](const vtkPointBlock& block, vtkIdType point)
        {
          auto* ids = GetArray<vtkUnsignedIntArray>(block.Data->GetCellData(), this->CompositeIds);
          const vtkIdType cell = ids ? getCell(block, point) : 0;
          return ids && cell < ids->GetNumberOfTuples()
            ? static_cast<vtkIdType>(ids->GetValue(cell))
            : blocks.IsComposite() ? static_cast<vtkIdType>(block.FlatIndex)
                                   : 1; // as VTK has it for one data set
        });
      break;
    case vtkHardwareSelector::PROCESS_PASS:
      if (selector->GetUseProcessIdFromData())
      {
        rewrite(
          [&](const vtkPointBlock& block, vtkIdType point)
          {
            auto* ids = GetArray<vtkUnsignedIntArray>(block.Data->GetPointData(), this->ProcessIds);
            // 0 is for no process
            return 1 +
              (ids ? static_cast<vtkIdType>(ids->GetValue(point)) : selector->GetProcessID());
          });
      }
      break;
    default:
      break;
  }
}
