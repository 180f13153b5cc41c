// SPDX-License-Identifier: BSD-3-Clause
// Both back ends of vtkPullPushMapper with all departures from the paper off, beside the
// double-precision reference, from the same projected buffer: viewports of many sizes, perspective
// and parallel projection, clouds with and without colours and with a radius for each point.

#include "SurfaceBufferComparison.h"

#include "vtkActor.h"
#include "vtkCamera.h"
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

#include <cmath>
#include <iostream>
#include <string>

namespace
{
/// Two spheres, one partly before the other, sampled at random; scalars; radii that vary.
vtkNew<vtkPolyData> MakeCloud(int count)
{
  vtkNew<vtkMinimalStandardRandomSequence> random;
  random->SetSeed(7);
  auto next = [&]()
  {
    random->Next();
    return random->GetValue();
  };
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetName("Normals");
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  const double spacing = std::sqrt(4.0 * vtkMath::Pi() / count);
  for (int i = 0; i < count; ++i)
  {
    const double z = 2.0 * next() - 1.0;
    const double angle = 2.0 * vtkMath::Pi() * next();
    const double r = std::sqrt(1.0 - z * z);
    const double n[3] = { r * std::cos(angle), r * std::sin(angle), z };
    const double size = i % 2 ? 1.0 : 0.5;
    const double shift = i % 2 ? 0.0 : 1.1;
    points->InsertNextPoint(
      size * n[0] + 0.4 * shift, size * n[1] + 0.2 * shift, size * n[2] + shift);
    normals->InsertNextTuple(n);
    radii->InsertNextValue(static_cast<float>(2.0 * size * spacing * (1.0 + 0.4 * next())));
    height->InsertNextValue(static_cast<float>(n[1]));
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->GetPointData()->SetNormals(normals);
  cloud->GetPointData()->AddArray(radii);
  cloud->GetPointData()->SetScalars(height);
  return cloud;
}

struct Scene
{
  int Width, Height, Points;
  bool Parallel, Colors;
  double Zoom;
  int MinimumCovered;
};

bool Compare(const Scene& scene, int backend)
{
  vtkNew<vtkPullPushMapper> mapper;
  mapper->SetInputData(MakeCloud(scene.Points));
  mapper->SetScalarRange(-1.0, 1.0);
  mapper->SetScalarVisibility(scene.Colors);
  mapper->SetToPublished();
  mapper->RecordPointIdsOn();
  mapper->SetBackend(backend);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->BackfaceCullingOn();
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(scene.Width, scene.Height);
  window->AddRenderer(renderer);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->SetParallelProjection(scene.Parallel);
  renderer->GetActiveCamera()->Azimuth(20.0);
  renderer->GetActiveCamera()->Zoom(scene.Zoom);
  renderer->ResetCameraClippingRange();
  window->Render();

  vtkNew<vtkImageData> projected;
  vtkNew<vtkImageData> surface;
  if (mapper->GetLastFrameBackend() != backend || !mapper->ReadProjectedBuffer(projected) ||
    !mapper->ReadSurfaceBuffer(surface))
  {
    return false;
  }
  const SurfaceBufferComparison comparison(projected, surface);
  std::cout << (backend == vtkPullPushMapper::CPU ? "CPU, " : "OpenGL, ") << scene.Width << " x "
            << scene.Height << ", " << scene.Points << " points, "
            << (scene.Parallel ? "parallel" : "perspective") << (scene.Colors ? ", colours" : "")
            << ", zoom " << scene.Zoom << ": ";
  comparison.Print(std::cout);
  // the spheres fill a part of any viewport: nothing to compare would be no agreement
  const bool agrees = comparison.Agrees() && comparison.Covered >= scene.MinimumCovered;
  if (!agrees)
  {
    std::cout << "DISAGREES\n";
  }
  return agrees;
}
}

int TestPullPushAgreement(int, char*[])
{
  const Scene scenes[] = {
    { 512, 512, 20000, false, true, 1.5, 100000 },
    { 512, 512, 300, false, false, 1.5, 100000 },
    { 513, 301, 5000, true, true, 1.5, 40000 },
    { 257, 640, 5000, false, false, 6.0, 100000 },
    { 64, 64, 100000, true, false, 1.5, 2000 },
    { 33, 17, 2000, false, true, 1.5, 100 },
    { 3, 2, 2000, false, true, 1.5, 4 },
    { 1, 1, 2000, false, true, 1.5, 1 },
    { 1, 100, 2000, true, false, 1.5, 1 },
    { 16384, 1, 2000, false, false, 1.5, 1 },
  };
  bool all = true;
  for (const Scene& scene : scenes)
  {
    for (int backend : { vtkPullPushMapper::OpenGL, vtkPullPushMapper::CPU })
    {
      all = Compare(scene, backend) && all;
    }
  }
  return all ? EXIT_SUCCESS : EXIT_FAILURE;
}
