// SPDX-License-Identifier: BSD-3-Clause
// vtkImageSpacePointMapper on patterns of pixels where it is plain what has to be filled, on a
// sphere that is known, and the picture of a cloud with a cylinder of triangles through it.

#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCylinderSource.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageSpacePointMapper.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkTestUtilities.h"

#include <cmath>
#include <string>
#include <vector>

using namespace PointSurfaceTest;

namespace
{
Checks check;

using Pattern = std::vector<std::string>; // rows from the lowest; '.' empty, a digit is the depth

Pattern Fill(int width, int height, char c)
{
  return Pattern(height, std::string(width, c));
}

void Draw(Pattern& pattern, int x, int y, int width, int height, char c)
{
  for (int j = y; j < y + height; ++j)
  {
    pattern[j].replace(x, width, width, c);
  }
}

int Count(const Pattern& pattern, char c)
{
  int count = 0;
  for (const std::string& row : pattern)
  {
    for (char other : row)
    {
      count += other == c;
    }
  }
  return count;
}

/// Draws a pattern, a point for each pixel; what the mapper makes of it is a pattern too.
class PatternScene
{
public:
  vtkNew<vtkImageSpacePointMapper> Mapper;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;

  explicit PatternScene(int backend)
  {
    this->Mapper->SetBackend(backend);
    this->Mapper->SetSmoothingIterations(0);
    this->Mapper->SetRadius(1.0);
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->AddRenderer(this->Renderer);
  }

