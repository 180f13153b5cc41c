// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSurfaceEGLRenderWindow
 * @brief   renders off screen with no display, by EGL
 *
 * Before 9.4 VTK chooses its OpenGL window when it is built; where that is a window of X, as in
 * Debian, nothing can be rendered without an X server. This window makes an OpenGL context by EGL:
 * on a device (a GPU, or Mesa's software renderer), else on Mesa's surfaceless platform, else on
 * the default display of EGL. It is never shown; all that is drawn goes to framebuffer objects.
 *
 * When this library is loaded with no display (the environment variable DISPLAY is unset or empty)
 * the class becomes the one that vtkRenderWindow::New() gives, and vtkGenericRenderWindowInteractor
 * the one of vtkRenderWindowInteractor::New(), so that a plain script works. With a display VTK's
 * own classes stay; this one can still be made by its name. (A thread cannot have a context of EGL
 * and one of GLX at once: call ReleaseCurrent() before a window of X is rendered.)
 *
 * DeviceIndex chooses among several devices; its default is the value of the environment variable
 * VTK_DEFAULT_EGL_DEVICE_INDEX, else 0. A device that gives no OpenGL core profile of 3.2 or later
 * is passed over for the next. SetSharedRenderWindow() with a window of this class shares OpenGL
 * objects with it; call it before the first Render().
 *
 * Where no context can be had, one error says why and what to do, SupportsOpenGL() returns 0, and
 * rendering does nothing. Finalize() clears this state, so that the next Render() tries again.
 *
 * @sa vtkEGLRenderWindow vtkGenericOpenGLRenderWindow
 */
#ifndef vtkPointSurfaceEGLRenderWindow_h
#define vtkPointSurfaceEGLRenderWindow_h

#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkPointSurfaceModule.h" // for export macro

#include <string> // for return value
#include <vector> // for the stack of contexts

class VTKPOINTSURFACE_EXPORT vtkPointSurfaceEGLRenderWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static vtkPointSurfaceEGLRenderWindow* New();
  vtkTypeMacro(vtkPointSurfaceEGLRenderWindow, vtkGenericOpenGLRenderWindow);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Initialize() makes the context, if there is none; Finalize() releases it and all that was made
   * in it. A window can be rendered again after Finalize().
   */
  void Initialize() override;
  void Finalize() override;
  void WindowRemap() override;
  ///@}

  ///@{
  /**
   * Renders, or does nothing where there is no OpenGL. Start() begins a frame.
   */
  void Render() override;
  void Start() override;
  ///@}

  ///@{
  /**
   * Makes this window's context the current one of the calling thread, releases it, or tells
   * whether it is current.
   */
  void MakeCurrent() override;
  void ReleaseCurrent() override;
  bool IsCurrent() override;
  ///@}

  ///@{
  /**
   * PushContext() remembers the context that is current and makes this window's current;
   * PopContext() makes the remembered one current again, if there was one.
   */
  void PushContext() override;
  void PopContext() override;
  ///@}

  /**
   * Returns 1 if this window has, or can make, an OpenGL context of version 3.2 or later, else 0.
   * GetOpenGLSupportMessage() tells the reason.
   */
  int SupportsOpenGL() override;

  /**
   * Text with vendor, renderer, version and extensions of OpenGL, or the reason why there is none.
   */
  const char* ReportCapabilities() override;

  /**
   * Number of EGL devices of this machine; 0 where EGL cannot list them.
   */
  int GetNumberOfDevices() override;

  ///@{
  /**
   * Size in pixels. An interactor is told of it.
   */
  void SetSize(int width, int height) override;
  void SetSize(int size[2]) override { this->SetSize(size[0], size[1]); }
  ///@}

  ///@{
  /**
   * As in the superclass; where there is no OpenGL, VTK_ERROR and sizes of 0, by which pickers and
   * selectors know that they can do nothing.
   */
  using Superclass::GetZbufferData;
  int GetZbufferData(int x1, int y1, int x2, int y2, float* depths) override;
  int GetColorBufferSizes(int* rgba) override;
  ///@}

  ///@{
  /**
   * The EGLDisplay and EGLContext in use; null before the first Render().
   */
  void* GetGenericDisplayId() override { return this->Display; }
  void* GetGenericContext() override { return this->Context; }
  ///@}

  void OpenGLInit() override;
  void OpenGLInitContext() override;

protected:
  vtkPointSurfaceEGLRenderWindow();
  ~vtkPointSurfaceEGLRenderWindow() override;

  void CreateAWindow() override;
  void DestroyWindow() override;

private:
  vtkPointSurfaceEGLRenderWindow(const vtkPointSurfaceEGLRenderWindow&) = delete;
  void operator=(const vtkPointSurfaceEGLRenderWindow&) = delete;

  // Each tries to make the context in its way and tells whether it could.
  bool CreateSharedContext();
  bool CreateContextOnDevice();
  bool CreateContext(void* display, void* sharedContext);

  void RefuseToRender(const std::string& reason);

  // EGL's own types, all of them void*; its header would bring X11's macros with it.
  void* Display = nullptr;
  void* Context = nullptr;
  void* Surface = nullptr;

  struct Current
  {
    void* Display;
    void* Draw;
    void* Read;
    void* Context;
  };
  std::vector<Current> ContextStack;
};

#endif
