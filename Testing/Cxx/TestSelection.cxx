// SPDX-License-Identifier: BSD-3-Clause
// Selection and picking of sparse clouds, most of whose pixels no point falls on: each pixel that
// shows a surface gives a point of the sheet that is seen there, not of one before or behind it,
// and mostly within a radius of the place; its block, prop and process; pickers give the prop and a
// place on the surface. Truth: the spheres and planes that the clouds stand for, and the colour
// that each sheet has.

#include "PointSurfaceTestMappers.h"
#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkAreaPicker.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointPicker.h"
#include "vtkPropPicker.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderedAreaPicker.h"
#include "vtkRenderer.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>

using namespace PointSurfaceTest;

namespace
{
Checks check;

constexpr int Size = 300;
constexpr double HalfHeight = 3.0; // of the view

struct Ball
{
  double Center[2];
  unsigned int CompositeIndex;
  bool InTree;
};

/// Two blocks of one actor, and a cloud of another one.
const Ball Balls[3] = { { { -1.6, 0.9 }, 1, true }, { { 1.6, 0.9 }, 3, true },
  { { 0.0, -1.6 }, 1, false } };

vtkSmartPointer<vtkPolyData> MakeBall(
  const MapperClass& mapperClass, const Ball& ball, vtkIdType firstId)
{
  auto cloud = mapperClass.MakeInput(MakeSphereCloud(mapperClass.FillsSmallGaps ? 6000 : 1500));
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("ids");
  vtkNew<vtkUnsignedIntArray> processes;
  processes->SetName("processes");
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double x[3];
    cloud->GetPoint(i, x);
    cloud->GetPoints()->SetPoint(i, x[0] + ball.Center[0], x[1] + ball.Center[1], x[2]);
    ids->InsertNextValue(firstId + 2 * i);
    processes->InsertNextValue(x[0] > 0.0 ? 7 : 5);
  }
  cloud->GetPointData()->AddArray(ids);
  cloud->GetPointData()->AddArray(processes);
  return cloud;
}

struct Scene
{
  vtkSmartPointer<vtkPointSurfaceMapper> Mapper;
  vtkSmartPointer<vtkPointSurfaceMapper> OtherMapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkActor> OtherActor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkSmartPointer<vtkPolyData> Clouds[3];
  std::string Name;
  double NearEnough;      ///< of a point to a surface that faces the eye, in radii
  double FarthestAllowed; ///< where it is an outline
  vtkIdType PointsOfBall;
  double Radius; ///< of a point

  Scene(const MapperClass& mapperClass, int backend)
    : Mapper(mapperClass.Make())
    , OtherMapper(mapperClass.Make())
    , Name(mapperClass.Name + (backend == vtkPointSurfaceMapper::CPU ? ", CPU: " : ", OpenGL: "))
    // gaps are filled with what is nearest in the picture; and splats without normals lean less
    , NearEnough(mapperClass.FillsSmallGaps ? 2.0 : 1.0)
    // where outlines are trimmed, a pixel may show a disc of the coarser levels, not its own
    // point's
    , FarthestAllowed(mapperClass.FillsSmallGaps || !mapperClass.UsesNormals ||
            mapperClass.Name == "vtkPullPushMapper"
          ? 3.0
          : 2.2)
  {
    for (int i = 0; i < 3; ++i)
    {
      this->Clouds[i] = MakeBall(mapperClass, Balls[i], 100000000 * i);
    }
    this->PointsOfBall = this->Clouds[0]->GetNumberOfPoints();
    this->Radius = 1.5 * std::sqrt(4.0 * vtkMath::Pi() / this->PointsOfBall);
    vtkNew<vtkMultiBlockDataSet> tree;
    tree->SetBlock(0, this->Clouds[0]);
    tree->SetBlock(2, this->Clouds[1]);
    this->Mapper->SetInputData(tree);
    this->Actor->SetMapper(this->Mapper);
    this->OtherMapper->SetInputData(this->Clouds[2]);
    this->OtherActor->SetMapper(this->OtherMapper);
    for (vtkPointSurfaceMapper* mapper : { this->Mapper.Get(), this->OtherMapper.Get() })
    {
      mapper->SetBackend(backend);
    }
    for (vtkActor* actor : { this->Actor.Get(), this->OtherActor.Get() })
    {
      actor->GetProperty()->SetAmbient(0.2); // no pixel of a surface is black
    }
    this->Renderer->AddActor(this->Actor);
    this->Renderer->AddActor(this->OtherActor);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(0.0, 0.0, 10.0);
    camera->ParallelProjectionOn();
    camera->SetParallelScale(HalfHeight);
    camera->SetClippingRange(1.0, 20.0);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
  }
};

