// SPDX-License-Identifier: BSD-3-Clause
// Clouds that cannot be drawn as they are: each gives one message that names what is wrong, and a
// frame, and the good cloud beside it is drawn as if the bad one were not there.

#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPullPushMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
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

struct Case
{
  std::string Name;
  std::function<void(vtkPolyData*, vtkPullPushMapper*)> Spoil;
  std::string Message; // part of the warning that is expected; empty for none
  bool Draws;          // whether the cloud shows all the same
};

vtkFloatArray* Radii(vtkPolyData* cloud)
{
  return vtkFloatArray::SafeDownCast(cloud->GetPointData()->GetArray("radius"));
}

void KeepPoints(vtkPolyData* cloud, vtkIdType count)
{
  cloud->GetPoints()->Resize(count);
  cloud->GetPoints()->SetNumberOfPoints(count);
  cloud->GetPointData()->GetNormals()->SetNumberOfTuples(count);
  Radii(cloud)->SetNumberOfTuples(count);
}

void AddGhosts(vtkPolyData* cloud, vtkIdType count)
{
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  ghosts->SetNumberOfValues(count);
  ghosts->Fill(vtkDataSetAttributes::HIDDENPOINT);
  cloud->GetPointData()->AddArray(ghosts);
}

std::vector<Case> GetCases()
{
  using Mapper = vtkPullPushMapper;
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
      "", false },
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
      true },
    { "zero normals", [](vtkPolyData* c, Mapper*) { c->GetPointData()->GetNormals()->Fill(0.0); },
      "Array 'Normals' has 2000 normals that are zero", true },
    { "a NaN normal",
      [](vtkPolyData* c, Mapper*) { c->GetPointData()->GetNormals()->SetTuple3(5, NaN, 0.0, 1.0); },
      "1 that are not finite (the first is of point 5)", true },
    { "normals of no unit length",
      [](vtkPolyData* c, Mapper*)
      {
        vtkDataArray* normals = c->GetPointData()->GetNormals();
        for (vtkIdType i = 0; i < normals->GetNumberOfTuples(); ++i)
        {
          const double* n = normals->GetTuple3(i);
          const double size = i % 2 ? 1e-6 : 1e6;
          normals->SetTuple3(i, size * n[0], size * n[1], size * n[2]);
        }
      },
      "", true },
    { "a radius of zero", [](vtkPolyData* c, Mapper*) { Radii(c)->SetValue(7, 0.0f); },
      "the first is 0 of point 7", true },
    { "a negative radius", [](vtkPolyData* c, Mapper*) { Radii(c)->SetValue(7, -1.0f); },
      "the first is -1 of point 7", true },
    { "a NaN radius", [](vtkPolyData* c, Mapper*) { Radii(c)->SetValue(7, NaN); },
      "1 of 2000 radii in array 'radius' are not positive and finite", true },
    { "all radii zero", [](vtkPolyData* c, Mapper*) { Radii(c)->Fill(0.0); },
      "radii are estimated instead", true },
    { "a huge radius", [](vtkPolyData* c, Mapper*) { Radii(c)->SetValue(7, 1e30f); },
      "larger than the whole cloud", true },
    { "an array that is not there", [](vtkPolyData*, Mapper* m) { m->SetRadiusArray("thickness"); },
      "no point array 'thickness'", true },
    { "an array of normals as radii", [](vtkPolyData*, Mapper* m) { m->SetRadiusArray("Normals"); },
      "values of 3 components", true },
    { "too few radii", [](vtkPolyData* c, Mapper*) { Radii(c)->SetNumberOfTuples(10); },
      "Array 'radius' has 10 values", true },
    { "too few normals",
      [](vtkPolyData* c, Mapper*) { c->GetPointData()->GetNormals()->SetNumberOfTuples(10); },
      "Array 'Normals' has 10 normals", true },
    { "a radius larger than the cloud", [](vtkPolyData*, Mapper* m) { m->SetRadius(1e30); },
      "The radius 1e+30 is larger than the whole cloud", true },
    { "all points hidden", [](vtkPolyData* c, Mapper*) { AddGhosts(c, 2000); }, "hidden", false },
    { "too few ghosts", [](vtkPolyData* c, Mapper*) { AddGhosts(c, 10); },
      "Array 'vtkGhostType' has 10 values for 2000 points", true },
    { "the eye amid the points",
      [](vtkPolyData* c, Mapper*)
      {
        for (vtkIdType i = 0; i < c->GetNumberOfPoints(); ++i)
        {
          double* x = c->GetPoint(i);
          c->GetPoints()->SetPoint(i, 50.0 * x[0], 50.0 * x[1], 50.0 * x[2]);
        }
      },
      "", true },
  };
}

