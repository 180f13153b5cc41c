// SPDX-License-Identifier: BSD-3-Clause
// For every mapper and both back ends: what is made for a cloud goes with it. Over 100 mappers that
// are rendered and deleted in a window that stays, the number of live OpenGL objects and the
// resident memory stay the same; and an OpenGL error is reported in every build.

#include "PointSurfaceTestMappers.h"
#include "PointSurfaceTestUtilities.h"

#include "vtkActor.h"
#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPointSurfaceCompat.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTestErrorObserver.h"

#include <fstream>
#include <map>

using namespace PointSurfaceTest;

namespace
{
Checks check;

/// Names of OpenGL objects are small numbers: those that are in use are found by asking for each.
std::map<std::string, int> CountObjects()
{
  constexpr GLuint Names = 20000;
  std::map<std::string, int> counts;
  for (GLuint name = 1; name < Names; ++name)
  {
    counts["textures"] += glIsTexture(name);
    counts["buffers"] += glIsBuffer(name);
    counts["framebuffers"] += glIsFramebuffer(name);
    counts["renderbuffers"] += glIsRenderbuffer(name);
    counts["vertex arrays"] += glIsVertexArray(name);
    counts["programs"] += glIsProgram(name);
    counts["shaders"] += glIsShader(name);
    counts["queries"] += glIsQuery(name);
  }
  return counts;
}

/// Kilobytes; 0 where the system does not tell.
long GetResidentMemory()
{
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word)
  {
    if (word == "VmRSS:")
    {
      long size = 0;
      file >> size;
      return size;
    }
  }
  return 0;
}

struct Window
{
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> RenderWindow;

  Window()
  {
    this->RenderWindow->SetOffScreenRendering(1);
    this->RenderWindow->SetMultiSamples(0);
    this->RenderWindow->SetSize(100, 100);
    this->RenderWindow->AddRenderer(this->Renderer);
    this->Renderer->GetActiveCamera()->SetPosition(0.0, 0.0, 5.0);
    this->Renderer->GetActiveCamera()->SetClippingRange(1.0, 10.0);
  }
};

void RenderAndDelete(Window& window, const MapperClass& mapperClass, vtkPolyData* input, int round)
{
  auto mapper = mapperClass.Make();
  mapper->SetBackend(round % 2 == 0 ? vtkPointSurfaceMapper::OpenGL : vtkPointSurfaceMapper::CPU);
  mapper->SetSupersampling(1 + round / 2 % 2);
  mapper->SetRecordPointIds(round % 3 == 0);
  vtkNew<vtkPolyData> cloud;
  cloud->DeepCopy(input);
  mapper->SetInputData(cloud);
  vtkNew<vtkPlane> plane;
  mapper->AddClippingPlane(plane);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  window.Renderer->AddActor(actor);
  window.RenderWindow->Render();
  window.Renderer->RemoveActor(actor);
}

void TryLoop(const MapperClass& mapperClass)
{
  std::cout << "---- " << mapperClass.Name << ": rendered and deleted" << std::endl;
  constexpr int Period = 12; // of RenderAndDelete()'s settings
  Window window;
  auto input = mapperClass.MakeInput(MakeSphereCloud(2000));
  for (int i = 0; i < 3 * Period; ++i)
  {
    RenderAndDelete(window, mapperClass, input, i);
  }
  const auto before = CountObjects();
  const long memory = GetResidentMemory();
  for (int i = 0; i < 100; ++i)
  {
    RenderAndDelete(window, mapperClass, input, i);
  }
  for (const auto& count : CountObjects())
  {
    std::cout << count.first << ": " << count.second << std::endl;
    check(count.second == before.at(count.first),
      count.first + " before: " + std::to_string(before.at(count.first)) +
        ", and after: " + std::to_string(count.second));
  }
  // one cloud and its surface buffer are over 300 kB; allocators keep some of what they had
  check.AtMost(GetResidentMemory() - memory, 3000, "growth of memory over 100 clouds, kB");
}

/// An error that is made while the mapper draws is told, and the next frame is free of it.
void TryError(const MapperClass& mapperClass)
{
  std::cout << "---- " << mapperClass.Name << ": an error of OpenGL" << std::endl;
  Window window;
  auto mapper = mapperClass.Make();
  mapper->SetInputData(mapperClass.MakeInput(MakeSphereCloud(2000)));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  window.Renderer->AddActor(actor);
  vtkNew<vtkTest::ErrorObserver> observer;
  mapper->AddObserver(vtkCommand::ErrorEvent, observer);
  window.RenderWindow->Render();
  check(!observer->GetError(), "no error: " + observer->GetErrorMessage());
  vtkNew<vtkCallbackCommand> spoil;
  spoil->SetCallback([](vtkObject*, unsigned long, void*, void*) { glEnable(0xffff); });
  const unsigned long tag = mapper->AddObserver(vtkCommand::UpdateShaderEvent, spoil);
  window.RenderWindow->Render();
  check(observer->GetErrorMessage().find("Invalid enum") != std::string::npos,
    "the error is named: " + observer->GetErrorMessage());
  observer->Clear();
  mapper->RemoveObserver(tag);
  window.RenderWindow->Render();
  check(!observer->GetError(), "the next frame has none");
}
}

int TestCleanUp(int, char*[])
{
  for (const MapperClass& mapperClass : GetMapperClasses())
  {
    TryLoop(mapperClass);
    TryError(mapperClass);
  }
  return check.GetResult();
}
