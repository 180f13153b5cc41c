// SPDX-License-Identifier: BSD-3-Clause
// Clouds that cannot be drawn as they are, for every mapper: each gives one message that names what
// is wrong, and a frame, and the good cloud beside it is drawn as if the bad one were not there.

#include "PointSurfaceTestMappers.h"
#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkStringArray.h"
#include "vtkTestErrorObserver.h"
#include "vtkUnsignedCharArray.h"

#include <functional>
#include <limits>
#include <vector>

using namespace PointSurfaceTest;

namespace
{
Checks check;

const float NaN = std::numeric_limits<float>::quiet_NaN();
const float Infinity = std::numeric_limits<float>::infinity();

/// What a fault is in: a mapper that has no use for it says nothing of it.
enum Concern
{
  Points,
  Normals,
  Radius,
  Estimates ///< of what points lack; those that lack a splat's arrays are no splats
};

struct Case
{
  std::string Name;
  std::function<void(vtkPolyData*, vtkPointSurfaceMapper*)> Spoil;
  std::string Message; // part of the warning that is expected; empty for none
  bool Draws;          // whether the cloud shows all the same
  Concern Of = Points;
  bool CoversGood = false; // so that the cloud beside it is not seen as ever
};

vtkFloatArray* Radii(vtkPolyData* cloud)
{
  return vtkFloatArray::SafeDownCast(cloud->GetPointData()->GetArray("radius"));
}

void KeepPoints(vtkPolyData* cloud, vtkIdType count)
{
  cloud->GetPoints()->Resize(count);
  cloud->GetPoints()->SetNumberOfPoints(count);
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    data->GetArray(i)->SetNumberOfTuples(count);
  }
}

void AddGhosts(vtkPolyData* cloud, vtkIdType count)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(count);
  ghosts->Fill(vtkDataSetAttributes::HIDDENPOINT);
  cloud->GetPointData()->AddArray(ghosts);
}

void ScaleNormals(vtkPolyData* cloud, vtkPointSurfaceMapper*)
{
  vtkDataArray* normals = cloud->GetPointData()->GetNormals();
  for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
  {
    const double* n = normals->GetTuple3(i);
    const double size = i % 2 ? 1e-6 : 1e6;
    normals->SetTuple3(i, size * n[0], size * n[1], size * n[2]);
  }
}

