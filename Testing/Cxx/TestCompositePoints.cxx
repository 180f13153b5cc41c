// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are not one polydata: any point set, and trees of them. A tree looks as the one cloud
// of all its blocks; blocks have a visibility, colour and opacity each, opaque and translucent ones
// are reconstructed apart; faults are told. For every mapper, with both back ends.

#include "PointSurfaceTestMappers.h"
#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkColor.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPropPicker.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <string>
#include <vector>

using namespace PointSurfaceTest;

namespace
{
Checks check;

constexpr int Size = 240;
constexpr int PointsOfBall = 4000;

using Pixel = std::array<int, 3>;

struct Kind
{
  const MapperClass& Class;
  int Backend;
  vtkSmartPointer<vtkPolyData> Ball; ///< around the origin, as the mapper wants it
  std::string Name;
};

struct Scene
{
  vtkSmartPointer<vtkPointSurfaceMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkUnsignedCharArray> Pixels;

  Scene(const Kind& kind, vtkDataObject* input)
    : Mapper(kind.Class.Make())
  {
    this->Mapper->SetBackend(kind.Backend);
    this->Mapper->SetInputData(input);
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->SetColor(0.2, 0.4, 1.0);
    this->Renderer->AddActor(this->Actor);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 10.0);
    camera->ParallelProjectionOn();
    camera->SetParallelScale(3.0);
    camera->SetClippingRange(1.0, 20.0);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
  }

  std::vector<unsigned char> Render()
  {
    this->Window->Render();
    this->Window->GetPixelData(0, 0, Size - 1, Size - 1, 0, this->Pixels);
    const unsigned char* first = this->Pixels->GetPointer(0);
    return { first, first + this->Pixels->GetNumberOfValues() };
  }

  /// Of the last picture, at world coordinates in the plane of the camera's focal point.
  Pixel At(double x, double y)
  {
    const int column = static_cast<int>((x + 3.0) / 6.0 * Size);
    const int row = static_cast<int>((y + 3.0) / 6.0 * Size);
    const unsigned char* rgb = this->Pixels->GetPointer(3 * (row * Size + column));
    return { rgb[0], rgb[1], rgb[2] };
  }

  bool CanBePicked(double x, double y)
  {
    const double column = (x + 3.0) / 6.0 * Size;
    const double row = (y + 3.0) / 6.0 * Size;
    return vtkNew<vtkPropPicker>()->PickProp(column, row, this->Renderer) == 1;
  }

  bool IsEmpty(double x, double y) { return this->At(x, y) == Pixel{ 0, 0, 0 }; }
};

/// Points [first, end) of a cloud with their arrays, as a point set of a class.
template <typename T>
vtkSmartPointer<T> GetPart(vtkPolyData* cloud, vtkIdType first, vtkIdType end)
{
  auto part = vtkSmartPointer<T>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  vtkPointData* data = cloud->GetPointData();
  part->GetPointData()->CopyAllOn();
  part->GetPointData()->CopyAllocate(data, end - first);
  for (vtkIdType i = first; i < end; ++i)
  {
    part->GetPointData()->CopyData(data, i, points->InsertNextPoint(cloud->GetPoint(i)));
  }
  part->SetPoints(points);
  return part;
}

/// A ball around a centre, with its height as scalars.
vtkSmartPointer<vtkPolyData> MakeBall(const Kind& kind, double x, double y, double z)
{
  auto ball = vtkSmartPointer<vtkPolyData>::New();
  ball->DeepCopy(kind.Ball);
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    double p[3];
    ball->GetPoint(i, p);
    height->InsertNextValue(static_cast<float>(p[1]));
    ball->GetPoints()->SetPoint(i, p[0] + x, p[1] + y, p[2] + z);
  }
  ball->GetPointData()->SetScalars(height);
  return ball;
}

/// A tree with groups within groups, an empty child and an empty block: the flat indices of the
/// balls are 2 (left), 4 (right), 6 (top); 3 is the group of right and top.
vtkSmartPointer<vtkMultiBlockDataSet> MakeBalls(const Kind& kind)
{
  vtkNew<vtkMultiBlockDataSet> pair;
  pair->SetBlock(0, MakeBall(kind, 1.5, 0.0, 0.0));
  pair->SetBlock(2, MakeBall(kind, 0.0, 1.7, 0.0));
  auto tree = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  tree->SetBlock(0, vtkNew<vtkPolyData>());
  tree->SetBlock(1, MakeBall(kind, -1.5, 0.0, 0.0));
  tree->SetBlock(2, pair);
  return tree;
}

