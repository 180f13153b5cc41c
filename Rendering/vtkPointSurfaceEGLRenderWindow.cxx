// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceEGLRenderWindow.h"

#include "vtkPointSurfaceCompat.h"

#include "vtkGenericRenderWindowInteractor.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkRendererCollection.h"
#include "vtkRenderingOpenGLConfigure.h" // for VTK_USE_X
#include "vtkVersion.h"

#define EGL_NO_X11
#define MESA_EGL_NO_X11_HEADERS
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <cstdlib>

vtkStandardNewMacro(vtkPointSurfaceEGLRenderWindow);

namespace
{
//------------------------------------------------------------------------------
EGLDisplay GetPlatformDisplay(EGLenum platform, void* nativeDisplay)
{
  static const auto getDisplay = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
    eglGetProcAddress("eglGetPlatformDisplayEXT"));
  return getDisplay ? getDisplay(platform, nativeDisplay, nullptr) : EGL_NO_DISPLAY;
}

//------------------------------------------------------------------------------
std::vector<EGLDeviceEXT> QueryDevices()
{
  static const auto queryDevices =
    reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  EGLint count = 0;
  if (!queryDevices || !queryDevices(0, nullptr, &count))
  {
    return {};
  }
  std::vector<EGLDeviceEXT> devices(count);
  queryDevices(count, devices.data(), &count);
  return devices;
}

//------------------------------------------------------------------------------
EGLContext CreateCoreContext(EGLDisplay display, EGLConfig config, EGLContext sharedContext)
{
  // A driver may give just the version that is asked for, so the newest is asked for first.
  constexpr EGLint versions[][2] = { { 4, 6 }, { 4, 5 }, { 4, 3 }, { 3, 3 }, { 3, 2 } };
  for (const auto& version : versions)
  {
    const EGLint attributes[] = { EGL_CONTEXT_MAJOR_VERSION, version[0], EGL_CONTEXT_MINOR_VERSION,
      version[1], EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
    EGLContext context = eglCreateContext(display, config, sharedContext, attributes);
    if (context != EGL_NO_CONTEXT)
    {
      return context;
    }
  }
  return EGL_NO_CONTEXT;
}
}

//------------------------------------------------------------------------------
vtkPointSurfaceEGLRenderWindow::vtkPointSurfaceEGLRenderWindow()
{
  this->SetOwnContext(1);
  this->FrameBlitMode = NoBlit;
  this->UseOffScreenBuffers = true;
  this->ShowWindow = false;
  this->ScreenSize[0] = 1920;
  this->ScreenSize[1] = 1080;
  if (const char* index = std::getenv("VTK_DEFAULT_EGL_DEVICE_INDEX"))
  {
    this->DeviceIndex = std::atoi(index);
  }
}