std::vector<Case> GetCases()
{
  using Mapper = vtkPointSurfaceMapper;
  return {
    { "a good cloud", [](vtkPolyData*, Mapper*) {}, "", true },
    { "no points", [](vtkPolyData* c, Mapper*) { KeepPoints(c, 0); }, "no points", false },
    { "one point", [](vtkPolyData* c, Mapper*) { KeepPoints(c, 1); }, "", true },
    { "one point, a constant radius",
      [](vtkPolyData* c, Mapper* m)
      {
        KeepPoints(c, 1);
        m->SetRadius(0.2);
      },
      "", true },
    { "two equal points, nothing else known",
      [](vtkPolyData* c, Mapper*)
      {
        KeepPoints(c, 2);
        c->GetPoints()->SetPoint(1, c->GetPoint(0));
        c->GetPointData()->Initialize();
      },
      "", false, Estimates },
    { "NaN points",
      [](vtkPolyData* c, Mapper*)
      {
        for (vtkIdType i = 0; i < c->GetNumberOfPoints(); i += 10)
        {
          c->GetPoints()->SetPoint(i, NaN, 0.0, 0.0);
        }
      },
      "not finite", true },
    { "an infinite point",
      [](vtkPolyData* c, Mapper*) { c->GetPoints()->SetPoint(3, 0.0, Infinity, 0.0); },
      "point 3: 0, inf, 0", true },
    { "all points NaN",
      [](vtkPolyData* c, Mapper*)
      {
        for (vtkIdType i = 0; i < c->GetNumberOfPoints(); ++i)
        {
          c->GetPoints()->SetPoint(i, NaN, NaN, NaN);
        }
      },
      "None of the input's points has finite coordinates", false },
    { "no normals", [](vtkPolyData* c, Mapper*) { c->GetPointData()->SetNormals(nullptr); }, "",
      true, Estimates },
    { "zero normals", [](vtkPolyData* c, Mapper*) { c->GetPointData()->GetNormals()->Fill(0.0); },
      "Array 'Normals' has 2000 normals that are zero", true, Normals },
    { "a NaN normal",
      [](vtkPolyData* c, Mapper*) { c->GetPointData()->GetNormals()->SetTuple3(5, NaN, 0.0, 1.0); },
      "1 that are not finite (the first is of point 5)", true, Normals },
    { "normals of no unit length", ScaleNormals, "", true, Normals },
    { "a radius of zero", [](vtkPolyData* c, Mapper*) { Radii(c)->SetValue(7, 0.0f); },
      "the first is 0 of point 7", true, Radius },
    { "a negative radius", [](vtkPolyData* c, Mapper*) { Radii(c)->SetValue(7, -1.0f); },
      "the first is -1 of point 7", true, Radius },
    { "a NaN radius", [](vtkPolyData* c, Mapper*) { Radii(c)->SetValue(7, NaN); },
      "1 of 2000 radii in array 'radius' are not positive and finite", true, Radius },
    { "all radii zero", [](vtkPolyData* c, Mapper*) { Radii(c)->Fill(0.0); },
      "radii are estimated instead", true, Radius },
    { "a huge radius", [](vtkPolyData* c, Mapper*) { Radii(c)->SetValue(7, 1e30f); },
      "larger than the whole cloud", true, Radius, true },
    { "an array that is not there", [](vtkPolyData*, Mapper* m) { m->SetRadiusArray("thickness"); },
      "no point array 'thickness'", true, Radius },
    { "an array of normals as radii", [](vtkPolyData*, Mapper* m) { m->SetRadiusArray("Normals"); },
      "values of 3 components", true, Radius },
    { "too few radii", [](vtkPolyData* c, Mapper*) { Radii(c)->SetNumberOfTuples(10); },
      "Array 'radius' has 10 values", true, Radius },
    { "too few normals",
      [](vtkPolyData* c, Mapper*) { c->GetPointData()->GetNormals()->SetNumberOfTuples(10); },
      "Array 'Normals' has 10 normals", true, Normals },
    { "a radius larger than the cloud", [](vtkPolyData*, Mapper* m) { m->SetRadius(1e30); },
      "The radius 1e+30 is larger than the whole cloud", true, Radius, true },
    { "all points hidden", [](vtkPolyData* c, Mapper*) { AddGhosts(c, 2000); }, "hidden", false },
    { "too few ghosts", [](vtkPolyData* c, Mapper*) { AddGhosts(c, 10); },
      "Array 'vtkGhostType' has 10 values for 2000 points", true },
    { "radii that are names",
      [](vtkPolyData* c, Mapper* m)
      {
        vtkNew<vtkStringArray> names;
        names->SetName("names");
        names->SetNumberOfValues(2000);
        c->GetPointData()->AddArray(names);
        m->SetRadiusArray("names");
      },
      "no point array 'names'", true, Radius },
    { "normals and radii that are integers",
      [](vtkPolyData* c, Mapper* m)
      {
        vtkNew<vtkIntArray> normals;
        normals->SetNumberOfComponents(3);
        vtkNew<vtkIntArray> radii;
        radii->SetName("whole");
        for (vtkIdType i = 0; i < c->GetNumberOfPoints(); ++i)
        {
          const double* x = c->GetPoint(i);
          normals->InsertNextTuple3(100.0 * x[0], 100.0 * x[1], 100.0 * x[2]);
          radii->InsertNextValue(1);
        }
        c->GetPointData()->SetNormals(normals);
        c->GetPointData()->AddArray(radii);
        m->SetRadiusArray("whole");
        m->SetRadiusScale(0.07);
      },
      "", true },
    { "a point on the near plane and one behind the eye",
      [](vtkPolyData* c, Mapper*)
      {
        c->GetPoints()->SetPoint(0, 1.5, 0.0, 7.99);
        c->GetPoints()->SetPoint(1, 1.5, 0.0, 20.0);
      },
      "", true, Points, true },
    { "scalars that are too few",
      [](vtkPolyData* c, Mapper*)
      {
        vtkNew<vtkFloatArray> few;
        few->SetName("few");
        few->InsertNextValue(0.5f);
        c->GetPointData()->SetScalars(few);
      },
      "1 colours for 2000 points", true },
    { "a vertex attribute",
      [](vtkPolyData*, Mapper* m)
      { m->MapDataArrayToVertexAttribute("weight", "radius", vtkDataObject::POINT, -1); },
      "'radius' is mapped to a vertex attribute", true },
    { "a tuple of field data that is not there",
      [](vtkPolyData* c, Mapper* m)
      {
        vtkNew<vtkFloatArray> field;
        field->SetName("field");
        field->InsertNextValue(0.5f);
        c->GetFieldData()->AddArray(field);
        m->SetScalarModeToUseFieldData();
        m->SelectColorArray("field");
        m->SetFieldDataTupleId(3);
      },
      "FieldDataTupleId is 3", true },
    { "the eye amid the points",
      [](vtkPolyData* c, Mapper*)
      {
        for (vtkIdType i = 0; i < c->GetNumberOfPoints(); ++i)
        {
          double* x = c->GetPoint(i);
          c->GetPoints()->SetPoint(i, 50.0 * x[0], 50.0 * x[1], 50.0 * x[2]);
        }
      },
      "", true, Points, true },
  };
}

