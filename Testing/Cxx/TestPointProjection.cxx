// SPDX-License-Identifier: BSD-3-Clause
// What points leave in the image that they are projected to, by both back ends: the mean of those
// that share a pixel is what plain sums in double precision say, and points outside of the viewport
// count where their discs reach into it. Of a cloud that is larger than the picture, only what may
// be in it is drawn, and nothing is missing.

#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
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
#include <limits>
#include <string>
#include <vector>

using namespace PointSurfaceTest;

namespace
{
Checks check;

constexpr int Size = 64;        // of the viewport, in pixels; a world unit is a pixel
constexpr double Camera = 50.0; // its z; it looks along -z

struct Point
{
  std::array<double, 3> Position, Normal;
  double Radius;
  std::array<double, 4> Color; // 0 to 255
};

/// Points before a parallel camera for which window coordinates are x + Size / 2, y + Size / 2.
struct Scene
{
  vtkNew<vtkPolyData> Cloud;
  vtkNew<vtkPullPushMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;

  Scene(const std::vector<Point>& points, int backend)
  {
    vtkNew<vtkPoints> positions;
    vtkNew<vtkFloatArray> normals;
    normals->SetNumberOfComponents(3);
    vtkNew<vtkFloatArray> radii;
    radii->SetName("radius");
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetNumberOfComponents(4);
    for (const Point& point : points)
    {
      positions->InsertNextPoint(point.Position.data());
      normals->InsertNextTuple(point.Normal.data());
      radii->InsertNextValue(static_cast<float>(point.Radius));
      colors->InsertNextTuple(point.Color.data());
    }
    this->Cloud->SetPoints(positions);
    this->Cloud->GetPointData()->SetNormals(normals);
    this->Cloud->GetPointData()->AddArray(radii);
    this->Cloud->GetPointData()->SetScalars(colors);
    this->Mapper->SetInputData(this->Cloud);
    this->Mapper->SetBackend(backend);
    this->Mapper->ThinPointsOff(); // each pixel is compared with the nearest one of all points
    this->Mapper->TrimOutlinesOff();
    this->Mapper->RecordPointIdsOn();
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(Size / 2);
    camera->SetPosition(0.0, 0.0, Camera);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetClippingRange(1.0, 2.0 * Camera);
  }
};

/// Up to 9 points in each of some pixels, some of them too far behind to count.
std::vector<Point> MakeCrowdedPixels()
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(7);
  auto next = [&](double from, double to)
  {
    random->Next();
    return random->GetRangeValue(from, to);
  };
  std::vector<Point> points;
  for (int i = 0; i < 4000; ++i)
  {
    Point point;
    // not at the border of a pixel, where rounding decides
    point.Position = { std::floor(next(-20.0, 20.0)) + next(0.02, 0.98),
      std::floor(next(-20.0, 20.0)) + next(0.02, 0.98), next(-2.0, 2.0) };
    point.Normal = { next(-1.0, 1.0), next(-1.0, 1.0), next(-1.0, 1.0) };
    vtkMath::Normalize(point.Normal.data());
    point.Radius = next(0.5, 2.0);
    point.Color = { std::floor(next(0.0, 256.0)), std::floor(next(0.0, 256.0)), 7.0, 255.0 };
    points.push_back(point);
  }
  return points;
}

struct Expected
{
  int Nearest = -1;
  double Count = 0.0;
  std::array<double, 3> Normal{};
  double Radius = 0.0, Depth = 0.0;
  std::array<double, 2> Center{};
  std::array<double, 4> Color{};
  bool IsClose = false; // a decision, or normals that nearly cancel
};

/// In radii: 16 where the mean one is 0.9 pixels or less, 1 where it is 1.4 or more.
double GetLargestReach(const std::vector<Point>& points)
{
  double sum = 0.0;
  for (const Point& point : points)
  {
    sum += point.Radius;
  }
  return 1.0 + 15.0 * std::min(std::max((1.4 - sum / points.size()) / 0.5, 0.0), 1.0);
}