//------------------------------------------------------------------------------
vtkPointSurfaceEGLRenderWindow::~vtkPointSurfaceEGLRenderWindow()
{
  this->Finalize();
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::Initialize()
{
  if (this->Context || !this->ReadyForRendering)
  {
    return;
  }
  this->CreateAWindow();
  if (!this->Context)
  {
    return;
  }
  vtkCollectionSimpleIterator iterator;
  this->Renderers->InitTraversal(iterator);
  while (vtkRenderer* renderer = this->Renderers->GetNextRenderer(iterator))
  {
    renderer->SetRenderWindow(nullptr);
    renderer->SetRenderWindow(this);
  }
  this->OpenGLInit();
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::Finalize()
{
  if (this->Context)
  {
    this->MakeCurrent();
    this->ReleaseGraphicsResources(this);
    this->DestroyWindow();
  }
  this->ReadyForRendering = true;
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::WindowRemap()
{
  this->Finalize();
  this->Initialize();
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::CreateAWindow()
{
  eglBindAPI(EGL_OPENGL_API);
  if (this->CreateSharedContext() || this->CreateContextOnDevice() ||
    this->CreateContext(
      GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY), EGL_NO_CONTEXT) ||
    this->CreateContext(eglGetDisplay(EGL_DEFAULT_DISPLAY), EGL_NO_CONTEXT))
  {
    return;
  }
  const int devices = this->GetNumberOfDevices();
  if (devices == 0)
  {
    this->RefuseToRender(
      "Nothing can be rendered: there is no display, and EGL finds no device. Install the packages "
      "libegl1 and libgl1-mesa-dri (Mesa's software renderer needs no GPU) or the EGL part of the "
      "GPU's driver, or set DISPLAY.");
  }
  else
  {
    this->RefuseToRender("Nothing can be rendered: there is no display, and none of the " +
      std::to_string(devices) +
      " EGL devices gives an OpenGL core profile of version 3.2 or later. Install the package "
      "libgl1-mesa-dri (Mesa's software renderer, 11.2 or later) or a newer driver of the GPU, or "
      "set DISPLAY.");
  }
}

//------------------------------------------------------------------------------
bool vtkPointSurfaceEGLRenderWindow::CreateSharedContext()
{
  auto* shared = vtkPointSurfaceEGLRenderWindow::SafeDownCast(this->SharedRenderWindow);
  if (!shared)
  {
    return false;
  }
  shared->Initialize();
  if (!shared->Context || !this->CreateContext(shared->Display, shared->Context))
  {
    return false;
  }
  this->GetState()->SetVBOCache(shared->GetState()->GetVBOCache());
  return true;
}

//------------------------------------------------------------------------------
bool vtkPointSurfaceEGLRenderWindow::CreateContextOnDevice()
{
  const std::vector<EGLDeviceEXT> devices = QueryDevices();
  const int count = static_cast<int>(devices.size());
  std::vector<int> order;
  if (this->DeviceIndex >= 0 && this->DeviceIndex < count)
  {
    order.push_back(this->DeviceIndex);
  }
  for (int index = 0; index < count; ++index)
  {
    if (index != this->DeviceIndex)
    {
      order.push_back(index);
    }
  }
  const auto used = std::find_if(order.begin(), order.end(),
    [&](int index)
    {
      return this->CreateContext(
        GetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[index]), EGL_NO_CONTEXT);
    });
  if (used == order.end())
  {
    return false;
  }
  // Index 0 is the default: nobody asked for that device.
  if (this->DeviceIndex != 0 && this->DeviceIndex != *used)
  {
    vtkWarningMacro(
      "EGL device " << this->DeviceIndex << " (DeviceIndex or the environment variable "
                    << "VTK_DEFAULT_EGL_DEVICE_INDEX) cannot be used; device " << *used << " of "
                    << count << " (0 to " << count - 1 << ") is used instead.");
  }
  this->DeviceIndex = *used;
  return true;
}

//------------------------------------------------------------------------------
bool vtkPointSurfaceEGLRenderWindow::CreateContext(void* display, void* sharedContext)
{
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
  {
    return false;
  }
  const EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
    EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_NONE };
  EGLConfig config;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0)
  {
    return false;
  }
  this->Context = CreateCoreContext(display, config, sharedContext);
  if (this->Context == EGL_NO_CONTEXT)
  {
    return false;
  }
  this->Display = display;
  // Nothing is drawn to the surface: VTK's state reads the buffers of framebuffer 0, so that one
  // has to exist.
  const EGLint size[] = { EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE };
  this->Surface = eglCreatePbufferSurface(display, config, size);
  if (!eglMakeCurrent(display, this->Surface, this->Surface, this->Context))
  {
    this->DestroyWindow();
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::DestroyWindow()
{
  if (!this->Context)
  {
    return;
  }
  this->ReleaseCurrent();
  if (this->Surface)
  {
    eglDestroySurface(this->Display, this->Surface);
  }
  eglDestroyContext(this->Display, this->Context);
  // The display is not terminated: all windows of the process, of other libraries too, have it in
  // common.
  this->Display = nullptr;
  this->Context = nullptr;
  this->Surface = nullptr;
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::RefuseToRender(const std::string& reason)
{
  this->OpenGLSupportMessage = reason;
  this->ReadyForRendering = false;
  vtkErrorMacro(<< reason);
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::OpenGLInit()
{
  // The superclass saves the state of a context that belongs to somebody else, with functions that
  // are not loaded yet.
  this->vtkOpenGLRenderWindow::OpenGLInit();
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::OpenGLInitContext()
{
  if (this->Initialized)
  {
    return;
  }
  this->ContextCreationTime.Modified();
  glewExperimental = GL_TRUE;
  const GLenum result = glewInit();
  // GLEW first loads OpenGL's functions and then looks for GLX, which is not there.
  this->GlewInitValid = (result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY);
  if (!this->GlewInitValid || !GLEW_VERSION_3_2)
  {
    this->DestroyWindow();
    this->RefuseToRender("Nothing can be rendered: GLEW cannot load the functions of OpenGL 3.2 "
                         "from an EGL context. Install the packages libegl1 and libgl1-mesa-dri.");
    return;
  }
  this->Initialized = true;
  this->OpenGLSupportMessage = "OpenGL 3.2 or later by EGL";

  GLfloat widths[2] = { 1.0f, 1.0f };
  glGetFloatv(
    this->LineSmoothing ? GL_SMOOTH_LINE_WIDTH_RANGE : GL_ALIASED_LINE_WIDTH_RANGE, widths);
  this->MaximumHardwareLineWidth = widths[1];
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::Render()
{
  this->Initialize();
  if (this->Initialized)
  {
    // The context is this window's own, so the superclass need not save and restore its state.
    this->vtkOpenGLRenderWindow::Render();
  }
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::Start()
{
  this->Initialize();
  if (this->Initialized)
  {
    this->Superclass::Start();
  }
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::MakeCurrent()
{
  if (!this->Context || this->IsCurrent())
  {
    return;
  }
  if (!eglMakeCurrent(this->Display, this->Surface, this->Surface, this->Context))
  {
    vtkErrorMacro("The EGL context cannot be made current (EGL error "
      << eglGetError()
      << "): is it current in another thread, or a context of GLX current in this one?");
  }
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::ReleaseCurrent()
{
  if (this->IsCurrent())
  {
    eglMakeCurrent(this->Display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
}

//------------------------------------------------------------------------------
bool vtkPointSurfaceEGLRenderWindow::IsCurrent()
{
  return this->Context && eglGetCurrentContext() == this->Context;
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::PushContext()
{
  this->ContextStack.push_back({ eglGetCurrentDisplay(), eglGetCurrentSurface(EGL_DRAW),
    eglGetCurrentSurface(EGL_READ), eglGetCurrentContext() });
  this->MakeCurrent();
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::PopContext()
{
  if (this->ContextStack.empty())
  {
    return;
  }
  const Current last = this->ContextStack.back();
  this->ContextStack.pop_back();
  if (last.Context && last.Context != eglGetCurrentContext())
  {
    eglMakeCurrent(last.Display, last.Draw, last.Read, last.Context);
  }
}

//------------------------------------------------------------------------------
int vtkPointSurfaceEGLRenderWindow::SupportsOpenGL()
{
  this->Initialize();
  return this->Initialized ? 1 : 0;
}

//------------------------------------------------------------------------------
const char* vtkPointSurfaceEGLRenderWindow::ReportCapabilities()
{
  this->Initialize();
  return this->Initialized ? this->Superclass::ReportCapabilities()
                           : this->OpenGLSupportMessage.c_str();
}

//------------------------------------------------------------------------------
int vtkPointSurfaceEGLRenderWindow::GetNumberOfDevices()
{
  return static_cast<int>(QueryDevices().size());
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::SetSize(int width, int height)
{
  this->Superclass::SetSize(width, height);
  if (this->Interactor)
  {
    this->Interactor->SetSize(width, height);
  }
}

//------------------------------------------------------------------------------
int vtkPointSurfaceEGLRenderWindow::GetZbufferData(int x1, int y1, int x2, int y2, float* depths)
{
  return this->ReadyForRendering ? this->Superclass::GetZbufferData(x1, y1, x2, y2, depths)
                                 : VTK_ERROR;
}

//------------------------------------------------------------------------------
int vtkPointSurfaceEGLRenderWindow::GetColorBufferSizes(int* rgba)
{
  if (this->ReadyForRendering)
  {
    return this->Superclass::GetColorBufferSizes(rgba);
  }
  std::fill_n(rgba, 4, 0);
  return 0;
}

//------------------------------------------------------------------------------
void vtkPointSurfaceEGLRenderWindow::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Display: " << this->Display << "\n";
  os << indent << "Context: " << this->Context << "\n";
  os << indent << "Surface: " << this->Surface << "\n";
}

//------------------------------------------------------------------------------
// The window as VTK's default where there is no display.
namespace
{
VTK_CREATE_CREATE_FUNCTION(vtkPointSurfaceEGLRenderWindow);
VTK_CREATE_CREATE_FUNCTION(vtkGenericRenderWindowInteractor);

class HeadlessFactory : public vtkObjectFactory
{
public:
  static HeadlessFactory* New() { VTK_STANDARD_NEW_BODY(HeadlessFactory); }
  vtkTypeMacro(HeadlessFactory, vtkObjectFactory);
  const char* GetVTKSourceVersion() VTK_FUTURE_CONST override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() VTK_FUTURE_CONST override
  {
    return "PointSurface: rendering with no display";
  }

protected:
  HeadlessFactory()
  {
    this->RegisterOverride("vtkRenderWindow", "vtkPointSurfaceEGLRenderWindow",
      "a window with no display, by EGL", 1, vtkObjectFactoryCreatevtkPointSurfaceEGLRenderWindow);
    // VTK's own interactor of X crashes with no display.
    this->RegisterOverride("vtkRenderWindowInteractor", "vtkGenericRenderWindowInteractor",
      "an interactor with no display", 1, vtkObjectFactoryCreatevtkGenericRenderWindowInteractor);
  }
};

bool RegisterHeadlessFactory()
{
#ifndef VTK_USE_X
  return false; // a VTK built for EGL or OSMesa has a window that needs no display
#endif
  const char* display = std::getenv("DISPLAY");
  if (display && *display)
  {
    return false;
  }
  // The first factory that overrides a class wins: those that were registered earlier are
  // disabled, and those that come later find this one before them.
  vtkObjectFactory::SetAllEnableFlags(0, "vtkRenderWindow");
  vtkObjectFactory::SetAllEnableFlags(0, "vtkRenderWindowInteractor");
  vtkNew<HeadlessFactory> factory;
  vtkObjectFactory::RegisterFactory(factory);
  return true;
}

const bool headlessFactoryIsRegistered = RegisterHeadlessFactory();
}
