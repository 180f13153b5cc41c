// SPDX-License-Identifier: BSD-3-Clause
// The image-space passes over points and meshes: beside the double-precision reference, by what
// they must leave alone, by lines that are known, in chains with VTK's own passes; and a picture of
// each pass in a viewport of its own.

#include "ImageSpaceReference.h"
#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkBackgroundFillPass.h"
#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkCubeSource.h"
#include "vtkDepthAntialiasingPass.h"
#include "vtkEDLShading.h"
#include "vtkFeatureLinePass.h"
#include "vtkFloatArray.h"
#include "vtkImageSpacePass.h"
#include "vtkLightsPass.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOccludedFillPass.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLFXAAPass.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderPass.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSSAOPass.h"
#include "vtkSequencePass.h"
#include "vtkSilhouettePass.h"
#include "vtkSphereSource.h"
#include "vtkSurfaceSmoothingPass.h"
#include "vtkTestUtilities.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <GL/gl.h>

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

using Passes = std::vector<vtkImageProcessingPass*>; // from the innermost on

/// Lights and opaque props, then the passes, with the camera inside of the first of VTK's own,
/// which need it so, else outside of all.
vtkSmartPointer<vtkRenderPass> MakeChain(const Passes& passes)
{
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  vtkNew<vtkRenderPassCollection> collection;
  collection->AddItem(lights);
  collection->AddItem(opaque);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(collection);
  vtkSmartPointer<vtkRenderPass> chain = sequence;
  vtkNew<vtkCameraPass> camera;
  auto addCamera = [&]
  {
    if (!camera->GetDelegatePass())
    {
      camera->SetDelegatePass(chain);
      chain = camera;
    }
  };
  for (vtkImageProcessingPass* pass : passes)
  {
    if (!vtkImageSpacePass::SafeDownCast(pass))
    {
      addCamera();
    }
    pass->SetDelegatePass(chain);
    chain = pass;
  }
  addCamera();
  return chain;
}

vtkSmartPointer<vtkActor> MakeActor(vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.9, 0.7, 0.4);
  return actor;
}

vtkSmartPointer<vtkActor> MakeSphere(int resolution, double radius = 1.0)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(radius);
  sphere->SetThetaResolution(2 * resolution);
  sphere->SetPhiResolution(resolution);
  sphere->Update();
  return MakeActor(sphere->GetOutput());
}

/// A sphere and another one inside of it, as points with vertex cells, each drawn as a pixel.
void AddPoints(vtkRenderer* renderer, int count)
{
  for (double size : { 1.0, 0.7 })
  {
    vtkSmartPointer<vtkPolyData> cloud = MakeSphereCloud(count);
    cloud->AllocateExact(1, count);
    std::vector<vtkIdType> ids(count);
    for (int i = 0; i < count; ++i)
    {
      ids[i] = i;
    }
    cloud->InsertNextCell(VTK_POLY_VERTEX, count, ids.data());
    vtkSmartPointer<vtkActor> actor = MakeActor(cloud);
    actor->SetScale(size);
    actor->GetProperty()->BackfaceCullingOn();
    if (size < 1.0)
    {
      actor->GetProperty()->SetColor(0.2, 0.4, 0.9);
    }
    renderer->AddActor(actor);
  }
}

void AddCube(vtkRenderer* renderer)
{
  vtkNew<vtkCubeSource> cube;
  cube->Update();
  vtkSmartPointer<vtkActor> actor = MakeActor(cube->GetOutput());
  actor->RotateX(30.0);
  actor->RotateY(40.0);
  renderer->AddActor(actor);
}

/// A renderer in a part of a window, and what is to be seen in it.
struct View
{
  vtkNew<vtkRenderer> Renderer;
  int X = 0, Y = 0, Width, Height;
  std::array<double, 3> Eye{}; // in world coordinates, as of the next
  std::array<double, 3> Direction{};
  vtkNew<vtkRenderWindow> Window;

  View(int width, int height)
    : Width(width)
    , Height(height)
  {
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(width, height);
    this->Renderer->SetBackground(0.2, 0.3, 0.4);
    this->Window->AddRenderer(this->Renderer);
  }

