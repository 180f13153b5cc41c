// SPDX-License-Identifier: BSD-3-Clause
// With no display vtkRenderWindow::New() gives a window that renders by EGL, and it keeps the
// promises of a vtkRenderWindow: several windows, resize, finalize and render again, contexts,
// sharing, release at exit.

#include "vtkPointSurfaceCompat.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace
{
int failures = 0;

void Check(bool holds, const std::string& what)
{
  if (!holds)
  {
    std::cerr << "FAILED: " << what << std::endl;
    ++failures;
  }
}

// A sphere that nearly fills a black window.
struct Scene
{
  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  vtkNew<vtkRenderer> Renderer;
  vtkSmartPointer<vtkOpenGLRenderWindow> Window;

  Scene(int size, double red, double green)
    : Window(vtkOpenGLRenderWindow::SafeDownCast(
        vtkSmartPointer<vtkRenderWindow>::Take(vtkRenderWindow::New())))
  {
    this->Sphere->SetThetaResolution(64);
    this->Sphere->SetPhiResolution(64);
    this->Mapper->SetInputConnection(this->Sphere->GetOutputPort());
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->SetColor(red, green, 0.0);
    this->Renderer->AddActor(this->Actor);
    this->Window->AddRenderer(this->Renderer);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(size, size);
  }

  std::vector<unsigned char> Render()
  {
    this->Renderer->ResetCamera();
    this->Window->Render();
    const int* size = this->Window->GetSize();
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 1, pixels, 0);
    return std::vector<unsigned char>(
      pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
  }
};

// The share of pixels in which one of the three channels is over 0.
double LitShare(const std::vector<unsigned char>& pixels, int channel)
{
  std::size_t lit = 0;
  for (std::size_t i = channel; i < pixels.size(); i += 3)
  {
    lit += pixels[i] > 0;
  }
  return 3.0 * lit / pixels.size();
}

void TestDefaultClasses()
{
  vtkNew<vtkRenderWindow> window;
  Check(window->IsA("vtkPointSurfaceEGLRenderWindow"),
    std::string("the default window is a ") + window->GetClassName());
  vtkNew<vtkRenderWindowInteractor>
    interactor; // the test driver's; test_headless.py has the default
  interactor->SetRenderWindow(window);
  window->SetSize(123, 45);
  Check(interactor->GetSize()[0] == 123 && interactor->GetSize()[1] == 45,
    "the interactor is told of a new size");
}

// ResetCamera() places the eye at d = sqrt(3) r / sin(15 degrees) from a sphere of radius r, whose
// outline is then a disc of tan(asin(r / d)) / tan(15 degrees) = 0.564 of the half of a square
// window.
constexpr double sphereShare = 0.7854 * 0.564 * 0.564;

void TestWindows()
{
  Scene first(200, 1.0, 0.0);
  Scene second(301, 0.0, 1.0);
  Check(first.Window->SupportsOpenGL() == 1, "OpenGL is supported");
  const auto red = first.Render();
  const auto green = second.Render();
  Check(red.size() == 200 * 200 * 3, "the first window's size");
  Check(green.size() == 301 * 301 * 3, "the second window's size");
  Check(std::abs(LitShare(red, 0) - sphereShare) < 0.005 && LitShare(red, 1) == 0.0,
    "the first window shows its sphere, " + std::to_string(LitShare(red, 0)));
  Check(std::abs(LitShare(green, 1) - sphereShare) < 0.005 && LitShare(green, 0) == 0.0,
    "the second window shows its sphere, " + std::to_string(LitShare(green, 1)));
  Check(first.Render() == red, "the first window shows the same after the second has rendered");

  first.Window->SetSize(120, 80);
  const auto resized = first.Render();
  Check(resized.size() == 120 * 80 * 3, "the size after a resize");
  Check(std::abs(LitShare(resized, 0) * 120.0 / 80.0 - sphereShare) < 0.01,
    "the sphere after a resize");
  first.Window->SetSize(200, 200);
  Check(first.Render() == red, "the same picture at the size of before");

  first.Window->Finalize();
  Check(first.Window->GetGenericContext() == nullptr, "no context after Finalize");
  Check(first.Render() == red, "the same picture after Finalize");
  Check(second.Render() == green, "the other window is untouched by Finalize");
}

void TestMovedActor()
{
  Scene first(100, 1.0, 0.0);
  Scene second(100, 1.0, 0.0);
  const auto before = first.Render();
  second.Renderer->RemoveActor(second.Actor);
  second.Renderer->AddActor(first.Actor);
  Check(second.Render() == before, "an actor moved to another window");
  Check(first.Render() == before, "an actor moved back");
}

void TestContexts()
{
  Scene first(50, 1.0, 0.0);
  Scene second(50, 1.0, 0.0);
  first.Window->MakeCurrent(); // no context yet: does nothing
  Check(!first.Window->IsCurrent(), "a window that was never rendered is not current");
  first.Render();
  second.Render();
  Check(second.Window->IsCurrent() && !first.Window->IsCurrent(), "the last rendered is current");
  first.Window->PushContext();
  Check(first.Window->IsCurrent(), "PushContext makes current");
  second.Window->PushContext();
  first.Window->PushContext();
  first.Window->PopContext();
  Check(second.Window->IsCurrent(), "PopContext restores the context of a nested push");
  second.Window->PopContext();
  Check(first.Window->IsCurrent(), "PopContext restores the context of the outer push");
  first.Window->PopContext();
  Check(second.Window->IsCurrent(), "PopContext restores the context of before");
  second.Window->ReleaseCurrent();
  Check(!second.Window->IsCurrent(), "ReleaseCurrent");
  second.Window->MakeCurrent();
  Check(second.Window->IsCurrent(), "MakeCurrent");
}

void TestSharedWindow()
{
  Scene owner(150, 1.0, 0.0);
  Scene sharing(150, 1.0, 0.0);
  Scene alone(150, 1.0, 0.0);
  sharing.Window->SetSharedRenderWindow(owner.Window);
  const auto picture = owner.Render();
  Check(sharing.Render() == picture, "a window that shares");
  Check(sharing.Window->GetVBOCache() == owner.Window->GetVBOCache(), "buffers are shared");
  Check(alone.Render() == picture, "a window that does not share");
  Check(alone.Window->GetVBOCache() != owner.Window->GetVBOCache(), "buffers are not shared");

  // An object of one context is known in the context that shares, and in no other. Its name is
  // high, so that the window that does not share has none of the same name.
  owner.Window->MakeCurrent();
  std::vector<unsigned int> textures(1000);
  glGenTextures(static_cast<int>(textures.size()), textures.data());
  glBindTexture(GL_TEXTURE_2D, textures.back());
  sharing.Window->MakeCurrent();
  Check(glIsTexture(textures.back()) == GL_TRUE, "textures are shared");
  alone.Window->MakeCurrent();
  Check(glIsTexture(textures.back()) == GL_FALSE, "textures are not shared");

  sharing.Window->Finalize();
  Check(owner.Render() == picture, "the owner after the end of the window that shares");
  Check(sharing.Render() == picture, "a window that shares, after Finalize");
}
}

int TestEGLRenderWindow(int, char*[])
{
  TestDefaultClasses();
  TestWindows();
  TestMovedActor();
  TestContexts();
  TestSharedWindow();

  // Destroyed when the program ends, after the libraries have begun to clean up.
  static Scene atExit(50, 1.0, 0.0);
  Check(std::abs(LitShare(atExit.Render(), 0) - sphereShare) < 0.02, "a window of static storage");
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
