// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfaceMapper.h"

#include "vtkImageData.h"

vtkPointSurfaceMapper::vtkPointSurfaceMapper() = default;

vtkPointSurfaceMapper::~vtkPointSurfaceMapper()
{
  this->SetRadiusArray(nullptr);
}

bool vtkPointSurfaceMapper::ReadSurfaceBuffer(vtkImageData*)
{
  return false;
}

void vtkPointSurfaceMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