  /// Moves the view off the window's origin.
  void MoveTo(int x, int y)
  {
    this->X = x;
    this->Y = y;
    const double width = this->Width + x;
    const double height = this->Height + y;
    this->Window->SetSize(this->Width + x, this->Height + y);
    this->Renderer->SetViewport(x / width, y / height, 1.0, 1.0);
  }

  ~View()
  {
    if (this->Renderer->GetPass())
    {
      this->Renderer->GetPass()->ReleaseGraphicsResources(this->Window);
    }
  }

  void Render(const Passes& passes)
  {
    if (this->Renderer->GetPass())
    {
      this->Renderer->GetPass()->ReleaseGraphicsResources(this->Window);
    }
    vtkSmartPointer<vtkRenderPass> chain = MakeChain(passes);
    this->Renderer->SetPass(passes.empty() ? nullptr : chain.Get());
    this->Window->Render();
    check(glGetError() == GL_NO_ERROR, "no OpenGL error");
  }

  std::vector<double> ReadColors()
  {
    vtkNew<vtkUnsignedCharArray> colors;
    this->Window->GetPixelData(
      this->X, this->Y, this->X + this->Width - 1, this->Y + this->Height - 1, 0, colors);
    return std::vector<double>(colors->GetPointer(0), colors->GetPointer(0) + colors->GetSize());
  }

  std::vector<float> ReadWindowDepths()
  {
    vtkNew<vtkFloatArray> depths;
    this->Window->GetZbufferData(
      this->X, this->Y, this->X + this->Width - 1, this->Y + this->Height - 1, depths);
    return std::vector<float>(
      depths->GetPointer(0), depths->GetPointer(0) + depths->GetNumberOfValues());
  }

  /// Distances from the eye along the direction of view, in world units; 0 for the background.
  std::vector<double> ReadDistances()
  {
    const std::vector<float> depths = this->ReadWindowDepths();
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    vtkNew<vtkMatrix4x4> toWorld;
    vtkMatrix4x4::Invert(camera->GetCompositeProjectionTransformMatrix(
                           this->Renderer->GetTiledAspectRatio(), -1.0, 1.0),
      toWorld);
    std::vector<double> distances(depths.size(), 0.0);
    for (int i = 0; i < this->Width * this->Height; ++i)
    {
      if (depths[i] >= 1.0f)
      {
        continue;
      }
      double p[4] = { 2.0 * (i % this->Width + 0.5) / this->Width - 1.0,
        2.0 * (i / this->Width + 0.5) / this->Height - 1.0, 2.0 * depths[i] - 1.0, 1.0 };
      toWorld->MultiplyPoint(p, p);
      for (int k = 0; k < 3; ++k)
      {
        distances[i] += (p[k] / p[3] - this->Eye[k]) * this->Direction[k];
      }
    }
    return distances;
  }

  ImageSpaceReference Read()
  {
    ImageSpaceReference image(this->Width, this->Height);
    const std::vector<double> colors = this->ReadColors();
    const std::vector<double> distances = this->ReadDistances();
    for (int i = 0; i < this->Width * this->Height; ++i)
    {
      auto& pixel = image.At(i % this->Width, i / this->Width);
      pixel.Depth = distances[i];
      std::copy_n(&colors[3 * i], 3, pixel.Color.begin());
    }
    return image;
  }
};

/// The pixels of a view beside those of the reference; close calls apart.
void Compare(View& view, ImageSpaceReference& expected, const std::string& name)
{
  ImageSpaceReference actual = view.Read();
  int covered = 0;
  int close = 0;
  int differing = 0;
  double worstColor = 0.0;
  double worstDepth = 0.0;
  for (int i = 0; i < view.Width * view.Height; ++i)
  {
    const auto& a = actual.At(i % view.Width, i / view.Width);
    const auto& e = expected.At(i % view.Width, i / view.Width);
    if (e.NearDecision)
    {
      ++close;
      continue;
    }
    if ((a.Depth > 0.0) != (e.Depth > 0.0))
    {
      ++differing;
      continue;
    }
    covered += e.Depth > 0.0;
    worstDepth = std::max(worstDepth, std::abs(a.Depth - e.Depth));
    for (int k = 0; k < 3; ++k)
    {
      worstColor = std::max(worstColor, std::abs(a.Color[k] - e.Color[k]));
    }
  }
  std::cout << name << ": " << close << " pixels near a decision\n";
  check.AtLeast(covered, 0.2 * view.Width * view.Height, name + ": covered pixels");
  check.AtMost(differing, 0.0, name + ": pixels that are covered in one alone");
  check.AtMost(close, 0.01 * covered, name + ": pixels near a decision");
  check.AtMost(worstDepth, 1e-4, name + ": largest difference in depth");
  check.AtMost(worstColor, 1.0, name + ": largest difference in colour, grey levels");
}

