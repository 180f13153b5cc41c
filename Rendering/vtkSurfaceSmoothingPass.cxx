// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceSmoothingPass.h"

#include "vtkSurfaceSmoothingOpenGL.h"
#include "vtkSurfaceSmoothingOptions.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <utility>

class vtkSurfaceSmoothingPass::vtkInternals
{
public:
  vtkSurfaceSmoothingOpenGL Step;
};

vtkStandardNewMacro(vtkSurfaceSmoothingPass);

vtkSurfaceSmoothingPass::vtkSurfaceSmoothingPass()
  : Internals(new vtkInternals)
{
}

vtkSurfaceSmoothingPass::~vtkSurfaceSmoothingPass() = default;

void vtkSurfaceSmoothingPass::Filter(
  vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare)
{
  vtkSurfaceSmoothingOptions options = vtkSurfaceSmoothingOptions::FromKernel(this->Kernel);
  options.DepthStep = this->GetDepthStep(std::min<double>(this->LayerDistance, VTK_FLOAT_MAX));
  for (int i = 0; i < this->Iterations; ++i)
  {
    this->Internals->Step.Run(window, options, this->GetRectangle(), *image, *spare);
    std::swap(image, spare);
  }
}

void vtkSurfaceSmoothingPass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  this->Internals->Step.ReleaseGraphicsResources();
}

void vtkSurfaceSmoothingPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Iterations: " << this->Iterations << "\n";
  os << indent << "Kernel: " << this->Kernel << "\n";
  os << indent << "LayerDistance: " << this->LayerDistance << "\n";
}
