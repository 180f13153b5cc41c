// SPDX-License-Identifier: BSD-3-Clause
// vtkPointSurfacePass: the picture of ten clouds is that of one merged cloud, though each of them
// alone is full of holes, in one reconstruction; each keeps its material, colours and transform,
// and is shaded where it may be seen, at once with those that look alike; what does not fit is
// drawn by itself. For every mapper, with both back ends.

#include "PointSurfaceTestMappers.h"
#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkHardwareSelector.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPlane.h"
#include "vtkPointSurfacePass.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkPullPushMapper.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkShaderProperty.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

using namespace PointSurfaceTest;

namespace
{
Checks check;

constexpr int Size = 200;
constexpr int NumberOfClouds = 10;
constexpr int NumberOfPoints = 8000;

using Picture = std::vector<unsigned char>;

struct Kind
{
  MapperClass Class;
  int Backend;
  bool Thorough; ///< else the cases alone that a mapper could do otherwise than another
  std::string Name;
  /// Of the depth that the direct mapper takes for one surface, a share of the diagonal of all.
  double MergedDifference = 0.001;
  double SideBySideDifference = 0.002;
};

struct Scene
{
  std::vector<vtkSmartPointer<vtkPointSurfaceMapper>> Mappers;
  std::vector<vtkSmartPointer<vtkActor>> Actors;
  vtkNew<vtkPointSurfacePass> Pass;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  const Kind& TheKind;

  Scene(const Kind& kind, bool joint)
    : TheKind(kind)
  {
    if (joint)
    {
      vtkNew<vtkRenderStepsPass> steps;
      steps->SetOpaquePass(this->Pass);
      this->Renderer->SetPass(steps);
    }
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(1.0, 2.0, 5.0);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
  }

  vtkPointSurfaceMapper* Add(vtkDataObject* cloud)
  {
    auto mapper = this->TheKind.Class.Make();
    mapper->SetBackend(this->TheKind.Backend);
    if (!this->TheKind.Class.UsesRadii)
    {
      mapper->SetRadius(std::sqrt(4.0 * vtkMath::Pi() / NumberOfPoints)); // of all clouds together
    }
    mapper->SetInputData(cloud);
    mapper->SetScalarRange(-1.0, 1.0);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    this->Mappers.push_back(mapper);
    this->Actors.push_back(actor);
    return mapper;
  }

  Picture Render()
  {
    this->Renderer->ResetCameraClippingRange();
    this->Window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Window->GetPixelData(0, 0, Size - 1, Size - 1, 0, pixels);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }

  int CountReconstructions() const
  {
    int count = 0;
    for (const auto& mapper : this->Mappers)
    {
      count += mapper->GetLastFrameReconstructions();
    }
    return count;
  }
};

/// Every tenth point of a ball, from one on; the radii are those of the whole.
vtkSmartPointer<vtkPolyData> GetPart(vtkPolyData* ball, int first, int step)
{
  auto part = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  part->GetPointData()->CopyAllocate(ball->GetPointData());
  for (vtkIdType i = first; i < ball->GetNumberOfPoints(); i += step)
  {
    part->GetPointData()->CopyData(
      ball->GetPointData(), i, points->InsertNextPoint(ball->GetPoint(i)));
  }
  part->SetPoints(points);
  return part;
}

vtkSmartPointer<vtkPolyData> MakeBall(const Kind& kind)
{
  auto ball = kind.Class.MakeInput(MakeSphereCloud(NumberOfPoints));
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  for (vtkIdType i = 0; i < NumberOfPoints; ++i)
  {
    height->InsertNextValue(static_cast<float>(ball->GetPoint(i)[1]));
  }
  ball->GetPointData()->SetScalars(height);
  return ball;
}

/// The clouds' points in one cloud, moved as the clouds are.
vtkSmartPointer<vtkPolyData> Merge(
  const std::vector<vtkSmartPointer<vtkPolyData>>& parts, const std::vector<double>& shifts)
{
  auto merged = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  merged->GetPointData()->CopyAllocate(parts[0]->GetPointData());
  for (size_t k = 0; k < parts.size(); ++k)
  {
    for (vtkIdType i = 0; i < parts[k]->GetNumberOfPoints(); ++i)
    {
      double x[3];
      parts[k]->GetPoint(i, x);
      merged->GetPointData()->CopyData(
        parts[k]->GetPointData(), i, points->InsertNextPoint(x[0] + shifts[k], x[1], x[2]));
    }
  }
  merged->SetPoints(points);
  return merged;
}

/// The share of pixels that differ by more than two grey levels.
double GetDifference(const Picture& a, const Picture& b)
{
  int different = 0;
  for (size_t i = 0; i < a.size(); i += 3)
  {
    bool differs = false;
    for (size_t k = i; k < i + 3; ++k)
    {
      differs = differs || std::abs(a[k] - b[k]) > 2;
    }
    different += differs;
  }
  return 3.0 * different / a.size();
}

void CompareWithMerged(const Kind& kind)
{
  const std::string& name = kind.Name;
  const auto ball = MakeBall(kind);
  std::vector<vtkSmartPointer<vtkPolyData>> parts;
  std::vector<double> shifts;
  for (int i = 0; i < NumberOfClouds; ++i)
  {
    parts.push_back(GetPart(ball, i, NumberOfClouds));
    shifts.push_back(i % 2 == 0 ? 0.0 : 0.4);
  }
  Scene joint(kind, true);
  Scene apart(kind, false);
  Scene merged(kind, false);
  for (int i = 0; i < NumberOfClouds; ++i)
  {
    joint.Add(parts[i]);
    apart.Add(parts[i]);
    joint.Actors[i]->SetPosition(shifts[i], 0.0, 0.0);
    apart.Actors[i]->SetPosition(shifts[i], 0.0, 0.0);
  }
  merged.Add(Merge(parts, shifts));

  auto compare = [&](const std::string& what, const std::function<void(Scene&)>& change)
  {
    for (Scene* scene : { &joint, &apart, &merged })
    {
      change(*scene);
    }
    const Picture truth = merged.Render();
    check.AtMost(GetDifference(joint.Render(), truth), kind.MergedDifference,
      name + ", " + what + ": share of pixels that differ from the merged cloud's");
    check(joint.CountReconstructions() == 1, name + ", " + what + ": one reconstruction");
    check(joint.Pass->GetLastFrameJointClouds() == NumberOfClouds,
      name + ", " + what + ": all clouds are joined");
    check(
      joint.Pass->GetLastFrameShadings() == 1, name + ", " + what + ": they are shaded at once");
    return GetDifference(apart.Render(), truth);
  };
  const double differenceApart = compare("plain",
    [](Scene& scene)
    {
      for (auto& mapper : scene.Mappers)
      {
        mapper->ScalarVisibilityOff();
      }
    });
  // of patches, which have no gaps, only those along seams
  check.AtLeast(differenceApart, kind.Class.DrawsSplats ? 0.015 : 0.05,
    name + ": the same of the clouds without the pass");
  check(apart.CountReconstructions() == NumberOfClouds, name + ": each by itself without the pass");
  compare("scalars",
    [](Scene& scene)
    {
      for (auto& mapper : scene.Mappers)
      {
        mapper->ScalarVisibilityOn();
      }
    });
  if (kind.Thorough)
  {
    compare("supersampled",
      [](Scene& scene)
      {
        for (auto& mapper : scene.Mappers)
        {
          mapper->SetSupersampling(2);
        }
      });
    compare("parallel, culled",
      [](Scene& scene)
      {
        scene.Renderer->GetActiveCamera()->ParallelProjectionOn();
        scene.Renderer->GetActiveCamera()->SetParallelScale(1.5);
        for (size_t i = 0; i < scene.Mappers.size(); ++i)
        {
          scene.Mappers[i]->SetSupersampling(1);
          scene.Actors[i]->GetProperty()->BackfaceCullingOn();
        }
      });
  }

  joint.Render();
  check(joint.CountReconstructions() == 0, name + ": a still frame reconstructs nothing");
  joint.Actors[3]->GetProperty()->SetSpecular(0.5);
  joint.Render();
  check(joint.CountReconstructions() == 0, name + ": nor does another material");
  check(joint.Pass->GetLastFrameShadings() == 3,
    name + ": those before, the one of the other material, those after it");
  joint.Actors[3]->VisibilityOff();
  joint.Render();
  check(joint.CountReconstructions() == 1 &&
      joint.Pass->GetLastFrameJointClouds() == NumberOfClouds - 1,
    name + ": a hidden cloud is left out");
  const Picture before = joint.Render();
  joint.Renderer->ReleaseGraphicsResources(joint.Window);
  check(joint.Render() == before, name + ": the same after graphics resources were released");
}

/// Two halves of a ball in perspective: of the one with large discs a part is outside of the
/// viewport, so that its image has a rim that the other's has not.
void CompareRims(const Kind& kind)
{
  const std::string& name = kind.Name;
  const auto ball = kind.Class.MakeInput(MakeSphereCloud(NumberOfPoints));
  vtkDataArray* radii = ball->GetPointData()->GetArray("radius");
  vtkNew<vtkPoints> points[2];
  std::vector<vtkSmartPointer<vtkPolyData>> halves;
  for (int half = 0; half < 2; ++half)
  {
    halves.push_back(vtkSmartPointer<vtkPolyData>::New());
    halves[half]->GetPointData()->CopyAllocate(ball->GetPointData());
  }
  for (vtkIdType i = 0; i < NumberOfPoints; ++i)
  {
    const int half = ball->GetPoint(i)[0] > 0.0;
    radii->SetTuple1(i, (1.0 + 2.0 * half) * radii->GetTuple1(i));
    halves[half]->GetPointData()->CopyData(
      ball->GetPointData(), i, points[half]->InsertNextPoint(ball->GetPoint(i)));
  }
  Scene joint(kind, true);
  Scene apart(kind, false);
  Scene merged(kind, false);
  for (int half = 0; half < 2; ++half)
  {
    halves[half]->SetPoints(points[half]);
    joint.Add(halves[half]);
    apart.Add(halves[half]);
  }
  merged.Add(Merge(halves, { 0.0, 0.0 }));
  for (Scene* scene : { &joint, &apart, &merged })
  {
    scene->Renderer->GetActiveCamera()->SetPosition(-0.6, 0.0, 6.0);
    scene->Renderer->GetActiveCamera()->SetFocalPoint(-0.6, 0.0, 0.0);
  }

  apart.Render();
  if (vtkPullPushMapper::SafeDownCast(apart.Mappers[0]))
  {
    int rims[2];
    for (int half = 0; half < 2; ++half)
    {
      vtkNew<vtkImageData> projected;
      auto* mapper = static_cast<vtkPullPushMapper*>(apart.Mappers[half].Get());
      check(mapper->ReadProjectedBuffer(projected), name + ": a buffer can be read");
      rims[half] = -projected->GetExtent()[0];
    }
    std::cout << name << ": rims of " << rims[0] << " and " << rims[1] << " pixels" << std::endl;
    check(rims[0] == 0 && rims[1] > 0, name + ": one cloud alone has a rim");
  }
  const Picture truth = merged.Render();
  check.AtMost(GetDifference(joint.Render(), truth), kind.MergedDifference,
    name + ", rims: share of pixels that differ from the merged cloud's");
  check(joint.Pass->GetLastFrameJointClouds() == 2, name + ", rims: both are joined");
}

std::array<int, 3> At(const Picture& picture, int x, int y)
{
  const size_t i = 3 * (static_cast<size_t>(y) * Size + x);
  return { picture[i], picture[i + 1], picture[i + 2] };
}

/// Two halves of a ball of different colours, one of them a tree, with a mesh, a translucent cloud
/// and one that is mapped by texture beside them.
void CheckCompany(const Kind& kind)
{
  const std::string& name = kind.Name;
  Scene scene(kind, true);
  scene.Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 8.0);
  const auto ball = MakeBall(kind);
  vtkNew<vtkMultiBlockDataSet> tree;
  for (unsigned int i = 0; i < 4; ++i)
  {
    auto part = GetPart(ball, 2 * static_cast<int>(i), 8);
    tree->SetBlock(i, part);
  }
  scene.Add(tree)->ScalarVisibilityOff();
  scene.Add(GetPart(ball, 1, 2))->ScalarVisibilityOff();
  scene.Actors[0]->GetProperty()->SetColor(1.0, 0.0, 0.0);
  scene.Actors[1]->GetProperty()->SetColor(0.0, 0.0, 1.0);
  scene.Add(ball)->ScalarVisibilityOff();
  scene.Actors[2]->SetPosition(-1.6, 0.0, 0.0);
  scene.Actors[2]->SetScale(0.5);
  scene.Actors[2]->GetProperty()->SetOpacity(0.5);
  scene.Add(ball)->InterpolateScalarsBeforeMappingOn();
  scene.Actors[3]->SetPosition(1.6, 0.0, 0.0);
  scene.Actors[3]->SetScale(0.5);
  vtkNew<vtkSphereSource> source;
  source->SetCenter(0.0, 1.6, 0.0);
  vtkNew<vtkPolyDataMapper> meshMapper;
  meshMapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> mesh;
  mesh->SetMapper(meshMapper);
  scene.Renderer->AddActor(mesh);

