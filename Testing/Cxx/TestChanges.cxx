// SPDX-License-Identifier: BSD-3-Clause
// What a change sends to OpenGL, by counted bytes: nothing for a camera, a light, a colour, an
// opacity, a radius scale; the scalars alone for new scalars; and a time series of clouds sends
// each cloud once, without growth in memory. For every mapper, with both back ends.

#include "PointSurfaceTestMappers.h"
#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkLight.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointSurfaceCompat.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"

#include <fstream>
#include <string>

#ifdef __linux__
#include <unistd.h>
#endif

using namespace PointSurfaceTest;

namespace
{
Checks check;

constexpr vtkIdType Points = 5000;
constexpr vtkIdType Vector = 3 * sizeof(float); // coordinates or a normal
constexpr vtkIdType Scalar = sizeof(float);
constexpr vtkIdType Id = sizeof(unsigned int); // as points are in an order of their own
constexpr vtkIdType Color = 4;                 // bytes
/// Splats lie in OpenGL in a form of their own: 16 floats, and the 6 coefficients of order 2 in 8.
constexpr vtkIdType SplatBytes = 24 * Scalar;

struct Scene
{
  const MapperClass& Class;
  vtkSmartPointer<vtkPointSurfaceMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkLight> Light;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  const bool OnGPU;
  const std::string Name;

  Scene(const MapperClass& mapperClass, int backend)
    : Class(mapperClass)
    , Mapper(mapperClass.Make())
    , OnGPU(backend == vtkPointSurfaceMapper::OpenGL)
    , Name(mapperClass.Name + (OnGPU ? ", OpenGL: " : ", CPU: "))
  {
    this->Mapper->SetBackend(backend);
    this->Actor->SetMapper(this->Mapper);
    this->Light->SetPosition(2.0, 3.0, 4.0);
    this->Renderer->AddLight(this->Light);
    this->Renderer->AddActor(this->Actor);
    this->Window->SetOffScreenRendering(1);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(100, 80);
    this->Window->AddRenderer(this->Renderer);
  }

  vtkIdType Render()
  {
    this->Window->Render();
    return this->Mapper->GetLastFrameBytesUploaded();
  }

  /// Of the arrays that the mapper draws from, and the points' ids.
  vtkIdType GetBytes(vtkIdType points) const
  {
    return points *
      (Vector + (this->Class.UsesNormals ? Vector : 0) + (this->Class.UsesRadii ? Scalar : 0) +
        (this->Class.DrawsSplats ? 0 : Id));
  }
  /// A normal where none are uploaded.
  vtkIdType GetStandInBytes() const { return this->Class.UsesNormals ? 0 : Vector; }

  /// What the cloud sends: all of it to OpenGL, nothing where it stays in memory.
  void Sends(vtkIdType expected, const std::string& what)
  {
    const vtkIdType sent = this->Render();
    check(sent == (this->OnGPU ? expected : 0),
      this->Name + what + " sends " + std::to_string(sent) + " bytes, not " +
        std::to_string(expected));
  }