/// A camera, set up from that of ResetCamera().
struct CameraKind
{
  const char* Name;
  std::function<void(View&)> SetUp;
};

void SetEye(View& view)
{
  vtkCamera* camera = view.Renderer->GetActiveCamera();
  camera->GetPosition(view.Eye.data());
  camera->GetDirectionOfProjection(view.Direction.data());
}

void LookInParallel(View& view)
{
  view.Renderer->GetActiveCamera()->ParallelProjectionOn();
  SetEye(view);
}

/// From amid the spheres, with the near plane behind the camera.
void LookFromWithin(View& view)
{
  LookInParallel(view);
  vtkCamera* camera = view.Renderer->GetActiveCamera();
  camera->SetPosition(0.0, 0.0, 0.0);
  camera->SetFocalPoint(0.0, 0.0, -1.0);
  camera->SetClippingRange(-2.0, 3.0);
  view.Eye = { 0.0, 0.0, 10.0 };
}

vtkSmartPointer<vtkTransform> MakeShear()
{
  const double matrix[16] = { 1, 0.3, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  auto transform = vtkSmartPointer<vtkTransform>::New();
  transform->SetMatrix(matrix);
  return transform;
}

void ShearPicture(View& view)
{
  view.Renderer->GetActiveCamera()->SetUserTransform(MakeShear());
  SetEye(view);
}

/// The view is sheared so that depth depends on what is across it.
void ShearView(View& view)
{
  const double matrix[16] = { 1, 0.3, 0, 0, 0, 1, 0, 0, 0.2, 0, 1, 0, 0, 0, 0, 1 };
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(matrix);
  view.Renderer->GetActiveCamera()->SetUserViewTransform(transform);
  SetEye(view);
  view.Direction = { -0.2 / std::hypot(1.0, 0.2), 0.0, -1.0 / std::hypot(1.0, 0.2) };
}

/// A screen beside the eye, and turned. Both are in view coordinates, whose origin is ten behind.
void LookThroughScreen(View& view)
{
  const double screen[3][3] = { { -1.3, -1.5, -11.0 }, { 1.4, -1.4, -11.8 }, { 1.3, 1.2, -12.0 } };
  double eye[3] = { 0.4, 0.2, -6.0 };
  vtkCamera* camera = view.Renderer->GetActiveCamera();
  camera->SetEyePosition(eye);
  camera->SetEyeSeparation(0.0);
  camera->UseOffAxisProjectionOn();
  camera->SetScreenBottomLeft(screen[0][0], screen[0][1], screen[0][2]);
  camera->SetScreenBottomRight(screen[1][0], screen[1][1], screen[1][2]);
  camera->SetScreenTopRight(screen[2][0], screen[2][1], screen[2][2]);
  camera->SetPosition(0.0, 0.0, 10.0);
  camera->SetFocalPoint(0.0, 0.0, -490.0); // the near plane is a thousandth of that away
  double sides[2][3];
  for (int i = 0; i < 2; ++i)
  {
    vtkMath::Subtract(screen[i + 1], screen[i], sides[i]);
  }
  vtkMath::Cross(sides[1], sides[0], view.Direction.data());
  vtkMath::Normalize(view.Direction.data());
  view.Eye = { eye[0], eye[1], eye[2] + 10.0 };
}

void TestAgainstReference(const CameraKind& camera, bool offOrigin)
{
  const std::string name = std::string(camera.Name) + (offOrigin ? ", off the origin: " : ": ");
  View view(200, 180);
  if (offOrigin)
  {
    view.MoveTo(37, 51);
  }
  AddPoints(view.Renderer, 40000);
  view.Renderer->ResetCamera();
  camera.SetUp(view);
  view.Renderer->GetActiveCamera()->Zoom(1.4);

  vtkNew<vtkBackgroundFillPass> fill;
  vtkNew<vtkOccludedFillPass> occluded;
  vtkNew<vtkSurfaceSmoothingPass> smooth;
  vtkNew<vtkDepthAntialiasingPass> antialias;
  occluded->SetLayerDistance(0.1);
  smooth->SetLayerDistance(0.1);
  antialias->SetThreshold(0.1);

  view.Render({});
  ImageSpaceReference reference = view.Read();
  view.Render({ fill });
  const int fills = reference.FillBackground(8, 4);
  check(fills > 0 && fill->GetLastFrameIterations() == fills, name + "as many background fills");
  Compare(view, reference, name + "background fill");

  const int hidden = reference.FillOccluded(8, 0.1, 4);
  view.Render({ fill, occluded });
  check(hidden > 0 && occluded->GetLastFrameIterations() == hidden, name + "as many hidden fills");
  Compare(view, reference, name + "occluded fill");

  // the reference goes on from what has been rounded to bytes
  reference = view.Read();
  view.Render({ fill, occluded, smooth });
  ImageSpaceReference smoothed = reference;
  smoothed.Smooth({ 16.0, 2.0, 1.0 }, 0.1);
  Compare(view, smoothed, name + "smoothing");

  view.Render({ fill, occluded, antialias });
  ImageSpaceReference blended = reference;
  int edges = 0;
  for (int y = 0; y < view.Height; ++y)
  {
    for (int x = 0; x < view.Width; ++x)
    {
      const double laplace = std::abs(reference.Laplace(x, y));
      blended.At(x, y).NearDecision = std::abs(laplace - 0.1) < 1e-4;
      if (laplace > 0.1)
      {
        ++edges;
        blended.At(x, y).Color = reference.Blend(x, y);
      }
    }
  }
  check.AtLeast(edges, 400, name + "pixels on edges");
  Compare(view, blended, name + "anti-aliasing");
}

/// Passes that find nothing to do leave each bit of colours and depths as it was.
void TestNothingToDo(bool parallel, bool offOrigin)
{
  View view(160, 120);
  if (offOrigin)
  {
    view.MoveTo(20, 30);
  }
  view.Renderer->AddActor(MakeSphere(40));
  view.Renderer->ResetCamera();
  view.Renderer->GetActiveCamera()->SetParallelProjection(parallel);
  view.Render({});
  const std::vector<double> colors = view.ReadColors();
  const std::vector<float> depths = view.ReadWindowDepths();
  vtkNew<vtkBackgroundFillPass> fill;
  vtkNew<vtkOccludedFillPass> occluded;
  vtkNew<vtkFeatureLinePass> lines;
  view.Render({ fill, occluded, lines });
  check(fill->GetLastFrameIterations() == 0 && occluded->GetLastFrameIterations() == 0,
    "a mesh has no holes to fill");
  check(view.ReadColors() == colors, "and keeps its colours, a smooth one without feature lines");
  const std::vector<float> after = view.ReadWindowDepths();
  double worst = 0.0;
  for (size_t i = 0; i < depths.size(); ++i)
  {
    worst = std::max<double>(worst, std::abs(after[i] - depths[i]));
  }
  // elsewhere in a window a rasteriser may round otherwise
  check.AtMost(worst, offOrigin ? 1e-5 : 1.2e-7, "and its window depths, to the last of 24 bits");
}

int CountDifferent(const std::vector<double>& a, const std::vector<double>& b)
{
  int count = 0;
  for (size_t i = 0; i < a.size(); i += 3)
  {
    count +=
      std::abs(a[i] - b[i]) + std::abs(a[i + 1] - b[i + 1]) + std::abs(a[i + 2] - b[i + 2]) > 6.0;
  }
  return count;
}

int CountCovered(View& view)
{
  const std::vector<float> depths = view.ReadWindowDepths();
  return static_cast<int>(
    std::count_if(depths.begin(), depths.end(), [](float depth) { return depth < 1.0f; }));
}

/// Nothing drawn, or all of the frame covered by one surface: nothing to do for any pass.
void TestUniformFrames()
{
  vtkNew<vtkBackgroundFillPass> fill;
  vtkNew<vtkOccludedFillPass> occluded;
  vtkNew<vtkSurfaceSmoothingPass> smooth;
  vtkNew<vtkDepthAntialiasingPass> antialias;
  vtkNew<vtkSilhouettePass> silhouettes;
  vtkNew<vtkFeatureLinePass> lines;
  const Passes all = { fill, occluded, smooth, antialias, silhouettes, lines };
  View empty(50, 40);
  empty.Renderer->ResetCamera();
  View whole(50, 40);
  AddCube(whole.Renderer);
  whole.Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 1.2);
  whole.Renderer->GetActiveCamera()->SetViewAngle(2.0);
  whole.Renderer->GetActiveCamera()->SetClippingRange(0.01, 3.0);
  for (View* view : { &empty, &whole })
  {
    view->Render({});
    const std::vector<double> plain = view->ReadColors();
    check(CountCovered(*view) == (view == &empty ? 0 : 2000), "the frame is empty, or covered");
    view->Render(all);
    check.AtMost(CountDifferent(plain, view->ReadColors()), 0, "a uniform frame: pixels changed");
    check(fill->GetLastFrameIterations() == 0 && occluded->GetLastFrameIterations() == 0,
      "and no iteration");
  }
}

