// SPDX-License-Identifier: BSD-3-Clause
// Both back ends of vtkPullPushMapper with all departures from the paper off, beside the
// double-precision reference, from the same projected buffer: viewports of many sizes, perspective
// and parallel projection, sheared pictures, clouds with and without colours and with a radius for
// each point.

#include "PointSurfaceTestUtilities.h"
#include "SurfaceBufferComparison.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkProperty.h"
#include "vtkPullPushMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTransform.h"

#include <cmath>
#include <iostream>
#include <string>

using namespace PointSurfaceTest;

namespace
{
struct Scene
{
  int Width, Height, Points;
  bool Parallel, Colors;
  double Zoom;
  int MinimumCovered;
  double Shear = 0.0; ///< of the picture: x by that times y
};

bool Compare(const Scene& scene, int backend)
{
  vtkNew<vtkPullPushMapper> mapper;
  mapper->SetInputData(MakeTwoSpheres(scene.Points));
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
  vtkNew<vtkTransform> shear;
  const double matrix[16] = { 1, scene.Shear, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  shear->SetMatrix(matrix);
  renderer->GetActiveCamera()->SetUserTransform(shear);
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
            << ", zoom " << scene.Zoom << ", shear " << scene.Shear << ": ";
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
    { 400, 300, 2000, false, true, 1.5, 40000, 0.5 },
    { 400, 300, 300, true, false, 1.5, 40000, -0.7 },
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
