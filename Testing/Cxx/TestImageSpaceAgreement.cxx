// SPDX-License-Identifier: BSD-3-Clause
// Both back ends of vtkImageSpacePointMapper beside the double-precision reference, from the same
// projected buffer: fills, occluded fills, smoothing with each kernel and anti-aliasing, as
// published and with the defaults; then, of the picture itself, the smoothing of lit colours and
// the blending of outlines.

#include "ImageSpaceReference.h"
#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkImageSpacePointMapper.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <string>

using namespace PointSurfaceTest;

namespace
{
Checks check;

struct Scene
{
  const char* Name;
  int Width, Height, Points;
  bool Parallel, Colors, Published, Cull;
  int Kernel, SmoothingIterations;
  int Fills; ///< of each kind at most; -1: as the mapper wants
};

struct Stage
{
  vtkNew<vtkImageSpacePointMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;

  Stage(const Scene& scene, int backend)
  {
    this->Mapper->SetInputData(MakeTwoSpheres(scene.Points));
    this->Mapper->SetRadius(1.7 * std::sqrt(4.0 * vtkMath::Pi() / scene.Points));
    this->Mapper->SetScalarRange(-1.0, 1.0);
    this->Mapper->SetScalarVisibility(scene.Colors);
    if (scene.Published)
    {
      this->Mapper->SetToPublished();
      this->Mapper->SmoothLitColorsOff(); // the surface buffer shows smoothed normals
    }
    this->Mapper->SetSmoothingKernel(scene.Kernel);
    this->Mapper->SetSmoothingIterations(scene.SmoothingIterations);
    this->Mapper->SetMaximumBackgroundFills(scene.Fills);
    this->Mapper->SetMaximumOccludedFills(scene.Fills);
    this->Mapper->AntialiasOutlineOn();
    this->Mapper->RecordPointIdsOn();
    this->Mapper->SetBackend(backend);
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->SetBackfaceCulling(scene.Cull);
    this->Renderer->AddActor(this->Actor);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(scene.Width, scene.Height);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->ResetCamera();
    this->Renderer->GetActiveCamera()->SetParallelProjection(scene.Parallel);
    this->Renderer->GetActiveCamera()->Azimuth(20.0);
    this->Renderer->GetActiveCamera()->Zoom(1.5);
    this->Renderer->ResetCameraClippingRange();
    this->Window->Render();
  }
};

ImageSpaceReference ReadProjection(vtkImageData* projected)
{
  int size[3];
  projected->GetDimensions(size);
  vtkPointData* data = projected->GetPointData();
  ImageSpaceReference image(size[0], size[1]);
  for (int id = 0; id < size[0] * size[1]; ++id)
  {
    ImageSpaceReference::Pixel& pixel = image.At(id % size[0], id / size[0]);
    pixel.Depth = data->GetArray("Depth")->GetComponent(id, 0);
    data->GetArray("Normals")->GetTuple(id, pixel.Normal.data());
    data->GetArray("Displacement")->GetTuple(id, pixel.Displacement.data());
    pixel.Radius = data->GetArray("Radius")->GetComponent(id, 0);
    pixel.Source = static_cast<int>(data->GetArray("PointIds")->GetComponent(id, 0));
    if (data->HasArray("Colors"))
    {
      data->GetArray("Colors")->GetTuple(id, pixel.Color.data());
    }
  }
  return image;
}

ImageSpaceReference::Camera GetCamera(Stage& stage, const Scene& scene, const int extent[6])
{
  vtkCamera* camera = stage.Renderer->GetActiveCamera();
  ImageSpaceReference::Camera result;
  result.Parallel = scene.Parallel;
  result.Focal = 0.5 * scene.Height /
    (scene.Parallel ? camera->GetParallelScale()
                    : std::tan(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle())));
  result.Center = { 0.5 * scene.Width - extent[0], 0.5 * scene.Height - extent[2] };
  return result;
}

int CountDiffering(ImageSpaceReference a, ImageSpaceReference b)
{
  int count = 0;
  for (int i = 0; i < a.GetWidth() * a.GetHeight(); ++i)
  {
    const int x = i % a.GetWidth();
    const int y = i / a.GetWidth();
    count += a.At(x, y).Source != b.At(x, y).Source;
  }
  return count;
}