/// Share of the pixels for which `wanted` holds that are of a line, black on what is brighter.
struct LineCount
{
  double Inside = 0.0;  ///< darkness summed where lines are expected
  double Outside = 0.0; ///< and elsewhere
};

LineCount CountLines(
  View& view, const std::vector<double>& plain, const std::function<bool(double, double)>& expected)
{
  const std::vector<double> colors = view.ReadColors();
  LineCount count;
  for (int i = 0; i < view.Width * view.Height; ++i)
  {
    // the colour is the plain one mixed with black
    const double dark = 1.0 - colors[3 * i + 1] / std::max(plain[3 * i + 1], 1.0);
    (expected(i % view.Width + 0.5, i / view.Width + 0.5) ? count.Inside : count.Outside) += dark;
  }
  return count;
}

void TestLines()
{
  // a circle of a known radius in pixels
  View view(240, 240);
  view.Renderer->SetBackground(0.6, 0.7, 0.8);
  view.Renderer->AddActor(MakeSphere(120));
  view.Renderer->ResetCamera();
  view.Renderer->GetActiveCamera()->ParallelProjectionOn();
  view.Renderer->GetActiveCamera()->SetParallelScale(1.2);
  view.Render({});
  const std::vector<double> plain = view.ReadColors();
  auto isNearCircle = [](double x, double y)
  { return std::abs(std::hypot(x - 120.0, y - 120.0) - 100.0) < 5.0; };
  for (double thickness : { 1.0, 2.0, 5.0 })
  {
    vtkNew<vtkSilhouettePass> silhouettes;
    silhouettes->SetThickness(thickness);
    view.Render({ silhouettes });
    const LineCount count = CountLines(view, plain, isNearCircle);
    // pixels in a chain of squares along a circle: 8/pi of its radius or more, by the corners
    const double length = 4.0 * std::sqrt(2.0) * 100.0;
    check.AtLeast(count.Inside, 0.85 * thickness * length, "silhouette: area of the line");
    check.AtMost(count.Inside, 1.25 * thickness * length, "silhouette: area of the line");
    check.AtMost(count.Outside, 1.0, "silhouette: lines where there is no edge");
  }

  // normals come from the mapper: this sphere has facets, and interpolated normals
  View coarse(240, 240);
  coarse.Renderer->AddActor(MakeSphere(9));
  coarse.Renderer->ResetCamera();
  coarse.Render({});
  const std::vector<double> coarsePlain = coarse.ReadColors();
  vtkNew<vtkFeatureLinePass> lines;
  lines->SetThreshold(0.95);
  vtkNew<vtkSilhouettePass> inner;
  inner->SetColor(1.0, 1.0, 1.0);
  auto isCentral = [](double x, double y) { return std::hypot(x - 120.0, y - 120.0) < 60.0; };
  coarse.Render({ lines });
  check.AtMost(CountLines(coarse, coarsePlain, isCentral).Inside, 1.0,
    "feature lines on a smooth-shaded mesh");
  coarse.Render({ inner, lines });
  check.AtMost(CountLines(coarse, coarsePlain, isCentral).Inside, 1.0,
    "feature lines on a smooth-shaded mesh, through another pass");
  vtkNew<vtkEDLShading> edl; // hands no normals on
  coarse.Render({ edl });
  const std::vector<double> edlPlain = coarse.ReadColors();
  coarse.Render({ edl, lines });
  check.AtLeast(CountLines(coarse, edlPlain, isCentral).Inside, 100.0,
    "feature lines by normals from depths: those of the facets");

  // a cube: its edges, sharp
  View cube(240, 240);
  AddCube(cube.Renderer);
  cube.Renderer->ResetCamera();
  cube.Renderer->GetActiveCamera()->Zoom(1.4);
  cube.Render({});
  const std::vector<double> cubePlain = cube.ReadColors();
  vtkNew<vtkFeatureLinePass> edges;
  cube.Render({ edges });
  const LineCount count = CountLines(cube, cubePlain, [](double, double) { return true; });
  check.AtLeast(count.Inside, 300.0, "feature lines of a cube: area");
  check.AtMost(count.Inside, 900.0, "feature lines of a cube: area");
}

