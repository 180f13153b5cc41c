// SPDX-License-Identifier: BSD-3-Clause
// The two back ends make the same picture: over projections, sizes, colours, clipping planes,
// culling, coordinates far from the origin, points that are left out, and published or not. The CPU
// back end makes the same pixels whatever the number of threads is. The first is compared with a
// tolerance, since OpenGL implementations round in their own ways.

#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataSetAttributes.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkPullPushMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace PointSurfaceTest;

namespace
{
Checks check;

constexpr double MeanDifference = 0.2;  // grey levels of 255
constexpr double LargeDifference = 8.0; // of them
constexpr unsigned char Background[3] = { 26, 51, 77 };
constexpr double ShareOfLarge = 0.001; // of the pixels

/// A bumpy ball with a smaller one before it; scalars; the ball's points moved by `shift`.
vtkSmartPointer<vtkPolyData> MakeCloud(double shift, int dataType, int count = 30000)
{
  auto cloud = MakeSphereCloud(count);
  vtkNew<vtkPoints> points;
  points->SetDataType(dataType);
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double x[3];
    cloud->GetPoint(i, x);
    const double size = i % 3 ? 1.0 + 0.02 * std::sin(12.0 * x[1]) : 0.4;
    const double offset = i % 3 ? 0.0 : 0.9;
    height->InsertNextValue(static_cast<float>(x[1]));
    points->InsertNextPoint(
      size * x[0] + 0.3 * offset + shift, size * x[1] - 0.5 * shift, size * x[2] + offset);
  }
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(height);
  return cloud;
}

struct Scene
{
  vtkSmartPointer<vtkPolyData> Cloud = MakeCloud(0.0, VTK_FLOAT);
  vtkNew<vtkPullPushMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;

  Scene()
  {
    this->Mapper->ScalarVisibilityOff();
    this->Mapper->SetScalarRange(-1.0, 1.0);
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->SetSpecular(0.3);
    this->Renderer->AddActor(this->Actor);
    this->Renderer->SetBackground(26.0 / 255.0, 0.2, 77.0 / 255.0);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(400, 400);
    this->Window->AddRenderer(this->Renderer);
  }

  void PlaceCamera()
  {
    this->Mapper->SetInputData(this->Cloud);
    this->Renderer->ResetCamera();
    this->Renderer->GetActiveCamera()->Azimuth(25.0);
    this->Renderer->GetActiveCamera()->Elevation(10.0);
    this->Renderer->GetActiveCamera()->Zoom(1.4);
    this->Renderer->ResetCameraClippingRange();
  }

  /// The picture by a back end; empty if another one made it.
  std::vector<unsigned char> Render(int backend)
  {
    this->Mapper->SetBackend(backend);
    this->Window->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    const int* size = this->Window->GetSize();
    this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
    if (this->Mapper->GetLastFrameBackend() != backend)
    {
      return {};
    }
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }
};

double Difference(
  const std::vector<unsigned char>& a, const std::vector<unsigned char>& b, size_t i)
{
  double largest = 0.0;
  for (size_t k = 0; k < 3; ++k)
  {
    largest = std::max(largest, std::abs(double(a[3 * i + k]) - double(b[3 * i + k])));
  }
  return largest;
}

/// What a case changes in the scene, before the camera is placed and after.
using Change = std::function<void(Scene&)>;

void Compare(const std::string& name, const Change& before, const Change& after = {})
{
  Scene scene;
  before(scene);
  scene.PlaceCamera();
  if (after)
  {
    after(scene);
  }
  const auto byOpenGL = scene.Render(vtkPullPushMapper::OpenGL);
  const auto byCPU = scene.Render(vtkPullPushMapper::CPU);
  const bool ran = !byOpenGL.empty() && byOpenGL.size() == byCPU.size();
  check(ran, name + ": both back ends run");
  if (!ran)
  {
    return;
  }
  const size_t pixels = byCPU.size() / 3;
  size_t large = 0;
  size_t drawn = 0;
  double sum = 0.0;
  for (size_t i = 0; i < pixels; ++i)
  {
    const double difference = Difference(byOpenGL, byCPU, i);
    sum += difference;
    large += difference > LargeDifference;
    drawn += !std::equal(Background, Background + 3, &byCPU[3 * i]);
  }
  check.AtMost(sum / pixels, MeanDifference, name + ": mean difference");
  check.AtMost(double(large) / pixels, ShareOfLarge, name + ": share of large differences");
  check.AtLeast(double(drawn) / pixels, 0.02, name + ": share of pixels drawn");
}