  /// And what the surface buffer sends, 16 bytes a pixel, and 16 for colours: all pixels that are
  /// shaded, and none beyond the rectangle.
  void MakesSurface(bool made, const std::string& what)
  {
    const int* r = this->Mapper->GetLastFrameRectangle();
    const vtkIdType pixels = static_cast<vtkIdType>(r[2]) * r[3];
    const vtkIdType shaded = this->Mapper->GetLastFramePixelsShaded();
    const vtkIdType ofPixel = this->Mapper->GetScalarVisibility() ? 32 : 16;
    const vtkIdType sent = this->Mapper->GetLastFrameSurfaceBytesUploaded();
    const bool sends = made && !this->OnGPU;
    check(sends ? shaded * ofPixel < sent && sent <= pixels * ofPixel : sent == 0,
      this->Name + what + ": bytes of the surface buffer");
    check(this->Mapper->GetLastFrameReconstructions() == (made ? 1 : 0),
      this->Name + what + ": surface buffers made");
  }
};

/// Normals in double precision, an undefined one, a bad radius and a hidden point among them: what
/// is converted or repaired is no less the same for that.
vtkSmartPointer<vtkPolyData> MakeCloud(const MapperClass& mapperClass, bool faulty)
{
  auto cloud = mapperClass.MakeInput(MakeSphereCloud(static_cast<int>(Points)));
  vtkPointData* data = cloud->GetPointData();
  vtkNew<vtkFloatArray> height;
  height->SetName("height");
  for (vtkIdType i = 0; i < Points; ++i)
  {
    height->InsertNextValue(static_cast<float>(cloud->GetPoint(i)[1]));
  }
  data->SetScalars(height);
  if (faulty)
  {
    vtkNew<vtkDoubleArray> normals;
    normals->DeepCopy(data->GetNormals());
    normals->SetTuple3(3, vtkMath::Nan(), 0.0, 0.0);
    data->SetNormals(normals);
    data->GetArray("radius")->SetTuple1(4, -1.0);
    cloud->GetPoints()->SetPoint(5, vtkMath::Nan(), 0.0, 0.0);
  }
  return cloud;
}

void CheckChanges(const MapperClass& mapperClass, int backend, bool faulty)
{
  Scene scene(mapperClass, backend);
  vtkPointSurfaceMapper* mapper = scene.Mapper;
  Messages messages(mapper);
  auto cloud = MakeCloud(mapperClass, faulty);
  mapper->SetInputData(cloud);
  mapper->SetScalarRange(-1.0, 1.0);
  scene.Renderer->ResetCamera();
  const vtkIdType drawn = faulty ? Points - 1 : Points;
  const vtkIdType first = scene.Render();
  constexpr vtkIdType StandIns = 28; // of normals and colours
  const vtkIdType whole = mapperClass.DrawsSplats
    ? Points * (SplatBytes + Color) + StandIns
    : scene.GetBytes(drawn) + scene.GetStandInBytes() + drawn * Color;
  check(first == (scene.OnGPU ? whole : StandIns),
    scene.Name + "the first frame sends the cloud: " + std::to_string(first));
  scene.MakesSurface(true, "the first frame");

  scene.Sends(0, "a still frame");
  scene.MakesSurface(false, "a still frame");
  scene.Renderer->GetActiveCamera()->Azimuth(20.0);
  scene.Sends(0, "a moved camera");
  scene.MakesSurface(true, "a moved camera");
  scene.Light->SetPosition(-1.0, 0.0, 4.0);
  scene.Light->SetColor(1.0, 0.5, 0.5);
  scene.Sends(0, "a light");
  scene.MakesSurface(false, "a light");
  scene.Actor->GetProperty()->SetColor(0.1, 0.9, 0.3);
  scene.Actor->GetProperty()->SetSpecular(0.5);
  scene.Sends(0, "a colour");
  scene.MakesSurface(false, "a colour");
  scene.Actor->GetProperty()->SetOpacity(0.5);
  scene.Sends(0, "an opacity");
  scene.MakesSurface(false, "an opacity");
  scene.Actor->GetProperty()->SetOpacity(1.0);
  mapper->SetRadiusScale(1.2);
  scene.Sends(0, "a scale of the radii");
  scene.Actor->SetScale(1.1, 1.0, 1.0);
  scene.Sends(0, "a moved actor");

  auto* height = vtkFloatArray::SafeDownCast(cloud->GetPointData()->GetScalars());
  height->SetValue(0, 0.7f);
  height->Modified();
  scene.Sends(drawn * Color, "new values of scalars");
  scene.MakesSurface(true, "new values of scalars");
  mapper->SetScalarRange(-2.0, 2.0);
  scene.Sends(drawn * Color, "another range of scalars");
  vtkNew<vtkFloatArray> other;
  other->SetName("other");
  for (vtkIdType i = 0; i < Points; ++i)
  {
    other->InsertNextValue(static_cast<float>(cloud->GetPoint(i)[2]));
  }
  cloud->GetPointData()->SetScalars(other);
  scene.Sends(drawn * Color, "another array of scalars");
  mapper->ScalarVisibilityOff();
  scene.Sends(0, "no scalars");

  cloud->GetPoints()->SetPoint(7, 0.9, 0.0, 0.0);
  cloud->GetPoints()->Modified();
  scene.Sends(drawn * (mapperClass.DrawsSplats ? SplatBytes : Vector), "a moved point");
}

/// A dense cloud that a camera comes nearer to and leaves.
void CheckThinning(const MapperClass& mapperClass, int backend)
{
  constexpr vtkIdType ManyPoints = 80000;
  Scene scene(mapperClass, backend);
  scene.Mapper->ScalarVisibilityOff();
  scene.Mapper->SetInputData(MakeSphereCloud(static_cast<int>(ManyPoints)));
  scene.Renderer->ResetCamera();
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->Zoom(8.0);
  const vtkIdType first = scene.Render();
  check(!scene.OnGPU || first == scene.GetBytes(ManyPoints),
    scene.Name + "a dense cloud sends its points alone: " + std::to_string(first));
  check(scene.Mapper->GetLastFramePointsDrawn() > ManyPoints / 100,
    scene.Name + "seen from near, all points that are in sight are drawn");
  camera->Zoom(0.125);
  const vtkIdType sent = scene.Render();
  scene.MakesSurface(true, "groups of points");
  const vtkIdType drawn = scene.Mapper->GetLastFramePointsDrawn();
  check(drawn < ManyPoints / 2,
    scene.Name + "seen from afar, fewer are drawn: " + std::to_string(drawn));
  check(sent == (scene.OnGPU ? scene.GetBytes(drawn) : 0),
    scene.Name + "the means of groups are sent: " + std::to_string(sent));
  camera->Azimuth(10.0);
  scene.Sends(0, "groups that were drawn before");
  scene.MakesSurface(true, "groups that were drawn before");
  scene.Mapper->Modified();
  scene.Sends(0, "groups of points that stay as they are");
  scene.MakesSurface(true, "groups of points that stay as they are");
  vtkPolyData::SafeDownCast(scene.Mapper->GetInput())->GetPoints()->Modified();
  scene.Sends(ManyPoints * Vector + scene.GetBytes(drawn), "points that stay in their order");
}

void CheckBlocks(const MapperClass& mapperClass, int backend)
{
  Scene scene(mapperClass, backend);
  vtkPointSurfaceMapper* mapper = scene.Mapper;
  vtkNew<vtkMultiBlockDataSet> tree;
  tree->SetBlock(0, MakeCloud(mapperClass, false));
  tree->SetBlock(1, MakeCloud(mapperClass, false));
  mapper->SetInputData(tree);
  mapper->ScalarVisibilityOff();
  scene.Renderer->ResetCamera();
  scene.Render();
  mapper->SetBlockVisibility(1, false);
  scene.Sends(0, "a hidden block");
  scene.MakesSurface(true, "a hidden block");
  mapper->SetBlockPickability(1, false);
  scene.Sends(0, "a block that is not pickable");
  mapper->SetBlockColor(2, 1.0, 0.0, 0.0);
  const vtkIdType sent = scene.Render();
  // where only stand-ins of arrays are uploaded, one of colours
  const vtkIdType standIn = scene.OnGPU && !mapperClass.DrawsSplats ? 0 : 16;
  check(sent == (scene.OnGPU ? 2 * Points * Color : 0) + standIn,
    scene.Name + "the first colour of a block sends colours: " + std::to_string(sent));
  mapper->SetBlockColor(2, 0.0, 1.0, 0.0);
  scene.Sends(2 * Points * Color, "another colour of a block");
  vtkPointSet::SafeDownCast(tree->GetBlock(0))->GetPoints()->Modified();
  // colours lie in the order of the splats, which are made anew
  scene.Sends(
    2 * Points * (mapperClass.DrawsSplats ? SplatBytes + Color : Vector), "a block's points");
}

/// Resident memory in bytes; 0 where it is not known.
double GetResidentMemory()
{
#ifdef __linux__
  std::ifstream file("/proc/self/statm");
  double size = 0.0;
  double resident = 0.0;
  file >> size >> resident;
  return resident * sysconf(_SC_PAGESIZE);
#else
  return 0.0;
#endif
}

/// Of all of OpenGL's buffers that there are in the current context, whose names are small numbers.
vtkIdType CountBufferBytes()
{
  constexpr GLuint Names = 5000;
  vtkIdType bytes = 0;
  for (GLuint name = 1; name < Names; ++name)
  {
    if (glIsBuffer(name))
    {
      GLint size = 0;
      glBindBuffer(GL_COPY_READ_BUFFER, name);
      glGetBufferParameteriv(GL_COPY_READ_BUFFER, GL_BUFFER_SIZE, &size);
      bytes += size;
    }
  }
  glBindBuffer(GL_COPY_READ_BUFFER, 0);
  return bytes;
}

/// The first points.
vtkSmartPointer<vtkPolyData> GetPart(vtkPolyData* cloud, vtkIdType count)
{
  auto part = vtkSmartPointer<vtkPolyData>::New();
  part->DeepCopy(cloud);
  part->GetPoints()->SetNumberOfPoints(count);
  for (int i = 0; i < part->GetPointData()->GetNumberOfArrays(); ++i)
  {
    part->GetPointData()->GetArray(i)->SetNumberOfTuples(count);
  }
  return part;
}

void CheckTimeSeries(const MapperClass& mapperClass, int backend)
{
  constexpr vtkIdType Steps = 200;
  Scene scene(mapperClass, backend);
  scene.Mapper->ScalarVisibilityOff();
  // splats are larger, and take longer
  const vtkIdType points = mapperClass.DrawsSplats ? Points / 5 : Points;
  auto all = mapperClass.MakeInput(MakeSphereCloud(static_cast<int>(points + Steps)));
  double before = 0.0;
  vtkIdType bytesBefore = 0;
  for (vtkIdType step = 0; step < Steps; ++step)
  {
    const vtkIdType count = points + step;
    auto cloud = GetPart(all, count);
    scene.Mapper->SetInputData(cloud);
    scene.Renderer->ResetCamera();
    const vtkIdType sent = scene.Render();
    const vtkIdType whole = mapperClass.DrawsSplats ? count * SplatBytes : scene.GetBytes(count);
    const bool hasNormals = scene.OnGPU && !mapperClass.DrawsSplats && mapperClass.UsesNormals;
    const vtkIdType standIn = step == 0 && !hasNormals ? Vector : 0;
    check(sent == (scene.OnGPU ? whole : 0) + standIn,
      scene.Name + "a step sends its cloud: " + std::to_string(sent));
    check(scene.Mapper->GetLastFramePointsDrawn() == count, scene.Name + "a step draws its cloud");
    if (step == 20)
    {
      before = GetResidentMemory();
      bytesBefore = CountBufferBytes();
    }
  }
  // the last cloud has 179 points more
  check.AtMost(static_cast<double>(CountBufferBytes() - bytesBefore),
    static_cast<double>(Steps) * SplatBytes,
    scene.Name + "growth of OpenGL's buffers over 179 steps, in bytes");
  // 179 clouds are 25 MB in memory, and as much again uploaded
  check.AtMost(1e-6 * (GetResidentMemory() - before), 6.0,
    scene.Name + "growth in memory over 179 steps, in MB");
}
}

int TestChanges(int, char*[])
{
  for (const MapperClass& mapperClass : GetMapperClasses())
  {
    for (int backend : { vtkPointSurfaceMapper::OpenGL, vtkPointSurfaceMapper::CPU })
    {
      CheckChanges(mapperClass, backend, false);
      if (!mapperClass.DrawsSplats) // which have faults of their own; see TestHardInput
      {
        CheckChanges(mapperClass, backend, true);
      }
      CheckBlocks(mapperClass, backend);
      if (mapperClass.Thins)
      {
        CheckThinning(mapperClass, backend);
      }
      CheckTimeSeries(mapperClass, backend);
    }
  }
  return check.GetResult();
}