/// Faults of splats; they are errors where nothing is left to be drawn.
std::vector<Case> GetSplatCases()
{
  using Mapper = vtkPointSurfaceMapper;
  auto spoil = [](const char* array, int component, double value)
  {
    return [=](vtkPolyData* c, Mapper*)
    { c->GetPointData()->GetArray(array)->SetComponent(7, component, value); };
  };
  auto remove = [](const char* array)
  { return [=](vtkPolyData* c, Mapper*) { c->GetPointData()->RemoveArray(array); }; };
  const char* leftOut = "1 of 2000 splats (the first is point 7) are not drawn";
  return {
    { "no normals", [](vtkPolyData* c, Mapper*) { c->GetPointData()->SetNormals(nullptr); },
      "no point array 'Normals'", false },
    { "zero normals", [](vtkPolyData* c, Mapper*) { c->GetPointData()->GetNormals()->Fill(0.0); },
      "2000 of 2000 splats", false },
    { "a zero normal",
      [](vtkPolyData* c, Mapper*) { c->GetPointData()->GetNormals()->SetTuple3(7, 0.0, 0.0, 0.0); },
      leftOut, true },
    { "a NaN normal", spoil("Normals", 1, NaN), leftOut, true },
    { "normals of no unit length", ScaleNormals, "", true },
    { "too few normals",
      [](vtkPolyData* c, Mapper*) { c->GetPointData()->GetNormals()->SetNumberOfTuples(10); },
      "Array 'Normals' has 10 tuples of 3 components for 2000 splats", false },
    { "a negative radius", spoil("radius", 0, -1.0), leftOut, true },
    { "an infinite radius", spoil("radius", 0, Infinity), leftOut, true },
    { "a huge radius", spoil("radius", 0, 1e30), leftOut, true },
    { "axes that are names",
      [](vtkPolyData* c, Mapper*)
      {
        c->GetPointData()->RemoveArray("SplatAxes");
        vtkNew<vtkStringArray> names;
        names->SetName("SplatAxes");
        names->SetNumberOfValues(2000);
        c->GetPointData()->AddArray(names);
      },
      "no point array 'SplatAxes'", false },
    { "an order of nine", spoil("SplatOrder", 0, 9.0), leftOut, true },
    { "an order of zero", spoil("SplatOrder", 0, 0.0), leftOut, true },
    { "an order without coefficients", spoil("SplatOrder", 0, 4.0), leftOut, true },
    { "a NaN coefficient", spoil("SplatCoefficients", 1, NaN), leftOut, true },
    { "a NaN axis", spoil("SplatAxes", 2, NaN), leftOut, true },
    { "a radius of zero", spoil("radius", 0, 0.0), leftOut, true },
    { "a NaN radius", spoil("radius", 0, NaN), leftOut, true },
    { "no coefficients", remove("SplatCoefficients"), "no point array 'SplatCoefficients'", false },
    { "no axes", remove("SplatAxes"), "no point array 'SplatAxes'", false },
    { "no radii", remove("radius"), "no point array 'radius'", false },
    { "all radii zero", [](vtkPolyData* c, Mapper*) { Radii(c)->Fill(0.0); }, "2000 of 2000 splats",
      false },
    { "too few axes",
      [](vtkPolyData* c, Mapper*)
      { c->GetPointData()->GetArray("SplatAxes")->SetNumberOfTuples(10); },
      "Array 'SplatAxes' has 10 tuples", false },
    { "points that are no splats", [](vtkPolyData* c, Mapper*) { c->GetPointData()->Initialize(); },
      "vtkAlgebraicSplats", false },
  };
}