constexpr unsigned int Left = 2;
constexpr unsigned int Pair = 3;
constexpr unsigned int Right = 4;
constexpr unsigned int Top = 6;

//------------------------------------------------------------------------------
/// The same points in whatever they come make the same picture, in one reconstruction.
void CheckKindsOfInput(const Kind& kind)
{
  const std::string& name = kind.Name;
  auto cloud = MakeBall(kind, 0.3, 0.2, 0.0);
  const vtkIdType count = cloud->GetNumberOfPoints();
  const vtkIdType parts[4] = { 0, 1000, count / 2, count };
  vtkNew<vtkPartitionedDataSet> partitions;
  vtkNew<vtkPartitionedDataSetCollection> collection;
  vtkNew<vtkMultiBlockDataSet> tree;
  for (unsigned int i = 0; i < 3; ++i)
  {
    auto part = GetPart<vtkPolyData>(cloud, parts[i], parts[i + 1]);
    partitions->SetPartition(i, part);
    collection->SetPartition(i, 0, part);
    tree->SetBlock(i, GetPart<vtkUnstructuredGrid>(cloud, parts[i], parts[i + 1]));
  }
  vtkNew<vtkMultiBlockDataSet> one;
  one->SetBlock(0, cloud);
  auto grid = GetPart<vtkStructuredGrid>(cloud, 0, count);
  grid->SetDimensions(static_cast<int>(count), 1, 1);

  for (bool colored : { false, true })
  {
    Scene truth(kind, cloud);
    truth.Mapper->SetScalarVisibility(colored);
    const auto expected = truth.Render();
    check(!truth.IsEmpty(0.3, 0.2), name + ": the cloud is drawn");
    auto isAsOneCloud = [&](vtkDataObject* input)
    {
      Scene scene(kind, input);
      scene.Mapper->SetScalarVisibility(colored);
      const std::string what = name + ": " + input->GetClassName();
      check(scene.Render() == expected, what + " looks as the polydata");
      check(scene.Mapper->GetLastFrameReconstructions() == 1, what + " is reconstructed once");
      check(scene.Mapper->GetLastFramePointsDrawn() == count, what + " is all drawn");
    };
    isAsOneCloud(GetPart<vtkUnstructuredGrid>(cloud, 0, count));
    isAsOneCloud(GetPart<vtkPointSet>(cloud, 0, count));
    isAsOneCloud(grid);
    isAsOneCloud(one);
    isAsOneCloud(tree);
    isAsOneCloud(partitions);
    isAsOneCloud(collection);
  }
}

/// Colours of cells of any point set.
void CheckCellColors(const Kind& kind)
{
  const std::string& name = kind.Name;
  vtkNew<vtkUnstructuredGrid> grid;
  auto ball = MakeBall(kind, 0.0, 0.0, 0.0);
  grid->SetPoints(ball->GetPoints());
  grid->GetPointData()->ShallowCopy(ball->GetPointData());
  grid->GetPointData()->RemoveArray("height");
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    grid->InsertNextCell(VTK_VERTEX, 1, &i);
    colors->InsertNextTuple3(ball->GetPoint(i)[1] > 0.0 ? 255 : 0, 0, 255);
  }
  grid->GetCellData()->SetScalars(colors);
  Scene scene(kind, grid);
  scene.Render();
  check(scene.At(0.0, 0.4)[0] > 150 && scene.At(0.0, -0.4)[0] == 0,
    name + ": points of a grid have the colours of their cells");
}