/// The ball of a pixel, and the place of its surface there, that of the outline where the ray
/// misses the ball.
const Ball& GetTruth(int column, int row, double place[3])
{
  place[0] = HalfHeight * (2.0 * (column + 0.5) / Size - 1.0);
  place[1] = HalfHeight * (2.0 * (row + 0.5) / Size - 1.0);
  const Ball& ball = place[1] < -0.35 ? Balls[2] : place[0] < 0.0 ? Balls[0] : Balls[1];
  const double x = place[0] - ball.Center[0];
  const double y = place[1] - ball.Center[1];
  place[2] = std::sqrt(std::max(0.0, 1.0 - x * x - y * y));
  return ball;
}

struct Count
{
  int Shown = 0;
  int Missed = 0;
  int Extra = 0;
  int WrongProp = 0;
  int WrongBlock = 0;
  int WrongProcess = 0;
  int WrongId = 0;
  int Facing = 0; // pixels whose surface does not recede more than twice as far as it is wide
  int Far = 0;    // of them, points that are not near enough
  double Farthest = 0.0;
};

/// Selects the whole window; `field` are points or cells.
Count Select(Scene& scene, int field, bool withArrays)
{
  scene.Window->Render();
  vtkNew<vtkUnsignedCharArray> picture;
  scene.Window->GetPixelData(0, 0, Size - 1, Size - 1, 0, picture);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, Size - 1, Size - 1);
  selector->SetFieldAssociation(field);
  selector->SetProcessID(3);
  selector->SetUseProcessIdFromData(withArrays);
  check(selector->CaptureBuffers(), scene.Name + "selection captures its buffers");
  Count count;
  for (unsigned int pixel = 0; pixel < Size * Size; ++pixel)
  {
    const unsigned int position[2] = { pixel % Size, pixel / Size };
    const unsigned char* rgb = picture->GetPointer(3 * pixel);
    const bool shown = rgb[0] + rgb[1] + rgb[2] > 0;
    const auto info = selector->GetPixelInformation(position);
    count.Shown += shown;
    count.Missed += shown && !info.Valid;
    count.Extra += !shown && info.Valid;
    if (!info.Valid)
    {
      continue;
    }
    double place[3];
    const Ball& ball = GetTruth(position[0], position[1], place);
    const auto index = &ball - Balls;
    count.WrongProp += info.Prop != (ball.InTree ? scene.Actor : scene.OtherActor);
    count.WrongBlock += info.CompositeID != ball.CompositeIndex;
    vtkIdType id = info.AttributeID;
    if (withArrays)
    {
      id = (id - 100000000 * index) / 2;
    }
    if (id < 0 || id >= scene.PointsOfBall)
    {
      ++count.WrongId;
      continue;
    }
    double point[3];
    scene.Clouds[index]->GetPoint(id, point);
    const int process = withArrays ? (point[0] > ball.Center[0] ? 7 : 5) : 3;
    count.WrongProcess += info.ProcessID != process;
    const double distance = std::sqrt(vtkMath::Distance2BetweenPoints(point, place)) / scene.Radius;
    if (place[2] > 0.5)
    {
      ++count.Facing;
      count.Far += distance > scene.NearEnough;
    }
    count.Farthest = std::max(count.Farthest, distance);
  }
  return count;
}

void CheckSelection(Scene& scene, int field, bool withArrays, const std::string& what)
{
  const std::string name = scene.Name + what;
  const Count count = Select(scene, field, withArrays);
  check.AtLeast(count.Shown, 15000, name + ", pixels that show a surface");
  check(count.Missed == 0, name + ": pixels without a hit: " + std::to_string(count.Missed));
  check(count.Extra == 0, name + ": hits of nothing: " + std::to_string(count.Extra));
  check(count.WrongProp == 0, name + ": wrong props: " + std::to_string(count.WrongProp));
  check(count.WrongBlock == 0, name + ": wrong blocks: " + std::to_string(count.WrongBlock));
  check(count.WrongId == 0, name + ": no such ids: " + std::to_string(count.WrongId));
  check(count.WrongProcess == 0, name + ": wrong processes: " + std::to_string(count.WrongProcess));
  check.AtMost(static_cast<double>(count.Far) / count.Facing, 0.005,
    name + ", share too far away where the surface faces the eye");
  check.AtMost(
    count.Farthest, scene.FarthestAllowed, name + ", farthest point in radii, outlines included");
}