/// Pixels of the surface buffer with a surface.
int CountCovered(vtkPointSurfaceMapper* mapper)
{
  vtkNew<vtkImageData> buffer;
  if (!mapper->ReadSurfaceBuffer(buffer))
  {
    return 0;
  }
  vtkDataArray* depth = buffer->GetPointData()->GetArray("Depth");
  int covered = 0;
  for (vtkIdType i = 0; i < depth->GetNumberOfTuples(); ++i)
  {
    covered += depth->GetComponent(i, 0) > 0.0;
  }
  return covered;
}

/// The half of a window of 200 x 100 pixels that the good cloud is in.
using Picture = std::vector<unsigned char>;
Picture ReadGoodHalf(vtkRenderWindow* window)
{
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(105, 0, 199, 99, 0, pixels);
  return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
}

/// `picture` is that of the good cloud beside another good one, which the first case makes.
void Try(const Case& test, const MapperClass& mapperClass, Picture& picture, bool ofSplats = false)
{
  std::cout << "---- " << mapperClass.Name << ": " << test.Name << std::endl;
  auto good = mapperClass.Make();
  vtkSmartPointer<vtkPolyData> cloud = mapperClass.MakeInput(MakeSphereCloud(2000));
  vtkNew<vtkPolyData> goodCloud;
  goodCloud->DeepCopy(cloud);
  good->SetInputData(goodCloud);
  vtkNew<vtkActor> goodActor;
  goodActor->SetMapper(good);
  goodActor->SetPosition(1.5, 0.0, 0.0);

  auto bad = mapperClass.Make();
  test.Spoil(cloud, bad);
  bad->SetInputData(cloud);
  vtkNew<vtkTest::ErrorObserver> observer;
  bad->AddObserver(vtkCommand::WarningEvent, observer);
  bad->AddObserver(vtkCommand::ErrorEvent, observer);
  vtkNew<vtkActor> badActor;
  badActor->SetMapper(bad);
  badActor->SetPosition(-1.5, 0.0, 0.0);

  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(goodActor);
  renderer->AddActor(badActor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(200, 100);
  window->AddRenderer(renderer);
  renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 8.0);
  renderer->GetActiveCamera()->SetClippingRange(0.01, 1000.0);
  window->Render();

  const bool isError = ofSplats && !test.Draws;
  const std::string message = isError ? observer->GetErrorMessage() : observer->GetWarningMessage();
  check(observer->GetError() == isError, isError ? "an error" : "no error");
  const bool concerns =
    (test.Of != Normals || mapperClass.UsesNormals) && (test.Of != Radius || mapperClass.UsesRadii);
  if (test.Message.empty() || !concerns)
  {
    check(!observer->GetWarning(), "no warning " + message);
  }
  else
  {
    check(message.find(test.Message) != std::string::npos,
      "the warning says '" + test.Message + "': " + message);
  }
  observer->Clear();
  bad->Modified();
  window->Render();
  check(!observer->GetWarning(), "it is said once");

  const int drawn = CountCovered(bad);
  // where no radius can be estimated, some mappers know one that does
  check(test.Draws == (drawn > 0) || (test.Of == Estimates && !mapperClass.UsesRadii),
    std::to_string(drawn) + " pixels of it drawn");
  check.AtLeast(CountCovered(good), 800, "pixels of the good cloud");
  const Picture half = ReadGoodHalf(window);
  picture = picture.empty() ? half : picture;
  check(half == picture || test.CoversGood, "the good cloud is drawn as ever");
}