  Pattern Render(const Pattern& pattern)
  {
    const int width = static_cast<int>(pattern[0].size());
    const int height = static_cast<int>(pattern.size());
    vtkNew<vtkPoints> points;
    vtkNew<vtkFloatArray> normals;
    normals->SetNumberOfComponents(3);
    for (int y = 0; y < height; ++y)
    {
      for (int x = 0; x < width; ++x)
      {
        if (pattern[y][x] != '.')
        {
          points->InsertNextPoint(x + 0.5, y + 0.5, -(pattern[y][x] - '0'));
          normals->InsertNextTuple3(0.0, 0.0, 1.0);
        }
      }
    }
    vtkNew<vtkPolyData> cloud;
    cloud->SetPoints(points);
    cloud->GetPointData()->SetNormals(normals);
    this->Mapper->SetInputData(cloud);
    this->Window->SetSize(width, height);
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(0.5 * height);
    camera->SetFocalPoint(0.5 * width, 0.5 * height, 0.0);
    camera->SetPosition(0.5 * width, 0.5 * height, 10.0);
    camera->SetClippingRange(1.0, 30.0);
    this->Window->Render();

    vtkNew<vtkImageData> buffer;
    this->Mapper->ReadSurfaceBuffer(buffer);
    Pattern result = Fill(width, height, '.');
    for (int i = 0; i < width * height; ++i)
    {
      const double depth = buffer->GetPointData()->GetArray("Depth")->GetComponent(i, 0);
      if (depth > 0.0)
      {
        result[i / width][i % width] = static_cast<char>('0' + std::lround(depth - 10.0));
      }
    }
    return result;
  }

private:
  vtkNew<vtkActor> Actor;
};

void TestPatterns(int backend)
{
  const std::string name = backend == vtkImageSpacePointMapper::CPU ? "CPU, " : "OpenGL, ";
  PatternScene scene(backend);
  vtkImageSpacePointMapper* mapper = scene.Mapper;

  const Pattern whole = Fill(40, 30, '2');
  check(scene.Render(whole) == whole, name + "a frame covered whole stays");
  check(mapper->GetLastFrameBackgroundFills() == 0 && mapper->GetLastFrameOccludedFills() == 0,
    name + "and takes no iteration");

  mapper->SetMaximumBackgroundFills(10);
  for (int hole = 1; hole <= 5; ++hole)
  {
    Pattern pattern = whole;
    Draw(pattern, 12, 9, hole, hole, '.');
    check(scene.Render(pattern) == whole, name + "a hole is filled");
    check(mapper->GetLastFrameBackgroundFills() >= (hole + 1) / 2 &&
        mapper->GetLastFrameBackgroundFills() <= std::ceil(hole * std::sqrt(2.0)),
      name + "a hole of a diameter of n pixels takes n iterations at most");
  }
  Pattern wide = whole;
  Draw(wide, 10, 4, 21, 21, '.');
  mapper->SetMaximumBackgroundFills(3);
  check(scene.Render(wide) == wide && mapper->GetLastFrameBackgroundFills() == 0,
    name + "what is wide is no hole for few iterations");
  mapper->KeepOutlinesOff();
  const Pattern partly = scene.Render(wide);
  check(mapper->GetLastFrameBackgroundFills() == 3 && Count(partly, '.') > 15 * 15,
    name + "as published it is, but for no more iterations than asked for");
  mapper->KeepOutlinesOn();
  mapper->SetMaximumBackgroundFills(1000);

  Pattern thin = Fill(40, 30, '.');
  thin[20][20] = '1'; // a lone point
  Draw(thin, 3, 5, 12, 1, '1');
  for (int i = 0; i < 10; ++i)
  {
    thin[3 + i][25 + i] = '1';
  }
  check(scene.Render(thin) == thin && mapper->GetLastFrameBackgroundFills() == 0,
    name + "what is one pixel thin does not grow");

  Pattern fingers = Fill(60, 30, '.');
  Draw(fingers, 5, 2, 12, 26, '1');
  Draw(fingers, 37, 2, 12, 26, '1');
  check(scene.Render(fingers) == fingers && mapper->GetLastFrameBackgroundFills() == 0,
    name + "a gap of 20 pixels stays, and corners do");

  // points with discs that are wider than pixels
  Pattern lone = Fill(40, 30, '.');
  lone[20][20] = '1';
  mapper->SetRadius(3.0);
  mapper->SetMaximumBackgroundFills(-1);
  check(scene.Render(lone) == lone, name + "a lone point does not grow, whatever its radius");
  const int gap = Count({ scene.Render(fingers)[15].substr(17, 20) }, '.');
  check.AtLeast(gap, 20 - 2 * 2, name + "a gap of 20 pixels, less the discs at its sides");
  mapper->SetRadius(1.0);
  mapper->SetMaximumBackgroundFills(1000);

  // as published a concave corner is filled, a pixel an iteration and more
  Pattern concave = Fill(40, 30, '.');
  Draw(concave, 5, 5, 20, 8, '1');
  Draw(concave, 5, 5, 8, 20, '1');
  mapper->SetMaximumBackgroundFills(1);
  check(scene.Render(concave) == concave && mapper->GetLastFrameBackgroundFills() == 0,
    name + "a concave outline stays");
  mapper->KeepOutlinesOff();
  const Pattern corner = scene.Render(concave);
  check(mapper->GetLastFrameBackgroundFills() == 1 &&
      Count(corner, '1') == Count(concave, '1') + 1 && corner[13][13] == '1',
    name + "as published an iteration fills one pixel of a concave corner");
  mapper->KeepOutlinesOn();

  mapper->SetMaximumBackgroundFills(-1);
  scene.Mapper->SetMaximumOccludedFills(-1);

  Pattern layers = Fill(40, 30, '9');
  Draw(layers, 5, 5, 20, 15, '1');
  const Pattern front = layers;
  layers[10][10] = '9';
  Draw(layers, 15, 12, 2, 2, '9');
  check(scene.Render(layers) == front && mapper->GetLastFrameOccludedFills() == 1,
    name + "a surface behind shows through no hole of one in front, and stays beside it");
  mapper->SetLayerDistance(8.5);
  check(scene.Render(layers) == layers && mapper->GetLastFrameOccludedFills() == 0,
    name + "layers that are nearer than the threshold are one");
  mapper->SetLayerDistance(0.0);

  mapper->SetSmoothingIterations(3);
  check(scene.Render(front) == front, name + "depths are not smoothed over an edge");
  mapper->SetSmoothingIterations(0);

  // nothing in view
  Pattern none = Fill(40, 30, '.');
  none[0][0] = '9';
  scene.Render(none);
  scene.Renderer->GetActiveCamera()->SetPosition(20.0, 15.0, -90.0);
  scene.Window->Render();
  check(mapper->GetLastFrameBackgroundFills() == 0, name + "an empty frame takes no iteration");
}

struct Scene
{
  vtkNew<vtkImageSpacePointMapper> Mapper;
  vtkNew<vtkActor> Cloud;
  vtkNew<vtkActor> Cylinder;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;

  explicit Scene(int points)
  {
    this->Mapper->SetInputData(MakeSphereCloud(points));
    this->Cloud->SetMapper(this->Mapper);
    this->Cloud->GetProperty()->SetColor(0.9, 0.7, 0.4);
    this->Cloud->GetProperty()->SetSpecular(0.4);
    this->Cloud->GetProperty()->SetSpecularPower(30.0);
    this->Cloud->GetProperty()->BackfaceCullingOn();
    this->Renderer->AddActor(this->Cloud);
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->ResetCamera();
    this->Renderer->GetActiveCamera()->Zoom(1.5);
    this->Window->Render();
  }

