// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBackgroundFillPass.h"

#include "vtkMaskFillOpenGL.h"
#include "vtkMaskFillOptions.h"

#include "vtkObjectFactory.h"

class vtkBackgroundFillPass::vtkInternals
{
public:
  vtkMaskFillOpenGL Fill;
};

vtkStandardNewMacro(vtkBackgroundFillPass);

vtkBackgroundFillPass::vtkBackgroundFillPass()
  : Internals(new vtkInternals)
{
}

vtkBackgroundFillPass::~vtkBackgroundFillPass() = default;

void vtkBackgroundFillPass::Filter(
  vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare)
{
  vtkMaskFillOptions options;
  options.MaximumIterations = this->MaximumIterations;
  options.Reach = this->KeepOutlines ? (this->MaximumIterations + 1) / 2 : 0;
  int passes = 0;
  this->LastFrameIterations =
    this->Internals->Fill.Run(window, options, this->GetRectangle(), image, spare, passes);
}

void vtkBackgroundFillPass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  this->Internals->Fill.ReleaseGraphicsResources();
}

void vtkBackgroundFillPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "KeepOutlines: " << this->KeepOutlines << "\n";
  os << indent << "LastFrameIterations: " << this->LastFrameIterations << "\n";
}