/// Estimates of normals and radii report progress through the mapper, which can stop them.
void TryAbort(const MapperClass& mapperClass)
{
  std::cout << "---- " << mapperClass.Name << ": estimates, aborted" << std::endl;
  vtkSmartPointer<vtkPolyData> cloud = MakeSphereCloud(2000);
  cloud->GetPointData()->Initialize();
  auto mapper = mapperClass.Make();
  mapper->SetInputData(cloud);
  vtkNew<vtkTest::ErrorObserver> observer;
  mapper->AddObserver(vtkCommand::WarningEvent, observer);
  struct
  {
    std::string Texts;
    void Abort(vtkObject* caller, unsigned long, void*)
    {
      auto* algorithm = static_cast<vtkAlgorithm*>(caller);
      this->Texts += algorithm->GetProgressText() ? algorithm->GetProgressText() : "";
      algorithm->AbortExecuteOn();
    }
  } aborter;
  const unsigned long tag = mapper->AddObserver(
    vtkCommand::ProgressEvent, &aborter, &std::remove_reference<decltype(aborter)>::type::Abort);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->AddRenderer(renderer);
  window->Render();
  check(aborter.Texts.find("Estimating normals") != std::string::npos &&
      aborter.Texts.find("Estimating radii") != std::string::npos,
    "progress is reported: " + aborter.Texts);
  check(observer->GetWarningMessage().find("aborted") != std::string::npos, "the warning says so");
  observer->Clear();
  mapper->RemoveObserver(tag);
  window->Render();
  check(!observer->GetWarning(), "the next frame is not aborted");
  check.AtLeast(CountCovered(mapper), 800, "and draws, in pixels");
}

struct Window
{
  vtkSmartPointer<vtkPointSurfaceMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> RenderWindow;

  Window(vtkPolyData* cloud, const MapperClass& mapperClass)
    : Mapper(mapperClass.Make())
  {
    this->Mapper->SetInputData(cloud);
    this->Mapper->SetBackendToOpenGL(); // what it leaves behind is most
    this->Actor->SetMapper(this->Mapper);
    this->Renderer->AddActor(this->Actor);
    this->RenderWindow->SetOffScreenRendering(1);
    this->RenderWindow->SetMultiSamples(0);
    this->RenderWindow->SetSize(200, 200);
    this->RenderWindow->AddRenderer(this->Renderer);
  }
};

void TryWindows(const MapperClass& mapperClass)
{
  std::cout << "---- " << mapperClass.Name << ": windows" << std::endl;
  vtkSmartPointer<vtkPolyData> cloud = mapperClass.MakeInput(MakeSphereCloud(2000));
  Window window(cloud, mapperClass);
  window.Renderer->SetViewport(0.0, 0.0, 0.0, 1.0);
  window.RenderWindow->Render();
  check(window.Mapper->GetLastFrameReconstructions() == 0, "a viewport of no width draws nothing");
  window.Renderer->SetViewport(0.0, 0.0, 1.0, 1.0);
  window.RenderWindow->Render();
  const int drawn = CountCovered(window.Mapper);
  check.AtLeast(drawn, 800, "and with a width it draws the cloud, in pixels");

  // a mapper of another window is destroyed while this window's context is current
  Window other(cloud, mapperClass);
  other.RenderWindow->Render();
  window.RenderWindow->Render();
  auto replacement = mapperClass.Make();
  replacement->SetInputData(cloud);
  {
    Window brief(cloud, mapperClass);
    brief.RenderWindow->Render();
    window.RenderWindow->MakeCurrent();
    brief.Actor->SetMapper(replacement);
  }
  window.Mapper->Modified();
  window.RenderWindow->Render();
  check(CountCovered(window.Mapper) == drawn, "the end of another window's mapper harms nothing");
}