  void AddCylinder()
  {
    vtkNew<vtkCylinderSource> source;
    source->SetRadius(0.3);
    source->SetHeight(3.0);
    source->SetResolution(60);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    this->Cylinder->SetMapper(mapper);
    this->Cylinder->RotateX(60.0);
    this->Cylinder->RotateZ(15.0);
    this->Renderer->AddActor(this->Cylinder);
  }

  static constexpr int Size = 300;
};

/// The surface buffer of the unit sphere beside the sphere itself.
void CompareWithSphere(Scene& scene)
{
  vtkNew<vtkImageData> buffer;
  check(scene.Mapper->ReadSurfaceBuffer(buffer), "the surface buffer can be read");
  vtkDataArray* depths = buffer->GetPointData()->GetArray("Depth");
  vtkDataArray* normals = buffer->GetPointData()->GetArray("Normals");
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  const double scale = std::tan(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle()));
  double center[4] = { 0.0, 0.0, 0.0, 1.0 };
  camera->GetViewTransformMatrix()->MultiplyPoint(center, center);
  int inside = 0;
  int unfilled = 0;
  double angle = 0.0;
  double depthError = 0.0;
  for (int i = 0; i < Scene::Size * Scene::Size; ++i)
  {
    const double ray[3] = { scale * (2.0 * (i % Scene::Size + 0.5) / Scene::Size - 1.0),
      scale * (2.0 * (i / Scene::Size + 0.5) / Scene::Size - 1.0), -1.0 };
    const double a = vtkMath::Dot(ray, ray);
    const double b = vtkMath::Dot(ray, center);
    const double c = vtkMath::Dot(center, center) - 1.0;
    if (b * b < a * c + 0.02 * a) // the outline itself is a matter of the pixel's rounding
    {
      continue;
    }
    ++inside;
    const double depth = depths->GetComponent(i, 0);
    if (!(depth > 0.0))
    {
      ++unfilled;
      continue;
    }
    const double trueDepth = (b - std::sqrt(b * b - a * c)) / a;
    double normal[3];
    for (int k = 0; k < 3; ++k)
    {
      normal[k] = trueDepth * ray[k] - center[k];
    }
    angle += vtkMath::AngleBetweenVectors(normals->GetTuple3(i), normal);
    depthError += std::abs(depth - trueDepth);
  }
  check.AtLeast(inside, 40000, "pixels inside of the silhouette");
  check.AtMost(static_cast<double>(unfilled) / inside, 0.001, "share of them unfilled");
  check.AtMost(vtkMath::DegreesFromRadians(angle / inside), 0.6, "mean angle of normals, degrees");
  check.AtMost(depthError / inside, 0.0075, "mean depth error");
}
}

int TestImageSpacePointMapper(int argc, char* argv[])
{
  TestPatterns(vtkImageSpacePointMapper::OpenGL);
  TestPatterns(vtkImageSpacePointMapper::CPU);

  // the sphere has a diameter of some 250 pixels, so the points are 1.7 pixels apart
  Scene scene(70000);
  check(scene.Mapper->GetLastFramePointsDrawn() == 70000, "every point is drawn once");
  scene.Mapper->FillWithinDiscsOff();
  scene.Window->Render();
  check.AtLeast(scene.Mapper->GetLastFrameBackgroundFills(), 1, "sparse: fills by masks alone");
  scene.Mapper->FillWithinDiscsOn();
  scene.Window->Render();
  check(scene.Mapper->GetLastFrameBackgroundFills() == 0, "sparse: discs leave no hole to masks");
  CompareWithSphere(scene);
  scene.Window->Render();
  check(scene.Mapper->GetLastFrameReconstructions() == 0 &&
      scene.Mapper->GetLastFrameBackgroundFills() == 0,
    "a still frame makes no surface buffer");

  Scene dense(3000000);
  check(dense.Mapper->GetLastFrameBackgroundFills() == 0, "dense: no hole, no iteration");
  check(dense.Mapper->GetLastFrameOccludedFills() == 0, "dense: nor one of occluded pixels");

  scene.AddCylinder();
  const int result = vtkRegressionTestImage(scene.Window);
  check(result != vtkTesting::FAILED, "the picture is that of the baseline");

  scene.Mapper->AntialiasOutlineOn();
  scene.Window->Render();
  vtkNew<vtkImageData> buffer;
  scene.Mapper->ReadSurfaceBuffer(buffer);
  int partial = 0;
  for (int i = 0; i < Scene::Size * Scene::Size; ++i)
  {
    const double coverage = buffer->GetPointData()->GetArray("Coverage")->GetComponent(i, 0);
    partial += coverage > 0.0 && coverage < 0.99;
  }
  check.AtLeast(partial, 500, "pixels of the outline that blend");
  check.AtMost(partial, 1500, "and no others");
  return check.GetResult();
}
