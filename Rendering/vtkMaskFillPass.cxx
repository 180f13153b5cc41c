// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMaskFillPass.h"

#include "vtkMaskFillOpenGL.h"
#include "vtkMaskFillOptions.h"

class vtkMaskFillPass::vtkInternals
{
public:
  vtkMaskFillOpenGL Fill;
};

vtkMaskFillPass::vtkMaskFillPass()
  : Internals(new vtkInternals)
{
}

vtkMaskFillPass::~vtkMaskFillPass() = default;

void vtkMaskFillPass::Filter(
  vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare)
{
  vtkMaskFillOptions options;
  this->SetOptions(options);
  options.MaximumIterations = this->MaximumIterations;
  options.Reach = this->KeepOutlines ? (this->MaximumIterations + 1) / 2 : 0;
  int passes = 0;
  this->LastFrameIterations =
    this->Internals->Fill.Run(window, options, this->GetRectangle(), image, spare, passes);
}

void vtkMaskFillPass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  this->Internals->Fill.ReleaseGraphicsResources();
}

void vtkMaskFillPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "KeepOutlines: " << this->KeepOutlines << "\n";
  os << indent << "LastFrameIterations: " << this->LastFrameIterations << "\n";
}