void ComparePictures()
{
  Compare("perspective", [](Scene&) {});
  Compare(
    "parallel", [](Scene&) {},
    [](Scene& s) { s.Renderer->GetActiveCamera()->ParallelProjectionOn(); });
  Compare("as published",
    [](Scene& s)
    {
      s.Mapper->SetToPublished();
      s.Actor->GetProperty()->BackfaceCullingOn();
    });
  Compare("lookup table", [](Scene& s) { s.Mapper->ScalarVisibilityOn(); });
  Compare("lookup table by texture",
    [](Scene& s)
    {
      s.Mapper->ScalarVisibilityOn();
      s.Mapper->InterpolateScalarsBeforeMappingOn();
    });
  Compare("colours with an alpha",
    [](Scene& s)
    {
      vtkNew<vtkUnsignedCharArray> colors;
      colors->SetNumberOfComponents(4);
      for (vtkIdType i = 0; i < s.Cloud->GetNumberOfPoints(); ++i)
      {
        const double y = s.Cloud->GetPoint(i)[1];
        colors->InsertNextTuple4(128 + 100 * y, 100, 128 - 100 * y, 255);
      }
      s.Cloud->GetPointData()->SetScalars(colors);
      s.Mapper->ScalarVisibilityOn();
    });
  Compare("clipping planes",
    [](Scene& s)
    {
      vtkNew<vtkPlane> oblique;
      oblique->SetNormal(-1.0, 0.3, 0.2);
      s.Mapper->AddClippingPlane(oblique);
      vtkNew<vtkPlane> level;
      level->SetOrigin(0.0, -0.4, 0.0);
      level->SetNormal(0.0, 1.0, 0.0);
      s.Mapper->AddClippingPlane(level);
    });
  for (int samples = 2; samples <= 4; ++samples)
  {
    Compare("supersampled " + std::to_string(samples) + " times",
      [samples](Scene& s)
      {
        s.Mapper->ScalarVisibilityOn();
        s.Mapper->SetSupersampling(samples);
      });
  }
  Compare("pixels not blended", [](Scene& s) { s.Mapper->BlendPixelsOff(); });
  Compare("outlines not trimmed", [](Scene& s) { s.Mapper->TrimOutlinesOff(); });
  Compare(
    "thinned",
    [](Scene& s)
    {
      s.Cloud = MakeCloud(0.0, VTK_FLOAT, 190000);
      s.Window->SetSize(100, 100);
    },
    [](Scene& s)
    {
      s.Window->Render();
      check(s.Mapper->GetLastFramePointsDrawn() < 100000, "points are thinned");
    });
  Compare("back faces culled", [](Scene& s) { s.Actor->GetProperty()->BackfaceCullingOn(); });
  Compare("front faces culled", [](Scene& s) { s.Actor->GetProperty()->FrontfaceCullingOn(); });
  Compare("coordinates of 1e7", [](Scene& s) { s.Cloud = MakeCloud(1e7, VTK_DOUBLE); });
  Compare("coordinates of 1e7, clipped",
    [](Scene& s)
    {
      s.Cloud = MakeCloud(1e7, VTK_DOUBLE);
      vtkNew<vtkPlane> plane;
      plane->SetOrigin(1e7, 0.0, 0.0);
      plane->SetNormal(1.0, 0.0, 0.0);
      s.Mapper->AddClippingPlane(plane);
    });
  Compare("integer coordinates",
    [](Scene& s)
    {
      vtkNew<vtkPoints> points;
      points->SetDataType(VTK_INT);
      for (vtkIdType i = 0; i < s.Cloud->GetNumberOfPoints(); ++i)
      {
        double x[3];
        s.Cloud->GetPoint(i, x);
        points->InsertNextPoint(10000.0 * x[0], 10000.0 * x[1], 10000.0 * x[2]);
      }
      s.Cloud->SetPoints(points);
      s.Mapper->SetRadius(600.0);
    });
  Compare("one radius, an actor scaled and mirrored",
    [](Scene& s)
    {
      s.Mapper->SetRadius(0.03);
      s.Actor->SetScale(-1.0, 0.8, 1.2);
      s.Actor->RotateX(30.0);
    });
  // what is warned of is tested in TestHardInput
  vtkObject::GlobalWarningDisplayOff();
  Compare("points left out and normals unknown",
    [](Scene& s)
    {
      s.Cloud->GetPoints()->SetPoint(7, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
      for (vtkIdType i = 0; i < s.Cloud->GetNumberOfPoints(); i += 5)
      {
        s.Cloud->GetPointData()->GetNormals()->SetTuple3(i, 0.0, 0.0, 0.0);
      }
    });
  Compare(
    "normals unknown, parallel", [](Scene& s) { s.Cloud->GetPointData()->GetNormals()->Fill(0.0); },
    [](Scene& s) { s.Renderer->GetActiveCamera()->ParallelProjectionOn(); });
  vtkObject::GlobalWarningDisplayOn();
  Compare(
    "within the cloud", [](Scene&) {},
    [](Scene& s)
    {
      s.Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 0.2);
      s.Renderer->GetActiveCamera()->SetFocalPoint(1.0, 0.0, 0.0);
      s.Renderer->ResetCameraClippingRange();
    });
  for (const auto& size : { std::array<int, 2>{ 401, 173 }, { 97, 500 }, { 640, 31 } })
  {
    Compare(std::to_string(size[0]) + " x " + std::to_string(size[1]),
      [size](Scene& s) { s.Window->SetSize(size[0], size[1]); });
  }
  Compare("a viewport off the origin",
    [](Scene& s)
    {
      s.Window->SetSize(501, 403);
      s.Renderer->SetViewport(0.25, 0.3, 0.95, 1.0);
    });
}