void CheckPickability(Scene& scene)
{
  scene.Mapper->SetBlockPickability(3, false);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, Size - 1, Size - 1);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  bool other = false;
  for (unsigned int i = 0; i < selection->GetNumberOfNodes(); ++i)
  {
    other = other ||
      selection->GetNode(i)->GetProperties()->Get(vtkSelectionNode::COMPOSITE_INDEX()) == 3;
  }
  check(selection->GetNumberOfNodes() == 2 && !other,
    scene.Name + "a block that is not pickable is not selected");
  scene.Mapper->RemoveBlockPickabilities();
}

void CheckPickers(Scene& scene)
{
  scene.Window->Render();
  for (const Ball& ball : Balls)
  {
    // off the middle, where few points are
    const int column = static_cast<int>((ball.Center[0] + 0.4 + HalfHeight) / 6.0 * Size);
    const int row = static_cast<int>((ball.Center[1] - 0.3 + HalfHeight) / 6.0 * Size);
    double place[3];
    GetTruth(column, row, place);
    vtkActor* actor = ball.InTree ? scene.Actor : scene.OtherActor;

    vtkNew<vtkPropPicker> prop;
    check(prop->PickProp(column, row, scene.Renderer) == 1 && prop->GetActor() == actor,
      scene.Name + "vtkPropPicker returns the prop");
    double position[3];
    prop->GetPickPosition(position);
    check.AtMost(std::sqrt(vtkMath::Distance2BetweenPoints(position, place)), 0.03,
      scene.Name + "vtkPropPicker's position beside the surface");

    vtkNew<vtkPointPicker> point;
    point->SetTolerance(0.15 * scene.Radius); // else it takes points of the far side, too
    check(point->Pick(column, row, 0.0, scene.Renderer) == 1 && point->GetActor() == actor,
      scene.Name + "vtkPointPicker returns the actor");
    double x[3] = { 0.0, 0.0, 0.0 };
    if (point->GetPointId() >= 0 && point->GetPointId() < scene.PointsOfBall)
    {
      scene.Clouds[&ball - Balls]->GetPoint(point->GetPointId(), x);
    }
    check.AtMost(std::sqrt(vtkMath::Distance2BetweenPoints(x, place)), 2.0 * scene.Radius,
      scene.Name + "vtkPointPicker's point beside the surface");

    vtkNew<vtkAreaPicker> area;
    vtkNew<vtkRenderedAreaPicker> rendered;
    for (vtkAreaPicker* picker : { area.Get(), static_cast<vtkAreaPicker*>(rendered.Get()) })
    {
      check(picker->AreaPick(column - 3, row - 3, column + 3, row + 3, scene.Renderer) == 1 &&
          picker->GetActor() == actor,
        scene.Name + picker->GetClassName() + " returns the actor");
    }
  }
  vtkNew<vtkPropPicker> nothing;
  check(nothing->PickProp(2, 2, scene.Renderer) == 0, scene.Name + "nothing to pick in a corner");
}

/// Cells of the clouds, in another order than the points.
void AddCells(Scene& scene)
{
  for (vtkPolyData* cloud : scene.Clouds)
  {
    vtkNew<vtkCellArray> vertices;
    for (vtkIdType i = scene.PointsOfBall - 1; i >= 0; --i)
    {
      vertices->InsertNextCell(1, &i);
    }
    cloud->SetVerts(vertices);
  }
}

void CheckCells(Scene& scene)
{
  AddCells(scene);
  scene.Window->Render();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, Size - 1, Size - 1);
  int wrong = 0;
  long cells[Size];
  for (int field :
    { vtkDataObject::FIELD_ASSOCIATION_CELLS, vtkDataObject::FIELD_ASSOCIATION_POINTS })
  {
    selector->SetFieldAssociation(field);
    selector->CaptureBuffers();
    for (unsigned int x = 0; x < Size; ++x)
    {
      const unsigned int position[2] = { x, static_cast<unsigned int>(0.65 * Size) };
      const auto info = selector->GetPixelInformation(position);
      const long id = info.Valid ? static_cast<long>(info.AttributeID) : -1;
      if (field == vtkDataObject::FIELD_ASSOCIATION_CELLS)
      {
        cells[x] = id;
      }
      else
      {
        wrong += id >= 0 ? cells[x] != scene.PointsOfBall - 1 - id : cells[x] >= 0;
      }
    }
  }
  check(wrong == 0, scene.Name + "cells are those of the points: " + std::to_string(wrong));
}