Expected Average(const std::vector<Point>& points, const std::vector<int>& inPixel, int x, int y)
{
  Expected mean;
  auto depthOf = [&](int i) { return Camera - points[i].Position[2]; };
  mean.Nearest = *std::min_element(
    inPixel.begin(), inPixel.end(), [&](int a, int b) { return depthOf(a) < depthOf(b); });
  const auto& front = points[mean.Nearest].Normal;
  // what the plane of the nearest one falls by within a pixel, which is 1 wide, seen along z
  const double largest = GetLargestReach(points);
  const double slope = std::hypot(front[0], front[1]) / std::max(std::abs(front[2]), 1.0 / largest);
  const double radius = points[mean.Nearest].Radius;
  const double limit = depthOf(mean.Nearest) + std::min(std::max(slope, radius), largest * radius);
  for (int i : inPixel)
  {
    const Point& point = points[i];
    mean.IsClose = mean.IsClose || std::abs(depthOf(i) - limit) < 1e-4;
    if (depthOf(i) > limit)
    {
      continue;
    }
    const double alike = vtkMath::Dot(point.Normal.data(), front.data());
    mean.IsClose = mean.IsClose || std::abs(alike) < 1e-4;
    for (int k = 0; k < 3; ++k)
    {
      mean.Normal[k] += alike < 0.0 ? -point.Normal[k] : point.Normal[k];
    }
    mean.Count += 1.0;
    mean.Radius += point.Radius;
    mean.Depth += depthOf(i);
    mean.Center[0] += point.Position[0] + Size / 2 - (x + 0.5);
    mean.Center[1] += point.Position[1] + Size / 2 - (y + 0.5);
    for (int k = 0; k < 4; ++k)
    {
      mean.Color[k] += point.Color[k] / 255.0;
    }
  }
  mean.IsClose = vtkMath::Normalize(mean.Normal.data()) < 1e-2 || mean.IsClose;
  mean.Radius /= mean.Count;
  mean.Depth /= mean.Count;
  for (double& value : mean.Center)
  {
    value /= mean.Count;
  }
  for (double& value : mean.Color)
  {
    value /= mean.Count;
  }
  return mean;
}

void CheckAverages(int backend, const std::string& name)
{
  const std::vector<Point> points = MakeCrowdedPixels();
  Scene scene(points, backend);
  scene.Window->Render();
  vtkNew<vtkImageData> projected;
  check(scene.Mapper->ReadProjectedBuffer(projected), name + ": projected buffer");
  const int* extent = projected->GetExtent();
  check(extent[0] == 0 && extent[1] == Size - 1, name + ": no rim where nothing is outside");

  std::vector<std::vector<int>> pixels(Size * Size);
  for (size_t i = 0; i < points.size(); ++i)
  {
    const int x = static_cast<int>(std::floor(points[i].Position[0] + Size / 2));
    const int y = static_cast<int>(std::floor(points[i].Position[1] + Size / 2));
    pixels[y * Size + x].push_back(static_cast<int>(i));
  }
  vtkPointData* data = projected->GetPointData();
  auto differenceOf = [&](const char* array, int pixel, const double* expected)
  {
    double largest = 0.0;
    for (int k = 0; k < data->GetArray(array)->GetNumberOfComponents(); ++k)
    {
      const double difference = data->GetArray(array)->GetComponent(pixel, k) - expected[k];
      largest = std::abs(difference) <= largest ? largest : std::abs(difference);
    }
    return largest;
  };
  double worst = 0.0;
  int compared = 0;
  int averaged = 0;
  int otherIds = 0;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    if (pixels[pixel].empty())
    {
      check(data->GetArray("Radius")->GetComponent(pixel, 0) == 0.0, name + ": an empty pixel");
      continue;
    }
    const Expected mean = Average(points, pixels[pixel], pixel % Size, pixel / Size);
    if (mean.IsClose)
    {
      continue;
    }
    ++compared;
    averaged += mean.Count > 1.0;
    otherIds += data->GetArray("PointIds")->GetComponent(pixel, 0) != mean.Nearest;
    worst = std::max({ worst, differenceOf("Normals", pixel, mean.Normal.data()),
      differenceOf("Radius", pixel, &mean.Radius),
      differenceOf("Depth", pixel, &mean.Depth) / Camera,
      differenceOf("Displacement", pixel, mean.Center.data()),
      differenceOf("Colors", pixel, mean.Color.data()) });
  }
  check.AtLeast(compared, 1000, name + ": pixels compared");
  check.AtLeast(averaged, 600, name + ": pixels of several points");
  check.AtMost(worst, 1e-4, name + ": difference from the plain mean");
  check(otherIds == 0, name + ": ids are those of the nearest points");
}

