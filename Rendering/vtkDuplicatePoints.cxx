// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDuplicatePoints.h"

#include "vtkContextNeeds.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace
{
size_t NumberOfTexels(size_t points)
{
  return (points + 3) / 4;
}
}

vtkDuplicatePoints::vtkDuplicatePoints() = default;
vtkDuplicatePoints::~vtkDuplicatePoints() = default;

std::string vtkDuplicatePoints::FindLack(size_t points)
{
  return vtkContextNeeds::FindLackOfTextureBuffers(static_cast<vtkIdType>(NumberOfTexels(points)));
}

void vtkDuplicatePoints::Activate(
  vtkOpenGLRenderWindow* window, const std::vector<unsigned char>& points, vtkMTimeType time)
{
  if (this->Time != time)
  {
    std::vector<unsigned char> texels = points;
    texels.resize(4 * NumberOfTexels(points.size()));
    this->ReleaseGraphicsResources(window);
    this->Buffer->Upload(texels, vtkOpenGLBufferObject::TextureBuffer);
    this->Texels->SetContext(window);
    this->Texels->CreateTextureBuffer(
      static_cast<unsigned int>(NumberOfTexels(points.size())), 4, VTK_UNSIGNED_CHAR, this->Buffer);
    this->Time = time;
  }
  this->Texels->Activate();
}

void vtkDuplicatePoints::SetSampler(vtkShaderProgram* program, const char* name)
{
  program->SetUniformi(name, this->Texels->GetTextureUnit());
}

void vtkDuplicatePoints::Deactivate()
{
  this->Texels->Deactivate();
}

void vtkDuplicatePoints::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Texels->ReleaseGraphicsResources(window);
  this->Buffer->ReleaseGraphicsResources();
  this->Time = 0;
}