void CompareThreads()
{
  Scene scene;
  scene.Mapper->ScalarVisibilityOn();
  scene.Mapper->RecordPointIdsOn();
  scene.PlaceCamera();
  const bool same = IsSameForAnyThreads(
    [&]()
    {
      scene.Mapper->Modified(); // or the buffer of the last frame holds
      scene.Render(vtkPullPushMapper::CPU);
      check(scene.Mapper->GetLastFrameReconstructions() == 1, "a frame makes a buffer of its own");
      vtkNew<vtkImageData> buffer;
      scene.Mapper->ReadSurfaceBuffer(buffer);
      std::vector<vtkSmartPointer<vtkDataArray>> arrays;
      for (const char* name : { "Normals", "Depth", "Colors", "PointIds" })
      {
        arrays.emplace_back(buffer->GetPointData()->GetArray(name));
        const double* range = arrays.back()->GetRange();
        check(range[1] > range[0], std::string(name) + " are not all the same");
      }
      return arrays;
    });
  check(same, "the CPU back end makes the same on any number of threads");
}

/// The rectangle is that of a ball's bounding box, twice what it covers: bands of rows leave most
/// of the rest out.
void CheckShadedPixels()
{
  Scene scene;
  scene.PlaceCamera();
  for (int supersampling : { 1, 3 })
  {
    scene.Mapper->SetSupersampling(supersampling);
    scene.Render(vtkPullPushMapper::OpenGL);
    const int* rectangle = scene.Mapper->GetLastFrameRectangle();
    check(scene.Mapper->GetLastFramePixelsShaded() == vtkIdType(rectangle[2]) * rectangle[3],
      "OpenGL shades the rectangle");
    scene.Render(vtkPullPushMapper::CPU);
    vtkNew<vtkImageData> buffer;
    scene.Mapper->ReadSurfaceBuffer(buffer);
    vtkDataArray* depth = buffer->GetPointData()->GetArray("Depth");
    vtkIdType covered = 0;
    for (vtkIdType i = 0; i < depth->GetNumberOfTuples(); ++i)
    {
      covered += depth->GetTuple1(i) > 0.0 ? 1 : 0;
    }
    const vtkIdType shaded = scene.Mapper->GetLastFramePixelsShaded();
    check(covered > 50000 && covered <= shaded && shaded < 1.05 * covered,
      "the CPU shades " + std::to_string(shaded) + " pixels, little more than the " +
        std::to_string(covered) + " with a surface");
    scene.Window->Render();
    check(scene.Mapper->GetLastFrameReconstructions() == 0 &&
        scene.Mapper->GetLastFramePixelsShaded() == shaded,
      "and so does a still frame");
  }
}

void CheckShortColors()
{
  for (int backend : { vtkPullPushMapper::OpenGL, vtkPullPushMapper::CPU })
  {
    Scene scene;
    vtkNew<vtkFloatArray> few;
    few->SetName("few");
    few->InsertNextValue(0.5f);
    scene.Cloud->GetPointData()->SetScalars(few);
    scene.Mapper->ScalarVisibilityOn();
    scene.PlaceCamera();
    const Messages messages(scene.Mapper);
    const bool drawn = !scene.Render(backend).empty();
    check(drawn && messages.Contain("1 colours for 30000 points"),
      "colours that are too few are warned of and not used");
  }
}