/// Pixels of the surface buffer with a surface.
int CountCovered(vtkPullPushMapper* mapper)
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

void Try(const Case& test)
{
  std::cout << "---- " << test.Name << std::endl;
  vtkNew<vtkPullPushMapper> good;
  good->SetInputData(MakeSphereCloud(2000));
  vtkNew<vtkActor> goodActor;
  goodActor->SetMapper(good);
  goodActor->SetPosition(1.5, 0.0, 0.0);

  vtkSmartPointer<vtkPolyData> cloud = MakeSphereCloud(2000);
  vtkNew<vtkPullPushMapper> bad;
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

  const std::string message = observer->GetWarningMessage();
  check(!observer->GetError(), "no error");
  if (test.Message.empty())
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
  check(test.Draws == (drawn > 0), std::to_string(drawn) + " pixels of it drawn");
  check.AtLeast(CountCovered(good), 800, "pixels of the good cloud");
}

/// Estimates of normals and radii report progress through the mapper, which can stop them.
void TryAbort()
{
  std::cout << "---- estimates, aborted" << std::endl;
  vtkSmartPointer<vtkPolyData> cloud = MakeSphereCloud(2000);
  cloud->GetPointData()->Initialize();
  vtkNew<vtkPullPushMapper> mapper;
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
  mapper->AddObserver(
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
}

struct Window
{
  vtkNew<vtkPullPushMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> RenderWindow;

  explicit Window(vtkPolyData* cloud)
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

void TryWindows()
{
  std::cout << "---- windows" << std::endl;
  vtkSmartPointer<vtkPolyData> cloud = MakeSphereCloud(2000);
  Window window(cloud);
  window.Renderer->SetViewport(0.0, 0.0, 0.0, 1.0);
  window.RenderWindow->Render();
  check(window.Mapper->GetLastFrameReconstructions() == 0, "a viewport of no width draws nothing");
  window.Renderer->SetViewport(0.0, 0.0, 1.0, 1.0);
  window.RenderWindow->Render();
  const int drawn = CountCovered(window.Mapper);
  check.AtLeast(drawn, 800, "and with a width it draws the cloud, in pixels");

  // a mapper of another window is destroyed while this window's context is current
  Window other(cloud);
  other.RenderWindow->Render();
  window.RenderWindow->Render();
  vtkNew<vtkPullPushMapper> replacement;
  replacement->SetInputData(cloud);
  {
    Window brief(cloud);
    brief.RenderWindow->Render();
    window.RenderWindow->MakeCurrent();
    brief.Actor->SetMapper(replacement);
  }
  window.Mapper->Modified();
  window.RenderWindow->Render();
  check(CountCovered(window.Mapper) == drawn, "the end of another window's mapper harms nothing");
}

/// Normals and radii are estimated once for the same points, whatever else changes.
void TryEstimates()
{
  std::cout << "---- estimates" << std::endl;
  vtkSmartPointer<vtkPolyData> cloud = MakeSphereCloud(2000);
  cloud->GetPointData()->Initialize();
  Window window(cloud);
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
  TryWindows();
  TryEstimates();
  TryAbort();
  for (const Case& test : GetCases())
  {
    Try(test);
  }
  return check.GetResult();
}