  const Picture picture = scene.Render();
  check(scene.Pass->GetLastFrameJointClouds() == 2, name + ": the two halves are joined");
  int red = 0;
  int blue = 0;
  for (int i = 0; i < Size * Size; ++i)
  {
    const auto rgb = At(picture, i % Size, i / Size);
    red += rgb[0] > 60 && rgb[1] == 0 && rgb[2] == 0;
    blue += rgb[2] > 60 && rgb[1] == 0 && rgb[0] == 0;
  }
  std::cout << name << ": red and blue pixels " << red << ", " << blue << std::endl;
  check(red > 1000 && blue > 1000 && red < 2 * blue && blue < 2 * red,
    name + ": each half in its own colour");
  const double scale = 0.5 * Size / (8.0 * std::tan(vtkMath::RadiansFromDegrees(15.0)));
  const int far = static_cast<int>(1.6 * scale);
  const auto background = At(picture, 2, 2);
  for (const auto& place : std::vector<std::array<int, 2>>{ { -far, 0 }, { far, 0 }, { 0, far } })
  {
    check(At(picture, Size / 2 + place[0], Size / 2 + place[1]) != background,
      name + ": what is beside the joined clouds is drawn");
  }

  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, Size - 1, Size - 1);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  selector->CaptureBuffers();
  const unsigned int middle[2] = { Size / 2, Size / 2 };
  const auto info = selector->GetPixelInformation(middle);
  check(info.Valid && (info.Prop == scene.Actors[0] || info.Prop == scene.Actors[1]),
    name + ": clouds of the pass can be selected");
}