/// A cloud of which most is outside of the picture, with points left out among the others.
void CheckChunks(int backend, const std::string& name)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(11);
  auto next = [&](double from, double to)
  {
    random->Next();
    return random->GetRangeValue(from, to);
  };
  constexpr int Count = 60000;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Point> points(Count);
  std::vector<int> nearest(Size * Size, -1);
  for (int i = 0; i < Count; ++i)
  {
    Point& point = points[i];
    point.Position = { std::floor(next(-300.0, 300.0)) + next(0.02, 0.98),
      std::floor(next(-300.0, 300.0)) + next(0.02, 0.98), i % 50 == 0 ? nan : next(-20.0, 20.0) };
    point.Normal = { 0.0, 0.0, 1.0 };
    point.Radius = 1.0;
    point.Color = { 255.0, 255.0, 255.0, 255.0 };
    const double x = point.Position[0] + Size / 2;
    const double y = point.Position[1] + Size / 2;
    if (x >= 0.0 && y >= 0.0 && x < Size && y < Size && !std::isnan(point.Position[2]))
    {
      int& best = nearest[static_cast<int>(y) * Size + static_cast<int>(x)];
      best = best < 0 || point.Position[2] > points[best].Position[2] ? i : best;
    }
  }
  Scene scene(points, backend);
  vtkObject::GlobalWarningDisplayOff(); // of coordinates
  scene.Window->Render();
  vtkObject::GlobalWarningDisplayOn();
  check.AtMost(
    scene.Mapper->GetLastFramePointsDrawn(), 0.25 * Count, name + ": points of the chunks in view");
  vtkNew<vtkImageData> projected;
  check(scene.Mapper->ReadProjectedBuffer(projected), name + ": projected buffer");
  int found = 0;
  int wrong = 0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      int place[3] = { x, y, 0 };
      const vtkIdType pixel = projected->ComputePointId(place);
      const double id = projected->GetPointData()->GetArray("PointIds")->GetComponent(pixel, 0);
      found += nearest[y * Size + x] >= 0;
      wrong += id != nearest[y * Size + x];
    }
  }
  check.AtLeast(found, 400, name + ": pixels with points");
  check(wrong == 0, name + ": ids of the nearest points of a large cloud");
}

/// Points to the left of the viewport and above it, none within.
void CheckRim(int backend, int supersampling, const std::string& name)
{
  constexpr double Radius = 7.0;
  std::vector<Point> points;
  for (int i = -Size; i <= Size; i += 2)
  {
    const std::array<double, 4> color = { 255.0, 255.0, 255.0, 255.0 };
    points.push_back({ { -Size / 2 - 2.0, double(i), 0.0 }, { 0.0, 0.0, 1.0 }, Radius, color });
    points.push_back({ { double(i), Size / 2 + 2.0, 0.0 }, { 0.0, 0.0, 1.0 }, Radius, color });
  }
  Scene scene(points, backend);
  scene.Mapper->SetSupersampling(supersampling);
  scene.Window->Render();
  vtkNew<vtkImageData> surface;
  check(scene.Mapper->ReadSurfaceBuffer(surface), name + ": surface buffer");
  int size[3];
  surface->GetDimensions(size);
  check(size[0] == Size && size[1] == Size && surface->GetExtent()[0] == 0,
    name + ": the surface buffer has the viewport's size");
  const int* rectangle = scene.Mapper->GetLastFrameRectangle();
  check(rectangle[0] == 0 && rectangle[2] <= Size && rectangle[1] + rectangle[3] == Size,
    name + ": the rectangle is within the viewport");

  int missing = 0;
  int tooMany = 0;
  double worstDepth = 0.0;
  vtkDataArray* depths = surface->GetPointData()->GetArray("Depth");
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const double depth = depths->GetComponent(y * Size + x, 0);
      const double outside = std::min(x + 0.5, Size - y - 0.5) + 2.0; // from the line of points
      missing += depth == 0.0 && outside < 0.7 * Radius;
      tooMany += depth != 0.0 && outside > 1.3 * Radius;
      worstDepth = std::max(worstDepth, depth == 0.0 ? 0.0 : std::abs(depth - Camera));
    }
  }
  check(missing == 0, name + ": what discs from outside cover is covered");
  check(tooMany == 0, name + ": what they do not reach is not");
  check.AtMost(worstDepth, 1e-3, name + ": depth");

  // and the picture shows it where the buffer has it
  vtkNew<vtkUnsignedCharArray> picture;
  scene.Window->GetPixelData(0, 0, Size - 1, Size - 1, 0, picture);
  int unlike = 0;
  for (int pixel = 0; pixel < Size * Size; ++pixel)
  {
    const bool drawn = picture->GetComponent(pixel, 0) > 0;
    unlike += drawn != (depths->GetComponent(pixel, 0) > 0.0);
  }
  check(unlike == 0, name + ": the picture shows the buffer");
}
}

int TestPointProjection(int, char*[])
{
  for (int backend : { vtkPullPushMapper::OpenGL, vtkPullPushMapper::CPU })
  {
    const std::string name = backend == vtkPullPushMapper::CPU ? "CPU" : "OpenGL";
    CheckAverages(backend, name);
    CheckChunks(backend, name + ", chunks");
    CheckRim(backend, 1, name + ", rim");
    CheckRim(backend, 2, name + ", rim, 2x");
  }
  return check.GetResult();
}