/// Draws what the renderer would without a pass, its own FXAA among that, as hosts do.
class RendererPass : public vtkRenderPass
{
public:
  static RendererPass* New();
  vtkTypeMacro(RendererPass, vtkRenderPass);

  void Render(const vtkRenderState* s) override
  {
    this->ClearLights(s->GetRenderer());
    this->UpdateLightGeometry(s->GetRenderer());
    this->UpdateLights(s->GetRenderer());
    this->UpdateGeometry(s->GetRenderer(), s->GetFrameBuffer());
  }
};
vtkStandardNewMacro(RendererPass);

/// FXAA that the renderer is asked for is done to the lines, and not to what they are drawn by.
void TestRendererFXAA()
{
  View cube(240, 240);
  AddCube(cube.Renderer);
  cube.Renderer->ResetCamera();
  cube.Renderer->GetActiveCamera()->Zoom(1.4);
  cube.Render({});
  const std::vector<double> plain = cube.ReadColors();
  vtkNew<RendererPass> all;
  vtkNew<vtkFeatureLinePass> edges;
  edges->SetDelegatePass(all);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(edges);
  cube.Renderer->SetPass(camera);
  auto countLines = [&]
  { return CountLines(cube, plain, [](double, double) { return true; }).Inside; };
  cube.Window->Render();
  const double sharp = countLines();
  const std::vector<double> sharpColors = cube.ReadColors();
  check.AtLeast(sharp, 300.0, "feature lines of a cube, drawn by the renderer: area");

  cube.Renderer->UseFXAAOn();
  cube.Window->Render();
  const vtkMTimeType time = cube.Renderer->GetMTime();
  cube.Window->Render();
  check(cube.Renderer->GetMTime() == time, "a frame with FXAA does not modify the renderer");
  check(cube.Renderer->GetUseFXAA(), "and leaves it as it is");
  check.AtLeast(CountDifferent(sharpColors, cube.ReadColors()), 200,
    "lines are softened by the renderer's FXAA: pixels changed");
  check.AtLeast(countLines(), 0.9 * sharp, "and are the same lines: area");
  check.AtMost(countLines(), 1.1 * sharp, "and are the same lines: area");
  const std::vector<double> soft = cube.ReadColors();
  cube.Renderer->SetFXAAOptions(nullptr);
  cube.Window->Render();
  check(CountDifferent(soft, cube.ReadColors()) == 0, "without options FXAA has its defaults");
}