/// Three balls side by side, each of a material of its own: the picture is that of VTK's own pass,
/// and each is shaded in its own part of it.
void CheckRectangles(const Kind& kind)
{
  const std::string& name = kind.Name;
  const auto ball = kind.Class.MakeInput(MakeSphereCloud(NumberOfPoints));
  Scene joint(kind, true);
  Scene apart(kind, false);
  for (Scene* scene : { &joint, &apart })
  {
    for (int i = 0; i < 3; ++i)
    {
      scene->Add(ball)->ScalarVisibilityOff();
      scene->Actors[i]->SetPosition(2.4 * (i - 1), 0.3 * i, 0.0);
      scene->Actors[i]->SetScale(0.8);
      scene->Actors[i]->GetProperty()->SetColor(i == 0, i == 1, i == 2);
      scene->Mappers[i]->SetRadius(0.05);
    }
    scene->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 14.0);
  }
  check.AtMost(GetDifference(joint.Render(), apart.Render()), kind.SideBySideDifference,
    name + ", side by side: share of pixels that differ from the clouds' by themselves");
  check(joint.Pass->GetLastFrameShadings() == 3, name + ": each is shaded for itself");
  for (int i = 0; i < 3; ++i)
  {
    const int* rectangle = joint.Mappers[i]->GetLastFrameRectangle();
    const int* own = apart.Mappers[i]->GetLastFrameRectangle();
    check(rectangle[2] < own[2] + 24 && rectangle[3] < own[3] + 24,
      name + ": shaded in the part where it is: " + std::to_string(rectangle[2]) + " of " +
        std::to_string(own[2]) + " columns");
  }
}

