// SPDX-License-Identifier: BSD-3-Clause
// A cloud of a sphere, coloured by a lookup table, lit by two lights, with a cylinder of triangles
// through it. Beside the picture: the surface buffer against the sphere itself, the picture against
// that of the sphere's mesh, and what the frames cost.

#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCylinderSource.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkPullPushMapper.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTestUtilities.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>

using namespace PointSurfaceTest;

namespace
{
Checks check;

constexpr int Size = 300;
constexpr int NumberOfPoints = 20000;

void AddHeight(vtkPolyData* data)
{
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    height->InsertNextValue(static_cast<float>(data->GetPoint(i)[1]));
  }
  data->GetPointData()->SetScalars(height);
}

void AddLights(vtkRenderer* renderer)
{
  renderer->AutomaticLightCreationOff();
  vtkNew<vtkLight> warm;
  warm->SetPosition(4.0, 3.0, 5.0);
  warm->SetColor(1.0, 0.8, 0.6);
  renderer->AddLight(warm);
  vtkNew<vtkLight> cold;
  cold->SetPosition(-5.0, 1.0, 2.0);
  cold->SetColor(0.2, 0.3, 0.6);
  renderer->AddLight(cold);
}

struct Scene
{
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkActor> Surface;
  vtkNew<vtkActor> Cylinder;

  Scene(vtkMapper* mapper, vtkPolyData* data)
  {
    vtkNew<vtkLookupTable> table;
    table->SetHueRange(0.6, 0.0);
    table->Build();
    mapper->SetInputDataObject(data);
    mapper->SetLookupTable(table);
    mapper->SetScalarRange(-1.0, 1.0);
    this->Surface->SetMapper(mapper);
    this->Surface->GetProperty()->SetSpecular(0.4);
    this->Surface->GetProperty()->SetSpecularPower(30.0);

    vtkNew<vtkCylinderSource> cylinder;
    cylinder->SetRadius(0.3);
    cylinder->SetHeight(3.0);
    cylinder->SetResolution(60);
    vtkNew<vtkPolyDataMapper> cylinderMapper;
    cylinderMapper->SetInputConnection(cylinder->GetOutputPort());
    this->Cylinder->SetMapper(cylinderMapper);
    this->Cylinder->GetProperty()->SetColor(0.9, 0.9, 0.9);
    this->Cylinder->RotateX(60.0);
    this->Cylinder->RotateZ(15.0);

    this->Renderer->AddActor(this->Surface);
    this->Renderer->AddActor(this->Cylinder);
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    AddLights(this->Renderer);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(Size, Size);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->ResetCamera();
    this->Renderer->GetActiveCamera()->Zoom(1.7);
    this->Window->Render();
  }
};

/// Eye depth and eye-space normal of the unit sphere at the origin along the ray of a pixel.
bool IntersectSphere(vtkCamera* camera, int x, int y, double& depth, double normal[3])
{
  const double scale = std::tan(vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle()));
  double ray[3] = { scale * (2.0 * (x + 0.5) / Size - 1.0), scale * (2.0 * (y + 0.5) / Size - 1.0),
    -1.0 };
  double center[4] = { 0.0, 0.0, 0.0, 1.0 };
  camera->GetViewTransformMatrix()->MultiplyPoint(center, center);
  const double a = vtkMath::Dot(ray, ray);
  const double b = vtkMath::Dot(ray, center);
  const double c = vtkMath::Dot(center, center) - 1.0;
  if (b * b < a * c)
  {
    return false;
  }
  depth = (b - std::sqrt(b * b - a * c)) / a;
  for (int k = 0; k < 3; ++k)
  {
    normal[k] = depth * ray[k] - center[k];
  }
  return true;
}

struct Errors
{
  double Silhouette = 0.0; ///< intersection over union
  double Depth = 0.0;      ///< mean, of the diagonal
  double Angle = 0.0;      ///< mean, in degrees
  int Partial = 0;         ///< pixels that are covered in part
};

Errors MeasureSurfaceBuffer(vtkPullPushMapper* mapper, vtkCamera* camera)
{
  vtkNew<vtkImageData> buffer;
  check(mapper->ReadSurfaceBuffer(buffer), "the surface buffer can be read");
  vtkDataArray* depths = buffer->GetPointData()->GetArray("Depth");
  vtkDataArray* normals = buffer->GetPointData()->GetArray("Normals");
  vtkDataArray* coverages = buffer->GetPointData()->GetArray("Coverage");
  Errors errors;
  int both = 0;
  int either = 0;
  double depthError = 0.0;
  double angle = 0.0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const vtkIdType pixel = static_cast<vtkIdType>(y) * Size + x;
      const double depth = depths->GetComponent(pixel, 0);
      double trueDepth = 0.0;
      double trueNormal[3];
      const bool hit = IntersectSphere(camera, x, y, trueDepth, trueNormal);
      const double coverage = coverages->GetComponent(pixel, 0);
      errors.Partial += coverage > 0.0 && coverage < 0.99;
      either += hit || coverage >= 0.5;
      if (hit && coverage >= 0.5)
      {
        ++both;
        depthError += std::abs(depth - trueDepth);
        angle += vtkMath::AngleBetweenVectors(normals->GetTuple3(pixel), trueNormal);
      }
    }
  }
  const double diagonal = 2.0 * std::sqrt(3.0);
  errors.Silhouette = static_cast<double>(both) / either;
  errors.Depth = depthError / both / diagonal;
  errors.Angle = vtkMath::DegreesFromRadians(angle / both);
  return errors;
}

