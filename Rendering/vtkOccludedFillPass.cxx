// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOccludedFillPass.h"

#include "vtkMaskFillOpenGL.h"
#include "vtkMaskFillOptions.h"

#include "vtkObjectFactory.h"

class vtkOccludedFillPass::vtkInternals
{
public:
  vtkMaskFillOpenGL Fill;
};

vtkStandardNewMacro(vtkOccludedFillPass);

vtkOccludedFillPass::vtkOccludedFillPass()
  : Internals(new vtkInternals)
{
}

vtkOccludedFillPass::~vtkOccludedFillPass() = default;

void vtkOccludedFillPass::Filter(
  vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare)
{
  vtkMaskFillOptions options;
  options.Occluded = true;
  options.DepthStep = this->GetDepthStep(this->LayerDistance);
  options.MaximumIterations = this->MaximumIterations;
  options.Reach = this->KeepOutlines ? (this->MaximumIterations + 1) / 2 : 0;
  int passes = 0;
  this->LastFrameIterations =
    this->Internals->Fill.Run(window, options, this->GetRectangle(), image, spare, passes);
}

void vtkOccludedFillPass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  this->Internals->Fill.ReleaseGraphicsResources();
}

void vtkOccludedFillPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LayerDistance: " << this->LayerDistance << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "KeepOutlines: " << this->KeepOutlines << "\n";
  os << indent << "LastFrameIterations: " << this->LastFrameIterations << "\n";
}