/// Balls side by side, of which one has code of a user's in its shader, one is cut by a plane, and
/// one is drawn by another mapper: each looks as by itself, and what does not fit is not joined.
void CheckWhatDoesNotFit(const Kind& kind)
{
  const std::string& name = kind.Name;
  const auto ball = kind.Class.MakeInput(MakeSphereCloud(NumberOfPoints));
  const auto classes = GetMapperClasses();
  const auto other = std::find_if(classes.begin(), classes.end(),
    [&](const MapperClass& c) { return c.UsesRadii && c.Name != kind.Class.Name; });
  Scene joint(kind, true);
  Scene apart(kind, false);
  for (Scene* scene : { &joint, &apart })
  {
    for (int i = 0; i < 4; ++i)
    {
      scene->Add(i < 3 ? ball : MakeSphereCloud(NumberOfPoints))->ScalarVisibilityOff();
      scene->Actors[i]->SetPosition(2.2 * (i - 1.5), 0.0, 0.0);
    }
    scene->Actors[1]->GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
      "//VTK::Light::Impl\n  fragOutput0.rgb = fragOutput0.bgr * vec3(0.2, 1.0, 0.2);\n", false);
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(1.1, 0.0, 0.0);
    scene->Mappers[2]->AddClippingPlane(plane);
    auto mapper = other->Make();
    mapper->SetBackend(kind.Backend);
    mapper->SetInputData(scene->Mappers[3]->GetInput());
    scene->Mappers[3] = mapper;
    scene->Actors[3]->SetMapper(mapper);
    scene->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 16.0);
  }
  check.AtMost(GetDifference(joint.Render(), apart.Render()), kind.SideBySideDifference,
    name + ", what does not fit: share of pixels that differ from the clouds' by themselves");
  check(joint.Pass->GetLastFrameJointClouds() == 2,
    name + ": one that is cut, and one of another mapper, are not joined");
  check(joint.Pass->GetLastFrameShadings() == 2, name + ": a shader of a user's is of its cloud");
}
}

int TestJointSurface(int, char*[])
{
  int count = 0;
  for (const MapperClass& mapperClass : GetMapperClasses())
  {
    // both back ends of the first mapper; the others share their way to a joint surface with it
    const bool first = count == 0;
    for (int backend : { vtkPointSurfaceMapper::OpenGL, vtkPointSurfaceMapper::CPU })
    {
      if (!first && (backend == vtkPointSurfaceMapper::CPU) != (count % 2 == 0))
      {
        continue;
      }
      Kind kind = { mapperClass, backend, first,
        mapperClass.Name + (backend == vtkPointSurfaceMapper::CPU ? ", CPU" : ", OpenGL") };
      if (!mapperClass.UsesRadii && !mapperClass.DrawsSplats)
      {
        kind.MergedDifference = 0.01;
        kind.SideBySideDifference = 0.05;
      }
      CompareWithMerged(kind);
      CompareRims(kind);
      CheckCompany(kind);
      CheckRectangles(kind);
      CheckWhatDoesNotFit(kind);
    }
    ++count;
  }
  return check.GetResult();
}