/// Arrays of the cells tell what a cell is called, and of which block it is.
void CheckArraysOfCells(Scene& scene)
{
  for (vtkPolyData* cloud : scene.Clouds)
  {
    vtkNew<vtkIdTypeArray> ids;
    ids->SetName("cells");
    vtkNew<vtkUnsignedIntArray> blocks;
    blocks->SetName("blocks");
    for (vtkIdType cell = 0; cell < scene.PointsOfBall; ++cell)
    {
      ids->InsertNextValue(50000000 + cell);
      blocks->InsertNextValue(20 + cell % 2);
    }
    cloud->GetCellData()->AddArray(ids);
    cloud->GetCellData()->AddArray(blocks);
  }
  for (vtkPointSurfaceMapper* mapper : { scene.Mapper.Get(), scene.OtherMapper.Get() })
  {
    mapper->SetCellIdArrayName("cells");
    mapper->SetCompositeIdArrayName("blocks");
  }
  scene.Window->Render();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, Size - 1, Size - 1);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  selector->CaptureBuffers();
  int seen = 0;
  int wrong = 0;
  for (unsigned int x = 0; x < Size; ++x)
  {
    const unsigned int position[2] = { x, static_cast<unsigned int>(0.65 * Size) };
    const auto info = selector->GetPixelInformation(position);
    const vtkIdType cell = info.AttributeID - 50000000;
    seen += info.Valid;
    wrong += info.Valid &&
      (cell < 0 || cell >= scene.PointsOfBall ||
        info.CompositeID != 20 + static_cast<unsigned int>(cell % 2));
  }
  check(seen > 100 && wrong == 0,
    scene.Name + "cells and blocks have the names of arrays: " + std::to_string(wrong) + " of " +
      std::to_string(seen) + " have not");
}

struct Sheet
{
  double Center[3];
  double Half;  ///< of its width and height
  double Slope; ///< of z along x
};

constexpr int NumberOfSheets = 3; // and a ball
constexpr Sheet Sheets[NumberOfSheets] = { { { 0.0, 0.0, -2.0 }, 2.6, 0.0 },
  { { 0.9, 0.5, 0.3 }, 0.8, 0.7 }, { { -1.2, -0.9, -0.8 }, 0.9, -0.4 } };
constexpr unsigned char Colors[NumberOfSheets + 1][3] = { { 255, 0, 0 }, { 0, 255, 0 },
  { 0, 0, 255 }, { 255, 255, 0 } };

void AddPoint(vtkPolyData* cloud, const double x[3], const double normal[3], double radius,
  const unsigned char color[3])
{
  cloud->GetPoints()->InsertNextPoint(x);
  cloud->GetPointData()->GetNormals()->InsertNextTuple(normal);
  cloud->GetPointData()->GetArray("radius")->InsertNextTuple1(radius);
  cloud->GetPointData()->GetScalars()->InsertNextTuple3(color[0], color[1], color[2]);
}

/// One cloud of a ball, its back as well as its front, and sheets, one behind the other, each of a
/// colour.
vtkSmartPointer<vtkPolyData> MakeSheets(double spacing)
{
  auto cloud = vtkSmartPointer<vtkPolyData>::New();
  cloud->SetPoints(vtkNew<vtkPoints>());
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  cloud->GetPointData()->SetNormals(normals);
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  cloud->GetPointData()->AddArray(radii);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("sheet");
  colors->SetNumberOfComponents(3);
  cloud->GetPointData()->SetScalars(colors);

  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(5);
  auto shake = [&](double place)
  {
    random->Next();
    return place + spacing * (random->GetValue() - 0.5);
  };
  for (int i = 0; i < NumberOfSheets; ++i)
  {
    const Sheet& sheet = Sheets[i];
    double normal[3] = { -sheet.Slope, 0.0, 1.0 };
    vtkMath::Normalize(normal);
    for (double y = -sheet.Half; y <= sheet.Half; y += spacing)
    {
      for (double x = -sheet.Half; x <= sheet.Half; x += spacing)
      {
        const double u = shake(x);
        const double place[3] = { sheet.Center[0] + u, sheet.Center[1] + shake(y),
          sheet.Center[2] + sheet.Slope * u };
        AddPoint(cloud, place, normal, 1.5 * spacing, Colors[i]);
      }
    }
  }
  auto ball = MakeSphereCloud(static_cast<int>(4.0 * vtkMath::Pi() / (spacing * spacing)));
  for (vtkIdType i = 0; i < ball->GetNumberOfPoints(); ++i)
  {
    double n[3];
    ball->GetPoint(i, n);
    const double place[3] = { 0.8 * n[0] - 0.3, 0.8 * n[1] + 0.6, 0.8 * n[2] };
    AddPoint(cloud, place, n, 1.2 * spacing, Colors[NumberOfSheets]);
  }
  return cloud;
}