void CheckBlocks(const Kind& kind)
{
  const std::string& name = kind.Name;
  auto tree = MakeBalls(kind);
  Scene scene(kind, tree);
  vtkPointSurfaceMapper* mapper = scene.Mapper;
  mapper->ScalarVisibilityOff();
  scene.Render();
  check(!scene.IsEmpty(-1.5, 0.0) && !scene.IsEmpty(1.5, 0.0) && !scene.IsEmpty(0.0, 1.7),
    name + ": all blocks are drawn");
  check(mapper->GetLastFramePointsDrawn() == 3 * PointsOfBall &&
      mapper->GetLastFrameReconstructions() == 1,
    name + ": all blocks in one reconstruction");

  // visibility: of a group, with an exception in it
  mapper->SetBlockVisibility(Pair, false);
  mapper->SetBlockVisibility(Top, true);
  scene.Render();
  check(!scene.IsEmpty(-1.5, 0.0) && scene.IsEmpty(1.5, 0.0) && !scene.IsEmpty(0.0, 1.7),
    name + ": a hidden group but for one block of it");
  check(
    mapper->GetLastFramePointsDrawn() == 2 * PointsOfBall, name + ": hidden blocks cost nothing");
  check(!mapper->GetBlockVisibility(Pair) && mapper->GetBlockVisibility(Top),
    name + ": visibility is told");
  mapper->SetBlockVisibility(Left, false);
  // patches reach beyond their points
  const double reach =
    kind.Class.DrawsSplats ? kind.Ball->GetPointData()->GetArray("radius")->GetRange()[1] : 0.0;
  check(std::abs(mapper->GetBounds()[2] - (0.7 - reach)) < 0.01,
    name + ": bounds are of visible blocks");
  mapper->RemoveBlockVisibilities();
  scene.Render();
  check(!scene.IsEmpty(1.5, 0.0), name + ": all are visible again");

  // by attributes that the user made
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  auto* right = vtkCompositeDataDisplayAttributes::DataObjectFromIndex(Right, tree);
  attributes->SetBlockVisibility(right, false);
  mapper->SetCompositeDataDisplayAttributes(attributes);
  scene.Render();
  check(!scene.IsEmpty(-1.5, 0.0) && scene.IsEmpty(1.5, 0.0) && !mapper->GetBlockVisibility(Right),
    name + ": a block that attributes hide");
  attributes->RemoveBlockVisibility(right);
  attributes->SetBlockColor(right, vtkColor3d(0.0, 1.0, 0.0).GetData());
  attributes->SetBlockPickability(right, false);
  scene.Render();
  check(scene.At(1.5, 0.0)[1] > 200 && scene.At(1.5, 0.0)[2] == 0 && scene.At(-1.5, 0.0)[2] > 200,
    name + ": a block that attributes colour");
  check(scene.CanBePicked(-1.5, 0.0) && !scene.CanBePicked(1.5, 0.0),
    name + ": a block that attributes keep from being picked");
  attributes->SetBlockOpacity(right, 0.5);
  scene.Render();
  check(scene.At(1.5, 0.0)[1] > 100 && scene.At(1.5, 0.0)[1] < 140 && scene.At(-1.5, 0.0)[2] > 200,
    name + ": a block that attributes make translucent");
  mapper->SetCompositeDataDisplayAttributes(nullptr);

  // colour in place of the property's and of scalars
  mapper->SetBlockColor(Left, 1.0, 0.0, 0.0);
  scene.Render();
  check(scene.At(-1.5, 0.0)[0] > 200 && scene.At(-1.5, 0.0)[2] == 0, name + ": a red block");
  check(scene.At(1.5, 0.0)[2] > 200 && scene.At(1.5, 0.0)[0] < 60, name + ": others are blue");
  mapper->ScalarVisibilityOn();
  mapper->SetScalarRange(-1.0, 1.0);
  scene.Render();
  check(scene.At(-1.5, 0.0)[0] > 200 && scene.At(-1.5, 0.5)[2] == 0,
    name + ": a red block whatever its scalars are");
  check(scene.At(1.5, -0.8)[0] > scene.At(1.5, 0.8)[0], name + ": others by their scalars");
  double color[3];
  mapper->GetBlockColor(Left, color);
  check(color[0] == 1.0 && color[1] == 0.0, name + ": the colour is told");

  // a block without the array
  vtkPointSet::SafeDownCast(vtkCompositeDataDisplayAttributes::DataObjectFromIndex(Right, tree))
    ->GetPointData()
    ->SetScalars(nullptr);
  mapper->RemoveBlockColor(Left);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("height");
  vtkPointSet::SafeDownCast(vtkCompositeDataDisplayAttributes::DataObjectFromIndex(Right, tree))
    ->GetPointData()
    ->RemoveArray("height");
  scene.Render();
  check(scene.At(1.5, 0.0)[2] > 200 && scene.At(1.5, 0.0)[0] < 60,
    name + ": a block that lacks the scalars has the property's colour");
  vtkNew<vtkLookupTable> table;
  table->SetNanColor(0.0, 1.0, 0.0, 1.0);
  mapper->SetLookupTable(table);
  mapper->ColorMissingArraysWithNanColorOn();
  scene.Render();
  check(scene.At(1.5, 0.0)[1] > 200 && scene.At(1.5, 0.0)[2] == 0,
    name + ": or that for NaN, if wanted");

  // ghosts
  auto* top =
    vtkPointSet::SafeDownCast(vtkCompositeDataDisplayAttributes::DataObjectFromIndex(Top, tree));
  for (unsigned int flatIndex : { Left, Right, Top })
  {
    auto* block = vtkPointSet::SafeDownCast(
      vtkCompositeDataDisplayAttributes::DataObjectFromIndex(flatIndex, tree));
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    ghosts->SetNumberOfValues(block->GetNumberOfPoints());
    ghosts->Fill(block == top ? vtkDataSetAttributes::HIDDENPOINT : 0);
    block->GetPointData()->AddArray(ghosts);
  }
  scene.Render();
  check(!scene.IsEmpty(-1.5, 0.0) && !scene.IsEmpty(1.5, 0.0) && scene.IsEmpty(0.0, 1.7),
    name + ": hidden points are not drawn");
}