constexpr double Kernels[3][3] = { { 1, 1, 1 }, { 4, 2, 1 }, { 16, 2, 1 } };

/// Section 7, where the other side of an edge is the background: the share of the pixel's surface
/// in the blend, beside the coverage that the mapper hands to VTK's blending.
void CompareCoverage(ImageSpaceReference& reference, const int extent[6], const Scene& scene,
  vtkImageData* surface, const std::string& name)
{
  ImageSpaceReference mask(
    scene.Width, scene.Height); // of the viewport: beside it nothing is known
  for (int id = 0; id < scene.Width * scene.Height; ++id)
  {
    ImageSpaceReference::Pixel& pixel = mask.At(id % scene.Width, id / scene.Width);
    pixel = reference.At(id % scene.Width - extent[0], id / scene.Width - extent[2]);
    pixel.Color = { pixel.Depth > 0.0 ? 1.0 : 0.0, 0.0, 0.0, 0.0 };
  }
  auto isNearDecision = [&mask](int x, int y)
  {
    bool near = false;
    for (int i = 0; i < 9; ++i)
    {
      near |= mask.Get(x + i % 3 - 1, y + i / 3 - 1).NearDecision;
    }
    return near;
  };
  int outline = 0;
  double worst = 0.0;
  for (int y = 1; y + 1 < scene.Height; ++y)
  {
    for (int x = 1; x + 1 < scene.Width; ++x)
    {
      const bool isSurface = mask.At(x, y).Depth > 0.0;
      if (isNearDecision(x, y))
      {
        continue;
      }
      const bool isOutline = isSurface && std::isinf(mask.Laplace(x, y));
      const double expected = isOutline ? mask.Blend(x, y)[0] : isSurface;
      outline += isOutline;
      const double coverage =
        surface->GetPointData()->GetArray("Coverage")->GetComponent(y * scene.Width + x, 0);
      worst = std::max(worst, std::abs(coverage - expected));
    }
  }
  check.AtLeast(outline, scene.Width / 2, name + ": pixels on the outline");
  check.AtMost(worst, 1e-5, name + ": largest difference in coverage");
}