/// A pixel names a point of what it shows.
void CheckSheets(const MapperClass& mapperClass, int backend)
{
  const std::string name =
    mapperClass.Name + (backend == vtkPointSurfaceMapper::CPU ? ", CPU: " : ", OpenGL: ");
  auto cloud = MakeSheets(mapperClass.FillsSmallGaps ? 0.035 : 0.07);
  auto mapper = mapperClass.Make();
  mapper->SetBackend(backend);
  mapper->SetInputData(mapperClass.MakeInput(cloud));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(Size, Size);
  window->AddRenderer(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(0.5, 0.3, 10.0);
  camera->SetViewAngle(27.0);
  renderer->ResetCameraClippingRange();
  window->Render();
  vtkNew<vtkUnsignedCharArray> picture;
  window->GetPixelData(0, 0, Size - 1, Size - 1, 0, picture);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(renderer);
  selector->SetArea(0, 0, Size - 1, Size - 1);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  selector->CaptureBuffers();

  std::array<int, NumberOfSheets + 1> seen{};
  int pure = 0;
  int wrong = 0;
  int unlikely = 0; // where colours are blended, those that name a sheet with no part in it
  int ofBack = 0;
  for (unsigned int pixel = 0; pixel < Size * Size; ++pixel)
  {
    const unsigned int position[2] = { pixel % Size, pixel / Size };
    const unsigned char* shown = picture->GetPointer(3 * pixel);
    const auto info = selector->GetPixelInformation(position);
    if (!info.Valid)
    {
      continue;
    }
    const double* own = cloud->GetPointData()->GetScalars()->GetTuple(info.AttributeID);
    auto isOwn = [&](const unsigned char* color) { return std::equal(own, own + 3, color); };
    const auto sheet = std::find_if(std::begin(Colors), std::end(Colors), isOwn) - Colors;
    ++seen[sheet];
    if (std::any_of(std::begin(Colors), std::end(Colors),
          [&](const unsigned char* color) { return std::equal(shown, shown + 3, color); }))
    {
      ++pure;
      wrong += !isOwn(shown);
    }
    else
    {
      unlikely += (own[0] == 0.0 || shown[0] == 0) && (own[1] == 0.0 || shown[1] == 0) &&
        (own[2] == 0.0 || shown[2] == 0);
    }
    if (sheet == NumberOfSheets)
    {
      double toEye[3];
      vtkMath::Subtract(camera->GetPosition(), cloud->GetPoint(info.AttributeID), toEye);
      vtkMath::Normalize(toEye);
      double normal[3];
      cloud->GetPointData()->GetNormals()->GetTuple(info.AttributeID, normal);
      ofBack += vtkMath::Dot(normal, toEye) < -0.35; // a point's disc reaches over the outline
    }
  }
  check(*std::min_element(seen.begin(), seen.end()) > 2000, name + "each sheet is seen");
  check.AtLeast(pure, 60000, name + "pixels that show one sheet");
  check(wrong == 0, name + "name a point of another sheet: " + std::to_string(wrong));
  check(unlikely == 0, name + "name a sheet that is not there: " + std::to_string(unlikely));
  check(ofBack == 0, name + "name a point of the ball's back: " + std::to_string(ofBack));
}

void CheckMapper(const MapperClass& mapperClass, int backend)
{
  Scene scene(mapperClass, backend);
  CheckSelection(scene, vtkDataObject::FIELD_ASSOCIATION_POINTS, false, "points");
  CheckSelection(scene, vtkDataObject::FIELD_ASSOCIATION_CELLS, false, "points as cells");
  for (vtkPointSurfaceMapper* mapper : { scene.Mapper.Get(), scene.OtherMapper.Get() })
  {
    mapper->SetPointIdArrayName("ids");
    mapper->SetProcessIdArrayName("processes");
  }
  CheckSelection(scene, vtkDataObject::FIELD_ASSOCIATION_POINTS, true, "ids of arrays");
  for (vtkPointSurfaceMapper* mapper : { scene.Mapper.Get(), scene.OtherMapper.Get() })
  {
    mapper->SetPointIdArrayName(nullptr);
    mapper->SetProcessIdArrayName(nullptr);
  }
  CheckPickability(scene);
  CheckPickers(scene);
  CheckCells(scene);
  CheckArraysOfCells(scene);
}
}

int TestSelection(int, char*[])
{
  for (const MapperClass& mapperClass : GetMapperClasses())
  {
    for (int backend : { vtkPointSurfaceMapper::OpenGL, vtkPointSurfaceMapper::CPU })
    {
      CheckSheets(mapperClass, backend);
      CheckMapper(mapperClass, backend);
    }
  }
  return check.GetResult();
}
