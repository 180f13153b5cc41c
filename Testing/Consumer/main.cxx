// SPDX-License-Identifier: BSD-3-Clause
// Draws points with the installed library and tells by the exit code whether they cover what they
// should.

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPullPushMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>

#include <iostream>

int main()
{
  vtkNew<vtkSphereSource> points;
  points->SetThetaResolution(100);
  points->SetPhiResolution(100);
  vtkNew<vtkPullPushMapper> mapper;
  mapper->SetInputConnection(points->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(200, 200);
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  interactor->Initialize();
  interactor->Start();

  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, 199, 199, 1, pixels, 0);
  int lit = 0;
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    lit += pixels->GetTypedComponent(i, 0) > 0;
  }
  // The disc that the sphere shows is a quarter of the window (see TestEGLRenderWindow.cxx).
  std::cout << window->GetClassName() << ", " << interactor->GetClassName() << ": " << lit
            << " lit pixels of 10000 expected\n";
  return lit > 9000 && lit < 12500 ? EXIT_SUCCESS : EXIT_FAILURE;
}
