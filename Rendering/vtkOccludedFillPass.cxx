// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOccludedFillPass.h"

#include "vtkMaskFillOptions.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkOccludedFillPass);

void vtkOccludedFillPass::SetOptions(vtkMaskFillOptions& options) const
{
  options.Occluded = true;
  options.DepthStep = this->GetDepthStep(this->LayerDistance);
}

void vtkOccludedFillPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LayerDistance: " << this->LayerDistance << "\n";
}