/// SSAO over a pass of ours, which hands on positions and normals, beside SSAO alone.
void TestPositions(const CameraKind& camera)
{
  View corner(200, 200);
  AddCube(corner.Renderer);
  corner.Renderer->AddActor(MakeSphere(30, 0.55));
  corner.Renderer->ResetCamera();
  camera.SetUp(corner);
  vtkNew<vtkSSAOPass> ssao;
  ssao->SetRadius(0.5);
  ssao->SetBias(0.02);
  corner.Render({});
  const std::vector<double> plain = corner.ReadColors();
  corner.Render({ ssao });
  const std::vector<double> shaded = corner.ReadColors();
  const int occludedPixels = CountDifferent(plain, shaded);
  const std::string name = camera.Name;
  check.AtLeast(occludedPixels, 500, name + ", SSAO alone: pixels changed");
  vtkNew<vtkBackgroundFillPass> nothing; // of a mesh
  corner.Render({ nothing, ssao });
  check.AtMost(CountDifferent(shaded, corner.ReadColors()), 0.05 * occludedPixels,
    name + ", SSAO over ours gets positions and normals: pixels that differ from SSAO alone");
}

/// With VTK's own passes, in any order: each leaves its mark, and the surface stays whole.
void TestChains()
{
  View view(200, 200);
  AddPoints(view.Renderer, 40000);
  view.Renderer->ResetCamera();
  view.Renderer->GetActiveCamera()->Zoom(1.4);
  vtkNew<vtkBackgroundFillPass> fill;
  vtkNew<vtkOccludedFillPass> occluded;
  vtkNew<vtkSurfaceSmoothingPass> smooth;
  vtkNew<vtkSilhouettePass> silhouettes;
  vtkNew<vtkEDLShading> edl;
  vtkNew<vtkSSAOPass> ssao;
  ssao->SetRadius(0.5);
  ssao->SetBias(0.02);
  vtkNew<vtkOpenGLFXAAPass> fxaa;

  view.Render({ fill, occluded, smooth });
  const std::vector<double> filled = view.ReadColors();
  const int covered = CountCovered(view);
  view.Render({ fill, occluded, smooth, edl });
  // EDL interpolates depths, so that outlines grow a little
  auto isCovered = [&] { return std::abs(CountCovered(view) - covered) <= 0.03 * covered; };
  check(isCovered(), "EDL over ours: the same pixels are covered");
  check.AtLeast(CountDifferent(filled, view.ReadColors()), 200, "EDL over ours: pixels changed");
  const std::vector<double> withEDL = view.ReadColors();
  view.Render({ fill, occluded, smooth, silhouettes, edl, fxaa });
  check(isCovered(), "FXAA and EDL over ours: the same pixels are covered");
  check.AtLeast(
    CountDifferent(withEDL, view.ReadColors()), 500, "and lines are seen: pixels changed");
  view.Render({ fill, occluded, smooth, edl, silhouettes });
  check(isCovered(), "ours over EDL: the same pixels are covered");
  check.AtLeast(
    CountDifferent(withEDL, view.ReadColors()), 500, "and lines are seen: pixels changed");

  // a cube on a plane in SSAO has a dark corner
  View corner(200, 200);
  AddCube(corner.Renderer);
  corner.Renderer->AddActor(MakeSphere(30, 0.55));
  corner.Renderer->ResetCamera();
  corner.Render({ ssao });
  const std::vector<double> shaded = corner.ReadColors();
  vtkNew<vtkBackgroundFillPass> nothing; // of a mesh
  corner.Render({ ssao, nothing });
  check(corner.ReadColors() == shaded, "ours over SSAO changes nothing where nothing is to do");
  vtkNew<vtkSilhouettePass> outlines;
  corner.Render({ ssao, outlines });
  check.AtLeast(
    CountDifferent(shaded, corner.ReadColors()), 300, "lines over SSAO: pixels changed");
}

