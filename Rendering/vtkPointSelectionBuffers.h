// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSelectionBuffers
 * @brief   turns what selection passes drew, ids of one cloud, into ids that a user knows
 *
 * vtkHardwareSelector draws the id of a point in each pixel, in bytes of colours, and then lets the
 * mapper rewrite its pictures: here to the id within the point's block, the block's flat index, the
 * id of a cell with the point, the process of the point, or whatever an array of ids says instead.
 */
#ifndef vtkPointSelectionBuffers_h
#define vtkPointSelectionBuffers_h

#include <vector>

class vtkHardwareSelector;
class vtkPointBlocks;

class vtkPointSelectionBuffers
{
public:
  ///@{
  /**
   * Arrays of the data that hold ids (vtkIdTypeArray for points and cells, vtkUnsignedIntArray for
   * the others), as vtkOpenGLPolyDataMapper names them; nullptr for none.
   */
  const char* PointIds = nullptr;     ///< of points
  const char* ProcessIds = nullptr;   ///< of points
  const char* CellIds = nullptr;      ///< of cells
  const char* CompositeIds = nullptr; ///< of cells
  ///@}

  /**
   * Rewrites the picture of the selector's current pass at `pixels`, offsets of what the mapper has
   * drawn.
   */
  void Process(vtkHardwareSelector* selector, const std::vector<unsigned int>& pixels,
    const vtkPointBlocks& blocks) const;
};

#endif