void Compare(const Scene& scene, int backend)
{
  Stage stage(scene, backend);
  vtkImageSpacePointMapper* mapper = stage.Mapper;
  vtkNew<vtkImageData> projected;
  vtkNew<vtkImageData> surface;
  const std::string name =
    std::string(scene.Name) + (backend == vtkImageSpacePointMapper::CPU ? ", CPU" : ", OpenGL");
  check(mapper->GetLastFrameBackend() == backend && mapper->ReadProjectedBuffer(projected) &&
      mapper->ReadSurfaceBuffer(surface),
    name + ": buffers can be read");

  ImageSpaceReference reference = ReadProjection(projected);
  vtkFieldData* plan = projected->GetFieldData();
  const double distance = plan->GetArray("LayerDistance")->GetComponent(0, 0);
  if (scene.Published)
  {
    const double farPlane = stage.Renderer->GetActiveCamera()->GetClippingRange()[1];
    check(std::abs(distance - 1e-4 * farPlane) < 1e-5 * distance,
      name + ": the paper's distance of layers");
  }
  const int maximum[2] = { static_cast<int>(plan->GetArray("MaximumFills")->GetComponent(0, 0)),
    static_cast<int>(plan->GetArray("MaximumFills")->GetComponent(1, 0)) };
  const int reach[2] = { static_cast<int>(plan->GetArray("Reach")->GetComponent(0, 0)),
    static_cast<int>(plan->GetArray("Reach")->GetComponent(1, 0)) };
  check((reach[0] == 0 && reach[1] == 0) == scene.Published, name + ": outlines as published");
  int extent[6];
  projected->GetExtent(extent);
  const int discReach = static_cast<int>(plan->GetArray("DiscReach")->GetComponent(0, 0));
  check((discReach == 0) == scene.Published, name + ": discs where they are not published");
  if (discReach > 0)
  {
    const ImageSpaceReference projection = reference;
    reference.FillWithinDiscs(GetCamera(stage, scene, extent), discReach, distance);
    check.AtLeast(CountDiffering(projection, reference), 0.02 * scene.Width * scene.Height,
      name + ": pixels filled within discs");
  }
  const int fills = reference.FillBackground(maximum[0], reach[0]);
  const int occluded = reference.FillOccluded(maximum[1], distance, reach[1]);
  check(fills == mapper->GetLastFrameBackgroundFills(), name + ": as many background fills");
  check(std::abs(occluded - mapper->GetLastFrameOccludedFills()) <= 1,
    name + ": as many occluded fills, but for a close call");
  for (int i = 0; i < scene.SmoothingIterations; ++i)
  {
    const double* k = Kernels[scene.Kernel];
    reference.Smooth({ k[0], k[1], k[2] },
      scene.Published ? std::numeric_limits<double>::infinity() : distance, !scene.Cull);
  }

  check(extent[0] < 0 || scene.Points < 100000, name + ": the projection has a rim");
  int covered = 0;
  int close = 0;
  int closeDiffering = 0;
  int differing = 0;
  double worst = 0.0;
  vtkPointData* data = surface->GetPointData();
  for (int id = 0; id < scene.Width * scene.Height; ++id)
  {
    // the projection goes on outside of the viewport, from where pixels are filled too
    const ImageSpaceReference::Pixel& expected =
      reference.At(id % scene.Width - extent[0], id / scene.Width - extent[2]);
    const double depth = data->GetArray("Depth")->GetComponent(id, 0);
    if (expected.Depth == 0.0 && depth == 0.0)
    {
      continue;
    }
    ++covered;
    const int source = static_cast<int>(data->GetArray("PointIds")->GetComponent(id, 0));
    const bool differs = (expected.Depth == 0.0) != (depth == 0.0) || source != expected.Source;
    if (expected.NearDecision)
    {
      ++close;
      closeDiffering += differs;
      continue;
    }
    if (differs)
    {
      ++differing;
      continue;
    }
    double difference = std::abs(depth - expected.Depth) / expected.Depth;
    for (int k = 0; k < 3; ++k)
    {
      const double error = data->GetArray("Normals")->GetComponent(id, k) - expected.Normal[k];
      difference = std::max(difference, std::abs(error));
    }
    for (int k = 0; k < 4 && scene.Colors; ++k)
    {
      const double error = data->GetArray("Colors")->GetComponent(id, k) - expected.Color[k];
      difference = std::max(difference, std::abs(error));
    }
    worst = difference <= worst ? worst : difference; // not a number is no agreement
  }
  std::cout << name << ": " << fills << " and " << occluded << " fills, covered " << covered
            << ", near a decision " << close << " (" << closeDiffering << " differing)\n";
  check.AtLeast(covered, 0.15 * scene.Width * scene.Height, name + ": covered pixels");
  check.AtMost(differing, 0.001 * covered, name + ": differing in validity or source");
  check.AtMost(worst, 1e-4, name + ": largest difference of the others");
  check.AtMost(close, 0.05 * covered, name + ": near a decision");
  CompareCoverage(reference, extent, scene, surface, name);
}

