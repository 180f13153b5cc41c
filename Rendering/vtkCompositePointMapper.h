// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkCompositePointMapper
 * @brief   what is drawn, and in which colours: any vtkPointSet, or the blocks of a tree of them
 *
 * The abstract base of vtkPointSurfaceMapper, which says how points are drawn. Its input is any
 * vtkPointSet, or a tree of them (vtkMultiBlockDataSet, vtkPartitionedDataSet,
 * vtkPartitionedDataSetCollection), whose blocks have a visibility, pickability, colour and opacity
 * each, with the methods of vtkCompositePolyDataMapper2. To a subclass the input is one cloud, the
 * points of a block after those of the block before it; opaque and translucent blocks are drawn
 * apart, as VTK's passes ask for them.
 *
 * Point arrays, normals and texture coordinates are used of blocks that all have them. Scalars may
 * be missing in some blocks, which then have the property's colour. With several blocks
 * InterpolateScalarsBeforeMapping has no effect.
 *
 * @sa vtkPointSurfaceMapper vtkCompositePolyDataMapper2 vtkCompositeDataDisplayAttributes
 */
#ifndef vtkCompositePointMapper_h
#define vtkCompositePointMapper_h

#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPointSurfaceModule.h" // for export macro

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

class vtkCompositeDataDisplayAttributes;
class vtkPointBlocks;
struct vtkPointBlock;

/// Blocks that are drawn together.
using vtkPointBlockGroup = std::vector<const vtkPointBlock*>;

class VTKPOINTSURFACE_EXPORT vtkCompositePointMapper : public vtkOpenGLPolyDataMapper
{
public:
  vtkTypeMacro(vtkCompositePointMapper, vtkOpenGLPolyDataMapper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The input: a vtkPointSet, or a vtkDataObjectTree of them. Default: none.
   */
  void SetInputData(vtkDataObject* input) { this->SetInputDataObject(input); }

  ///@{
  /**
   * How the blocks of a composite input are displayed: an object that several mappers may share.
   * What is set of a group of blocks holds for those in it of which nothing is set. Default: none;
   * the methods below make one where there is none.
   */
  void SetCompositeDataDisplayAttributes(vtkCompositeDataDisplayAttributes* attributes);
  vtkCompositeDataDisplayAttributes* GetCompositeDataDisplayAttributes();
  ///@}

  ///@{
  /**
   * Whether a block is drawn, by its flat index (of the current input; 0 is the whole of it, 1 its
   * first child, and so on, depth first). An index that the input does not have is an error. A
   * change uploads nothing. Default: true.
   */
  void SetBlockVisibility(unsigned int index, bool visible);
  bool GetBlockVisibility(unsigned int index);
  void RemoveBlockVisibility(unsigned int index);
  void RemoveBlockVisibilities();
  ///@}

  ///@{
  /**
   * Whether selection and hardware picking see a block, by its flat index. Default: true.
   */
  void SetBlockPickability(unsigned int index, bool pickable);
  bool GetBlockPickability(unsigned int index);
  void RemoveBlockPickability(unsigned int index);
  void RemoveBlockPickabilities();
  ///@}

  ///@{
  /**
   * Colour of a block, by its flat index, three values from 0 to 1; it is used in place of scalars
   * and of the property's colour. A change uploads colours only. Default: white, which is not used.
   */
  void SetBlockColor(unsigned int index, const double color[3]);
  void SetBlockColor(unsigned int index, double r, double g, double b);
  void GetBlockColor(unsigned int index, double color[3]);
  void RemoveBlockColor(unsigned int index);
  void RemoveBlockColors();
  ///@}

  ///@{
  /**
   * Opacity of a block, 0 to 1, by its flat index, in place of the property's. A change uploads
   * colours only. Default: 1, which is not used.
   */
  void SetBlockOpacity(unsigned int index, double opacity);
  double GetBlockOpacity(unsigned int index);
  void RemoveBlockOpacity(unsigned int index);
  void RemoveBlockOpacities();
  ///@}

  ///@{
  /**
   * Draw blocks that lack the array to colour by in the lookup table's colour for NaN, not the
   * property's colour. Default off.
   */
  vtkSetMacro(ColorMissingArraysWithNanColor, bool);
  vtkGetMacro(ColorMissingArraysWithNanColor, bool);
  vtkBooleanMacro(ColorMissingArraysWithNanColor, bool);
  ///@}

  ///@{
  /**
   * What VTK asks to know in which of its passes to draw. A composite input can have both.
   */
  bool HasOpaqueGeometry() override;
  bool HasTranslucentPolygonalGeometry() override;
  ///@}

  /**
   * Selection: every pixel of the surface has the id of a point on it, also where none was
   * projected. Called by vtkHardwareSelector; ids are of the points of a block (of a cell that uses
   * the point, if cells are asked for), with the block's flat index. PointIdArrayName,
   * CellIdArrayName, CompositeIdArrayName and ProcessIdArrayName are used as in
   * vtkOpenGLPolyDataMapper.
   */
  void ProcessSelectorPixelBuffers(
    vtkHardwareSelector* selector, std::vector<unsigned int>& pixelOffsets, vtkProp* prop) override;

  /**
   * Includes the time of the CompositeDataDisplayAttributes.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkCompositePointMapper();
  ~vtkCompositePointMapper() override;

  /**
   * The input as of the last UpdateBlocks(), which RenderPiece() and ComputeBounds() call.
   */
  const vtkPointBlocks& GetBlocks() const;
  void UpdateBlocks();

  /**
   * The blocks to draw in VTK's current pass; those of one group are reconstructed together.
   */
  std::vector<vtkPointBlockGroup> GetBlockGroups(vtkRenderer* renderer, vtkActor* actor);

  /**
   * Whether the subclass makes use of the points' normals. True by default.
   */
  virtual bool NeedsNormals() const { return true; }

  /**
   * Adds the names of point arrays that are needed beside normals, texture coordinates and ghosts.
   */
  virtual void AddArrayNames(std::vector<std::string>&) {}

  ///@{
  /**
   * Colours of the points, and then scalars to be mapped by texture; nullptr where there are none.
   * They stay the same objects for as long as their values do.
   */
  vtkDataArray* GetPointColors(vtkActor* actor);
  vtkDataArray* GetPointColorCoordinates();
  ///@}

  ///@{
  /**
   * Warns of a fault in the data, if that has not been said since ForgetWarnings().
   */
  void WarnOnce(const std::string& text);
  void ForgetWarnings();
  ///@}

  // What VTK calls; see vtkOpenGLPolyDataMapper.
  vtkExecutive* CreateDefaultExecutive() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  void RenderPiece(vtkRenderer* renderer, vtkActor* actor) override;
  void UpdateCameraShiftScale(vtkRenderer* renderer, vtkActor* actor) override;
  void ComputeBounds() override;
  void UpdateMaximumPointCellIds(vtkRenderer* renderer, vtkActor* actor) override;
  int CanUseTextureMapForColoring(vtkDataObject* input) override;
  void SetPropertyShaderParameters(
    vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override;

  bool ColorMissingArraysWithNanColor = false;

private:
  vtkCompositePointMapper(const vtkCompositePointMapper&) = delete;
  void operator=(const vtkCompositePointMapper&) = delete;

  // The node of the input's tree; else nullptr, with an error.
  vtkDataObject* GetNode(unsigned int index);
  vtkCompositeDataDisplayAttributes* ModifyAttributes();
  vtkUnsignedCharArray* MapPointColors(vtkDataSet* data);

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