/// Points that are left out of a block take none from it, or from another one.
void CheckPointsLeftOut(const Kind& kind)
{
  vtkNew<vtkMultiBlockDataSet> tree;
  for (unsigned int i : { 0, 1 })
  {
    auto ball = MakeBall(kind, i == 0 ? 1.5 : -1.5, 0.0, 0.0);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    for (vtkIdType id = 0; id < PointsOfBall; ++id)
    {
      const bool hidden = i == 0 && ball->GetPoint(id)[2] < 0.0; // which is not seen
      ghosts->InsertNextValue(hidden ? vtkDataSetAttributes::HIDDENPOINT : 0);
    }
    ball->GetPointData()->AddArray(ghosts);
    tree->SetBlock(i, ball);
  }
  Scene scene(kind, tree);
  scene.Mapper->ScalarVisibilityOff();
  scene.Mapper->SetBlockVisibility(2, false);
  scene.Render();
  check(!scene.IsEmpty(1.5, 0.0) && scene.IsEmpty(-1.5, 0.0),
    kind.Name + ": a hidden block beside one with points left out");
  check(scene.Mapper->GetLastFramePointsDrawn() == PointsOfBall / 2,
    kind.Name + ": of which all others are drawn");
}

/// A translucent ball before an opaque one: each as it looks alone, one over the other.
void CheckOpacity(const Kind& kind)
{
  const std::string& name = kind.Name;
  vtkNew<vtkMultiBlockDataSet> tree;
  tree->SetBlock(0, MakeBall(kind, 0.0, 0.0, -3.0));
  tree->SetBlock(1, MakeBall(kind, 0.6, 0.0, 0.0));
  tree->SetBlock(2, MakeBall(kind, -2.0, 0.0, 0.0));
  Scene scene(kind, tree);
  vtkPointSurfaceMapper* mapper = scene.Mapper;
  mapper->ScalarVisibilityOff();
  mapper->SetBlockColor(1, 1.0, 0.0, 0.0);
  mapper->SetBlockColor(2, 0.0, 1.0, 0.0);
  scene.Render();
  const Pixel front = scene.At(0.3, 0.0);
  mapper->SetBlockVisibility(2, false);
  scene.Render();
  const Pixel back = scene.At(0.3, 0.0);
  mapper->RemoveBlockVisibility(2);
  mapper->SetBlockOpacity(2, 0.4);
  check(mapper->HasOpaqueGeometry() && mapper->HasTranslucentPolygonalGeometry(),
    name + ": there is something for both passes of VTK");
  scene.Render();
  const Pixel both = scene.At(0.3, 0.0);
  double largest = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    largest = std::max(largest, std::abs(both[k] - (0.4 * front[k] + 0.6 * back[k])));
  }
  check.AtMost(largest, 2.0, name + ": a translucent block over an opaque one, in grey levels");
  check(
    mapper->GetLastFrameReconstructions() == 1 && mapper->GetLastFramePointsDrawn() == PointsOfBall,
    name + ": the translucent block is reconstructed by itself");
  scene.Render();
  check(mapper->GetLastFrameReconstructions() == 0, name + ": and not again");
  check(mapper->GetBlockOpacity(2) == 0.4 && mapper->GetBlockOpacity(3) == 1.0,
    name + ": opacities are told");

  // an actor that is drawn with the opaque ones has all its blocks there
  scene.Actor->ForceOpaqueOn();
  scene.Render();
  check(!scene.IsEmpty(1.3, 0.0), name + ": a translucent block of an actor that is forced opaque");
  scene.Actor->ForceOpaqueOff();

  // a translucent property, and an opaque block all the same
  scene.Actor->GetProperty()->SetOpacity(0.5);
  mapper->RemoveBlockOpacities();
  mapper->SetBlockOpacity(2, 1.0);
  scene.Render();
  check(scene.At(0.3, 0.0) == front, name + ": an opaque block of a translucent actor");
  check(scene.At(-2.0, 0.0)[2] > 100 && scene.At(-2.0, 0.0)[2] < 140,
    name + ": its other blocks are translucent");
}