/// Smoothing of lit colours, beside the reference's smoothing of the picture.
void CompareLit(int backend)
{
  const Scene scene = { "lit", 300, 300, 60000, false, true, true, true,
    vtkImageSpacePointMapper::AlleviatedGaussian, 1, 3 };
  Stage stage(scene, backend);
  vtkNew<vtkImageData> surface;
  stage.Mapper->AntialiasOutlineOff();
  stage.Mapper->SetSmoothingIterations(0);
  stage.Window->Render();
  stage.Mapper->ReadSurfaceBuffer(surface);
  vtkNew<vtkUnsignedCharArray> lit;
  stage.Window->GetPixelData(0, 0, scene.Width - 1, scene.Height - 1, 0, lit);
  stage.Mapper->SetSmoothingIterations(1);
  stage.Mapper->SmoothLitColorsOn();
  stage.Window->Render();
  vtkNew<vtkUnsignedCharArray> smoothed;
  stage.Window->GetPixelData(0, 0, scene.Width - 1, scene.Height - 1, 0, smoothed);

  ImageSpaceReference reference(scene.Width, scene.Height);
  for (int id = 0; id < scene.Width * scene.Height; ++id)
  {
    ImageSpaceReference::Pixel& pixel = reference.At(id % scene.Width, id / scene.Width);
    pixel.Depth = surface->GetPointData()->GetArray("Depth")->GetComponent(id, 0);
    for (int k = 0; k < 3; ++k)
    {
      pixel.Color[k] = lit->GetComponent(id, k);
    }
  }
  reference.Smooth({ 16.0, 2.0, 1.0 });
  double worst = 0.0;
  double change = 0.0;
  int covered = 0;
  for (int id = 0; id < scene.Width * scene.Height; ++id)
  {
    const auto& pixel = reference.At(id % scene.Width, id / scene.Width);
    covered += pixel.Depth > 0.0;
    // smoothing at the rim takes in what is outside of the picture
    const int x = id % scene.Width;
    const int y = id / scene.Width;
    const bool isInner = x > 0 && y > 0 && x + 1 < scene.Width && y + 1 < scene.Height;
    for (int k = 0; k < 3 && pixel.Depth > 0.0 && isInner; ++k)
    {
      worst = std::max(worst, std::abs(pixel.Color[k] - smoothed->GetComponent(id, k)));
      change += std::abs(lit->GetComponent(id, k) - smoothed->GetComponent(id, k));
    }
  }
  const std::string name = backend == vtkImageSpacePointMapper::CPU ? "CPU" : "OpenGL";
  check.AtLeast(covered, 20000, name + ", lit colours: covered pixels");
  check.AtMost(worst, 1.1, name + ", lit colours: largest difference, grey levels, of bytes");
  check.AtLeast(change / covered, 0.5, name + ", lit colours: mean change by smoothing");
}

/// The picture with outlines that blend, beside the one without them and the background.
void CompareBlended(int backend)
{
  const Scene scene = { "blended", 300, 300, 60000, false, true, false, true,
    vtkImageSpacePointMapper::Gaussian, 1, -1 };
  Stage stage(scene, backend);
  stage.Renderer->SetBackground(0.2, 0.5, 0.9);
  const double background[3] = { 0.2 * 255.0, 0.5 * 255.0, 0.9 * 255.0 };
  vtkNew<vtkUnsignedCharArray> pictures[2];
  vtkNew<vtkImageData> surface;
  for (int antialias = 0; antialias < 2; ++antialias)
  {
    stage.Mapper->SetAntialiasOutline(antialias);
    stage.Window->Render();
    stage.Window->GetPixelData(0, 0, scene.Width - 1, scene.Height - 1, 0, pictures[antialias]);
  }
  stage.Mapper->ReadSurfaceBuffer(surface);
  int partial = 0;
  double worst = 0.0;
  for (int id = 0; id < scene.Width * scene.Height; ++id)
  {
    const double coverage = surface->GetPointData()->GetArray("Coverage")->GetComponent(id, 0);
    partial += coverage > 0.0 && coverage < 0.99;
    for (int k = 0; k < 3; ++k)
    {
      const double expected =
        coverage * pictures[0]->GetComponent(id, k) + (1.0 - coverage) * background[k];
      worst = std::max(worst, std::abs(pictures[1]->GetComponent(id, k) - expected));
    }
  }
  const std::string name = backend == vtkImageSpacePointMapper::CPU ? "CPU" : "OpenGL";
  check.AtLeast(partial, 300, name + ", blended outlines: pixels");
  check.AtMost(worst, 1.6, name + ", blended outlines: largest difference, grey levels, of bytes");
}
}

int TestImageSpaceAgreement(int, char*[])
{
  using Mapper = vtkImageSpacePointMapper;
  const Scene scenes[] = {
    { "published", 400, 400, 150000, false, true, true, true, Mapper::AlleviatedGaussian, 1, 3 },
    { "default", 400, 400, 150000, false, true, false, true, Mapper::Gaussian, 1, -1 },
    { "two-sided", 301, 233, 60000, true, false, false, false, Mapper::Box, 2, -1 },
    { "sparse", 200, 300, 8000, false, false, false, true, Mapper::Gaussian, 3, -1 },
  };
  for (const Scene& scene : scenes)
  {
    Compare(scene, Mapper::OpenGL);
    Compare(scene, Mapper::CPU);
  }
  for (int backend : { Mapper::OpenGL, Mapper::CPU })
  {
    CompareLit(backend);
    CompareBlended(backend);
  }
  return check.GetResult();
}