/// Windows with several samples, and resources that are given back and made again.
void TestWindows()
{
  View view(200, 200);
  view.Window->SetMultiSamples(8);
  view.Renderer->AddActor(MakeSphere(40));
  view.Renderer->GradientBackgroundOn();
  view.Renderer->SetBackground2(0.9, 0.9, 0.9);
  view.Renderer->ResetCamera();
  view.Render({});
  const std::vector<double> plain = view.ReadColors();
  vtkNew<vtkBackgroundFillPass> fill;
  view.Render({ fill });
  // samples are one for a pixel within the pass, so that outlines differ
  check.AtMost(CountDifferent(plain, view.ReadColors()), 800, "multisampled: pixels changed");
  const std::vector<double> before = view.ReadColors();
  View other(100, 100);
  other.Renderer->AddActor(MakeSphere(20));
  other.Render({ fill });
  view.Window->Render();
  check(view.ReadColors() == before, "the same picture after another window used the pass");
  fill->ReleaseGraphicsResources(view.Window);
  view.Window->Render();
  check(view.ReadColors() == before, "the same picture after resources were released");
  view.Window->SetSize(150, 130);
  view.Width = 150;
  view.Height = 130;
  view.Window->Render();
  check(glGetError() == GL_NO_ERROR && CountCovered(view) > 3000, "a window of another size");
}

