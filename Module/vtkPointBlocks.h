// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointBlocks
 * @brief   the input of a mapper, any vtkPointSet or a tree of them, as one cloud
 *
 * Each point set of a vtkDataObjectTree (vtkMultiBlockDataSet, vtkPartitionedDataSet,
 * vtkPartitionedDataSetCollection) is a block; its points follow those of the block before it. What
 * is shared by one vtkPolyData alone is passed on as it is; arrays of several blocks are joined
 * once, and again only when one of them changes. Not wrapped, not installed: it serves
 * vtkPointSurfaceMapper.
 */
#ifndef vtkPointBlocks_h
#define vtkPointBlocks_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

class vtkCompositeDataDisplayAttributes;
class vtkDataArray;
class vtkDataObject;
class vtkDataObjectTree;
class vtkPointSet;
class vtkPoints;
class vtkPolyData;

/**
 * A point set of the input with points, and how it is displayed: what is said of it, or of the
 * nearest group above it of which anything is said (vtkCompositeDataDisplayAttributes).
 */
struct vtkPointBlock
{
  vtkPointSet* Data = nullptr;
  unsigned int FlatIndex = 0; ///< VTK's number of the node in the tree
  vtkIdType First = 0;        ///< id in the cloud of the block's first point
  vtkIdType Count = 0;
  bool Visible = true;
  bool Pickable = true;
  bool HasOpacity = false;
  double Opacity = 1.0;
  bool HasColor = false;
  std::array<double, 3> Color{};
};

class vtkPointBlocks
{
public:
  /// Positions in a list of points, from the first to the one past the last.
  using Range = std::array<vtkIdType, 2>;

  vtkPointBlocks();
  ~vtkPointBlocks();

  /**
   * Reads the input and what is said of its blocks; `arrays` are the point arrays that are needed
   * beside texture coordinates, ghosts and, if asked, normals. Does next to nothing when nothing
   * has changed.
   */
  void Update(vtkDataObject* input, vtkCompositeDataDisplayAttributes* attributes, bool normals,
    const std::vector<std::string>& arrays);

  /**
   * The points of all blocks with their point arrays; the input itself if that is a vtkPolyData.
   */
  vtkPolyData* GetCloud() const;

  const std::vector<vtkPointBlock>& GetBlocks() const { return this->Blocks; }

  /**
   * Whether the input is a tree, not one point set.
   */
  bool IsComposite() const { return this->Composite; }

  /**
   * What has to be said of the input since the last update that changed the cloud, a line each.
   */
  const std::vector<std::string>& GetRemarks() const { return this->Remarks; }

  /**
   * The block with a point of the cloud.
   */
  const vtkPointBlock& GetBlockOf(vtkIdType point) const;

  /**
   * Where the points of the blocks lie in a list of ids in rising order, or, if it is empty, among
   * all points.
   */
  static std::vector<Range> GetRanges(
    const std::vector<const vtkPointBlock*>& blocks, const std::vector<unsigned int>& ids);

  /**
   * Adds the finite coordinates of a block to bounds.
   */
  static void AddBounds(const vtkPointBlock& block, double bounds[6]);

private:
  vtkPointBlocks(const vtkPointBlocks&) = delete;
  void operator=(const vtkPointBlocks&) = delete;

  /// Arrays one after another as one, made anew only when one of them changes.
  class JoinedArray
  {
  public:
    vtkDataArray* Join(const std::vector<vtkDataArray*>& parts);

  private:
    std::vector<std::pair<vtkDataArray*, vtkMTimeType>> Parts; // only compared
    vtkSmartPointer<vtkDataArray> Array;
  };

  void Visit(vtkDataObject* object, vtkCompositeDataDisplayAttributes* attributes,
    vtkPointBlock inherited, unsigned int& flatIndex);
  void MakeCloud(vtkDataObject* input, bool normals, const std::vector<std::string>& arrays);
  void JoinAttribute(int attribute, const char* what);
  vtkDataArray* JoinNamed(const std::string& name);

  /// Of what the cloud was made.
  struct Source
  {
    std::vector<std::pair<vtkDataObject*, vtkMTimeType>> Data; // only compared
    std::vector<std::string> Arrays;
    bool operator==(const Source& other) const
    {
      return this->Data == other.Data && this->Arrays == other.Arrays;
    }
  };
  Source CloudSource;

  std::vector<vtkPointBlock> Blocks;
  bool Composite = false;
  vtkSmartPointer<vtkPolyData> Cloud;
  vtkNew<vtkPoints> Points; // of several blocks
  std::map<std::string, JoinedArray> Arrays;
  std::vector<std::string> Skipped; // what Visit() could not use
  std::vector<std::string> Remarks;
};

#endif