/// Mean over pixels of the largest difference of a channel, 0 to 255.
double MeanDifference(vtkRenderWindow* a, vtkRenderWindow* b)
{
  vtkNew<vtkUnsignedCharArray> pixelsA;
  vtkNew<vtkUnsignedCharArray> pixelsB;
  a->GetPixelData(0, 0, Size - 1, Size - 1, 0, pixelsA);
  b->GetPixelData(0, 0, Size - 1, Size - 1, 0, pixelsB);
  double sum = 0.0;
  for (vtkIdType i = 0; i < pixelsA->GetNumberOfTuples(); ++i)
  {
    double largest = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      largest =
        std::max(largest, std::abs(pixelsA->GetComponent(i, k) - pixelsB->GetComponent(i, k)));
    }
    sum += largest;
  }
  return sum / pixelsA->GetNumberOfTuples();
}
}

int TestPullPushMapper(int argc, char* argv[])
{
  vtkSmartPointer<vtkPolyData> cloud = MakeSphereCloud(NumberOfPoints);
  AddHeight(cloud);
  vtkNew<vtkPullPushMapper> mapper;
  Scene scene(mapper, cloud);
  check(mapper->GetLastFramePointsDrawn() == NumberOfPoints, "every point is drawn once");
  check(mapper->GetLastFrameReconstructions() == 1, "the first frame makes one surface buffer");
  check(mapper->GetLastFramePasses() == 2 * mapper->GetLastFrameLevels() + 1,
    "each level takes a pull and a push, and then pixels are filled");
  const int levels = mapper->GetLastFrameLevels();
  mapper->SetRadiusScale(4.0);
  scene.Window->Render();
  check(mapper->GetLastFrameLevels() == levels + 2, "as many levels as the largest disc needs");
  mapper->SetRadiusScale(1e3);
  scene.Window->Render();
  check(
    (1 << mapper->GetLastFrameLevels()) >= Size && (1 << (mapper->GetLastFrameLevels() - 1)) < Size,
    "no more levels than lead to one pixel");
  mapper->SetRadiusScale(1.0);
  scene.Window->Render();
  const Errors errors = MeasureSurfaceBuffer(mapper, scene.Renderer->GetActiveCamera());
  check.AtLeast(errors.Silhouette, 0.98, "intersection over union of silhouettes");
  check.AtMost(errors.Depth, 0.0003, "mean depth error, of the diagonal");
  check.AtMost(errors.Angle, 0.5, "mean angle of normals, degrees");
  check(errors.Partial == 0, "without supersampling a pixel is covered or not");

  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(1.0);
  sphere->SetThetaResolution(200);
  sphere->SetPhiResolution(100);
  sphere->Update();
  AddHeight(sphere->GetOutput());
  vtkNew<vtkPolyDataMapper> meshMapper;
  Scene mesh(meshMapper, sphere->GetOutput());
  check.AtMost(
    MeanDifference(scene.Window, mesh.Window), 1.5, "mean difference from the mesh's picture");

  mapper->SetSupersampling(3);
  scene.Window->Render();
  const Errors finer = MeasureSurfaceBuffer(mapper, scene.Renderer->GetActiveCamera());
  check.AtLeast(finer.Silhouette, 0.992, "supersampled: intersection over union of silhouettes");
  check.AtMost(finer.Angle, 0.8 * errors.Angle, "supersampled: mean angle of normals, degrees");
  check.AtLeast(finer.Partial, 300, "supersampled: pixels of the outline that are covered in part");
  mesh.Window->SetMultiSamples(8);
  mesh.Window->Render();
  check.AtMost(MeanDifference(scene.Window, mesh.Window), 0.7,
    "supersampled: mean difference from the mesh's picture");
  mesh.Window->SetMultiSamples(0);
  mapper->SetSupersampling(1);
  scene.Window->Render();

  // the cylinder stands out of the cloud at one end and is hidden by it in the middle
  mesh.Cylinder->VisibilityOff();
  mesh.Window->Render();
  check.AtLeast(MeanDifference(scene.Window, mesh.Window), 3.0, "the cylinder shows");

  scene.Window->Render();
  check(mapper->GetLastFrameReconstructions() == 0, "a still frame makes no surface buffer");
  scene.Surface->GetProperty()->SetSpecular(0.5);
  scene.Window->Render();
  check(mapper->GetLastFrameReconstructions() == 0, "nor does a change of material");
  scene.Surface->GetProperty()->SetSpecular(0.4);
  scene.Renderer->GetActiveCamera()->Azimuth(10.0);
  scene.Window->Render();
  check(mapper->GetLastFrameReconstructions() == 1, "a new camera makes one");
  scene.Renderer->GetActiveCamera()->Azimuth(-10.0);
  scene.Window->Render();

  const int result = vtkRegressionTestImage(scene.Window);
  check(result != vtkTesting::FAILED, "the picture is that of the baseline");
  return check.GetResult();
}