/// A picture of each pass in a viewport of its own.
struct Gallery
{
  vtkNew<vtkRenderWindow> Window;

  vtkRenderer* Add(int column, int row, const Passes& passes)
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetViewport(0.25 * column, 0.5 * row, 0.25 * (column + 1), 0.5 * (row + 1));
    renderer->SetBackground(0.8, 0.85, 0.9);
    renderer->SetPass(MakeChain(passes));
    this->Window->AddRenderer(renderer);
    return renderer;
  }

  void AddPoints(int column, int row, const Passes& passes)
  {
    vtkRenderer* renderer = this->Add(column, row, passes);
    ::AddPoints(renderer, 20000);
    renderer->ResetCamera();
    renderer->GetActiveCamera()->Zoom(1.4);
  }

  void AddMesh(int column, int row, const Passes& passes, bool parallel)
  {
    vtkRenderer* renderer = this->Add(column, row, passes);
    AddCube(renderer);
    vtkSmartPointer<vtkActor> sphere = MakeSphere(40, 0.4);
    sphere->SetPosition(0.35, 0.2, 0.6);
    renderer->AddActor(sphere);
    renderer->ResetCamera();
    renderer->GetActiveCamera()->SetParallelProjection(parallel);
    renderer->GetActiveCamera()->Zoom(1.4);
  }
};
}

int TestImageSpacePasses(int argc, char* argv[])
{
  TestAgainstReference({ "perspective", SetEye }, false);
  TestAgainstReference({ "parallel", LookInParallel }, true);
  TestAgainstReference({ "parallel, from within", LookFromWithin }, false);
  TestAgainstReference({ "sheared picture", ShearPicture }, false);
  TestAgainstReference({ "sheared view", ShearView }, false);
  TestAgainstReference({ "off-axis, a slanted screen", LookThroughScreen }, true);
  TestNothingToDo(false, false);
  TestNothingToDo(true, true);
  TestUniformFrames();
  TestLines();
  TestRendererFXAA();
  for (const CameraKind& camera : { CameraKind{ "perspective", SetEye },
         { "off-axis, a slanted screen", LookThroughScreen }, { "sheared picture", ShearPicture } })
  {
    TestPositions(camera);
  }
  TestChains();
  TestWindows();

  Gallery gallery;
  gallery.Window->SetMultiSamples(0);
  gallery.Window->SetSize(640, 320);
  vtkNew<vtkBackgroundFillPass> fills[4];
  vtkNew<vtkOccludedFillPass> occluded[3];
  vtkNew<vtkSurfaceSmoothingPass> smooth[2];
  vtkNew<vtkDepthAntialiasingPass> antialias[2];
  vtkNew<vtkSilhouettePass> silhouettes[2];
  vtkNew<vtkFeatureLinePass> lines[2];
  gallery.AddPoints(0, 1, {});
  gallery.AddPoints(1, 1, { fills[0] });
  gallery.AddPoints(2, 1, { fills[1], occluded[0] });
  gallery.AddPoints(3, 1, { fills[2], occluded[1], smooth[0] });
  gallery.AddMesh(0, 0, { antialias[0] }, false);
  gallery.AddMesh(1, 0, { silhouettes[0] }, true);
  gallery.AddMesh(2, 0, { lines[0] }, false);
  gallery.AddPoints(
    3, 0, { fills[3], occluded[2], smooth[1], antialias[1], lines[1], silhouettes[1] });
  gallery.Window->Render();
  const int result = vtkRegressionTestImage(gallery.Window);
  check(result != vtkTesting::FAILED, "the picture is that of the baseline");
  return check.GetResult();
}