/// What is chosen, what a frame reports, and what makes a new buffer.
void CheckChoice()
{
  Scene scene;
  scene.PlaceCamera();
  check(scene.Mapper->GetBackend() == vtkPullPushMapper::Automatic, "Automatic is the default");
  check(scene.Mapper->GetLastFrameBackend() == vtkPullPushMapper::Automatic, "none before a frame");
  scene.Window->Render();
  const std::string capabilities = scene.Window->ReportCapabilities();
  const bool software = capabilities.find("llvmpipe") != std::string::npos ||
    capabilities.find("softpipe") != std::string::npos;
  const int expected = software ? vtkPullPushMapper::CPU : vtkPullPushMapper::OpenGL;
  check(scene.Mapper->GetLastFrameBackend() == expected, "the context chooses the back end");

  scene.Render(vtkPullPushMapper::CPU);
  check(scene.Mapper->GetLastFrameProjectMilliseconds() > 0.0 &&
      scene.Mapper->GetLastFrameReconstructMilliseconds() > 0.0 &&
      scene.Mapper->GetLastFrameShadeMilliseconds() > 0.0,
    "each stage takes time on the CPU back end");
  check(scene.Mapper->GetLastFramePointsDrawn() == 30000 && scene.Mapper->GetLastFrameLevels() > 1,
    "points and levels are counted");
  scene.Window->Render();
  check(scene.Mapper->GetLastFrameReconstructions() == 0 &&
      scene.Mapper->GetLastFrameProjectMilliseconds() == 0.0,
    "a still frame makes nothing");
}

/// Whatever changes in the input is seen, by both back ends.
void CheckChanges(int backend, const std::string& name)
{
  Scene scene;
  scene.PlaceCamera();
  auto last = scene.Render(backend);
  auto isSeen = [&](const std::string& what)
  {
    scene.Cloud->Modified();
    auto next = scene.Render(backend);
    check(scene.Mapper->GetLastFrameReconstructions() == 1 && next != last,
      name + ": " + what + " are seen");
    last = next;
  };
  vtkPoints* points = scene.Cloud->GetPoints();
  vtkPointData* data = scene.Cloud->GetPointData();
  const vtkIdType count = points->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double* x = points->GetPoint(i);
    points->SetPoint(i, 0.8 * x[0], 0.8 * x[1], 0.8 * x[2]);
  }
  points->Modified();
  isSeen("moved points");
  vtkDataArray* normals = data->GetNormals();
  for (vtkIdType i = 0; i < count; ++i)
  {
    normals->SetTuple3(i, 0.6, 0.0, 0.8);
  }
  normals->Modified();
  isSeen("turned normals");
  scene.Mapper->SetRadius(0.2);
  isSeen("larger radii");
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(count);
  ghosts->Fill(0.0);
  for (vtkIdType i = 0; i < count / 2; ++i)
  {
    ghosts->SetValue(i, vtkDataSetAttributes::HIDDENPOINT);
  }
  data->AddArray(ghosts);
  isSeen("hidden points");
  ghosts->Fill(0.0);
  ghosts->Modified();
  isSeen("points that are hidden no more");
}

/// A cloud that shrinks leaves nothing of itself behind.
void CheckShrinking(int backend, const std::string& name)
{
  Scene scene;
  scene.Mapper->SetRadius(0.05);
  scene.PlaceCamera();
  scene.Render(backend);
  Scene fresh;
  fresh.Mapper->SetRadius(0.05);
  fresh.PlaceCamera();
  for (Scene* s : { &scene, &fresh })
  {
    s->Actor->SetScale(0.3);
    s->Actor->SetPosition(0.31, 0.17, 0.0);
  }
  check(scene.Render(backend) == fresh.Render(backend),
    name + ": a shrunk cloud looks as one that was never larger");
}

/// The factor on radii does what larger radii do.
void CheckRadiusScale(int backend, const std::string& name)
{
  Scene scene;
  scene.Mapper->SetRadius(0.04);
  scene.PlaceCamera();
  const auto small = scene.Render(backend);
  scene.Mapper->SetRadiusScale(2.0);
  const auto scaled = scene.Render(backend);
  scene.Mapper->SetRadiusScale(1.0);
  scene.Mapper->SetRadius(0.08);
  check(scaled == scene.Render(backend) && scaled != small,
    name + ": RadiusScale is a factor on radii");
}
}

int TestBackends(int, char*[])
{
  ComparePictures();
  CompareThreads();
  CheckShadedPixels();
  CheckShortColors();
  CheckChoice();
  for (int backend : { vtkPullPushMapper::OpenGL, vtkPullPushMapper::CPU })
  {
    const std::string name = backend == vtkPullPushMapper::CPU ? "CPU" : "OpenGL";
    CheckChanges(backend, name);
    CheckShrinking(backend, name);
    CheckRadiusScale(backend, name);
  }
  return check.GetResult();
}