/// More samples than a machine has memory for are lowered.
void TrySupersampling(const MapperClass& mapperClass)
{
  std::cout << "---- " << mapperClass.Name << ": a wide window, supersampled" << std::endl;
  Window window(mapperClass.MakeInput(MakeSphereCloud(2000)), mapperClass);
  window.Mapper->SetSupersampling(4);
  window.Renderer->ResetCamera();
  window.Renderer->GetActiveCamera()->Zoom(0.05); // few pixels to work on
  window.RenderWindow->SetSize(4000, 1000);
  vtkNew<vtkTest::ErrorObserver> observer;
  window.Mapper->AddObserver(vtkCommand::WarningEvent, observer);
  window.RenderWindow->Render();
  check(observer->GetWarningMessage().find("4000 x 1000") != std::string::npos,
    "the warning names the viewport: " + observer->GetWarningMessage());
  check(CountCovered(window.Mapper) > 0, "it is drawn all the same");
}

/// Normals and radii are estimated once for the same points, whatever else changes.
void TryEstimates(const MapperClass& mapperClass)
{
  std::cout << "---- " << mapperClass.Name << ": estimates" << std::endl;
  vtkSmartPointer<vtkPolyData> cloud = MakeSphereCloud(2000);
  cloud->GetPointData()->Initialize();
  Window window(cloud, mapperClass);
  struct
  {
    int Count = 0;
    void Add(vtkObject* caller, unsigned long, void*)
    {
      this->Count += static_cast<vtkAlgorithm*>(caller)->GetProgressText() != nullptr;
    }
  } estimates;
  window.Mapper->AddObserver(
    vtkCommand::ProgressEvent, &estimates, &std::remove_reference<decltype(estimates)>::type::Add);
  window.RenderWindow->Render();
  check.AtLeast(estimates.Count, 2, "progress events of the first frame's estimates");
  estimates.Count = 0;
  vtkNew<vtkFloatArray> scalars;
  scalars->SetNumberOfTuples(2000);
  scalars->Fill(1.0);
  cloud->GetPointData()->SetScalars(scalars);
  window.RenderWindow->Render();
  window.Mapper->SetRadius(0.1);
  window.RenderWindow->Render();
  check(estimates.Count == 0, "new scalars and another radius estimate nothing");
  cloud->GetPoints()->SetPoint(0, 0.0, 0.0, 2.0);
  cloud->GetPoints()->Modified();
  cloud->Modified();
  window.RenderWindow->Render();
  check.AtLeast(estimates.Count, 1, "progress events when a point has moved");
}
}

int TestHardInput(int, char*[])
{
  for (const MapperClass& mapperClass : GetMapperClasses())
  {
    TryWindows(mapperClass);
    if (mapperClass.UsesNormals && mapperClass.UsesRadii)
    {
      TryEstimates(mapperClass);
      TryAbort(mapperClass);
    }
    TrySupersampling(mapperClass);
    Picture picture;
    for (const Case& test : GetCases())
    {
      if (!mapperClass.DrawsSplats || test.Of == Points)
      {
        Try(test, mapperClass, picture);
      }
    }
    for (const Case& test : mapperClass.DrawsSplats ? GetSplatCases() : std::vector<Case>())
    {
      Try(test, mapperClass, picture, true);
    }
  }
  return check.GetResult();
}