/// A block's own opacity leaves the alpha of another one's colours as it is.
void CheckAlphaOfColors(const Kind& kind)
{
  auto tree = MakeBalls(kind);
  auto* left =
    vtkPointSet::SafeDownCast(vtkCompositeDataDisplayAttributes::DataObjectFromIndex(Left, tree));
  Pixel opaque = {};
  for (const int alpha : { 255, 102 })
  {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(4);
    for (vtkIdType i = 0; i < left->GetNumberOfPoints(); ++i)
    {
      colors->InsertNextTuple4(255, 150, 0, alpha);
    }
    left->GetPointData()->SetScalars(colors);
    Scene scene(kind, tree);
    scene.Mapper->SetBlockOpacity(Right, 0.6);
    scene.Render();
    const Pixel seen = scene.At(-1.5, 0.0);
    opaque = alpha == 255 ? seen : opaque;
    const double share = alpha / 255.0;
    check(opaque[0] > 200 && std::abs(seen[0] - share * opaque[0]) < 3.0 &&
        std::abs(seen[1] - share * opaque[1]) < 3.0,
      kind.Name + ": a block with an alpha of " + std::to_string(alpha) + " shows " +
        std::to_string(seen[0]) + ", " + std::to_string(seen[1]));
  }
}

void CheckFaults(const Kind& kind)
{
  const std::string& name = kind.Name;
  auto warns = [&](vtkDataObject* input, const std::string& text)
  {
    Scene scene(kind, input);
    Messages messages(scene.Mapper);
    scene.Mapper->ScalarVisibilityOff();
    scene.Render();
    check(messages.Contain(text), name + ": a warning that says: " + text);
    return !scene.IsEmpty(-1.5, 0.0);
  };
  auto tree = MakeBalls(kind);
  tree->SetBlock(0, vtkNew<vtkImageData>());
  check(warns(tree, "Block 1 is a vtkImageData"), name + ": other blocks are drawn");
  tree = MakeBalls(kind);
  vtkPointSet::SafeDownCast(tree->GetBlock(1))->GetPointData()->SetNormals(nullptr);
  if (kind.Class.DrawsSplats)
  {
    Scene scene(kind, tree);
    Messages messages(scene.Mapper);
    scene.Render();
    check(messages.GetCount() == 2 && scene.IsEmpty(-1.5, 0.0),
      name + ": without normals of all blocks there are no splats, which is said");
  }
  else if (kind.Class.UsesNormals)
  {
    check(warns(tree, "Block 2 has no normals"), name + ": normals are estimated");
  }
  else
  {
    Scene scene(kind, tree);
    Messages messages(scene.Mapper);
    scene.Render();
    check(messages.GetCount() == 0, name + ": nothing is said of normals that are not needed");
  }
  tree = MakeBalls(kind);
  vtkPointSet::SafeDownCast(tree->GetBlock(1))->GetPointData()->RemoveArray("radius");
  if (kind.Class.UsesRadii)
  {
    check(warns(tree, "Block 2 has no point array 'radius'"), name + ": radii are estimated");
  }
  warns(vtkNew<vtkMultiBlockDataSet>(), "The input has no points");

  Scene scene(kind, tree);
  Messages messages(scene.Mapper);
  scene.Mapper->SetBlockVisibility(17, false);
  check(messages.Contain("no block with the flat index 17"), name + ": no such block");
}
}

int TestCompositePoints(int, char*[])
{
  for (const MapperClass& mapperClass : GetMapperClasses())
  {
    auto ball = mapperClass.MakeInput(MakeSphereCloud(PointsOfBall));
    for (int backend : { vtkPointSurfaceMapper::OpenGL, vtkPointSurfaceMapper::CPU })
    {
      const Kind kind = { mapperClass, backend, ball,
        mapperClass.Name + (backend == vtkPointSurfaceMapper::CPU ? ", CPU" : ", OpenGL") };
      CheckKindsOfInput(kind);
      CheckCellColors(kind);
      CheckBlocks(kind);
      CheckPointsLeftOut(kind);
      CheckOpacity(kind);
      CheckAlphaOfColors(kind);
      CheckFaults(kind);
    }
  }
  return check.GetResult();
}
