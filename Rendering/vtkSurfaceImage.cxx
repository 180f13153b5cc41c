// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceImage.h"

#include "vtkSurfacePixels.h"

#include "vtkSMPTools.h"

#include <algorithm>

void vtkSurfaceImage::Allocate(
  int width, int height, const Rectangle& rectangle, bool ids, bool colors)
{
  const int planes = colors ? NumberOfPlanes : NumberOfShapePlanes;
  if (width != this->Width || height != this->Height || planes != this->Planes ||
    ids != this->WithIds)
  {
    this->Width = width;
    this->Height = height;
    this->Planes = planes;
    this->WithIds = ids;
    // an even number of blocks, since two of them are pulled into one, and the rim
    const int pair = 2 * BlockSize;
    this->Stride = (width + pair - 1) / pair * pair + pair;
    const size_t pixels = static_cast<size_t>(height + 2) * this->Stride;
    this->Values.assign(pixels * planes, 0.0f);
    this->Ids.assign(ids ? pixels : 0, 0);
    this->Occupied.assign(pixels / BlockSize, 0);
  }

  this->Bounds = rectangle;
  const int begin = this->GetBlockBegin();
  const int end = this->GetBlockEnd();
  this->ClearBlocks(rectangle[1] - 1, begin - 1, end + 1);
  this->ClearBlocks(rectangle[3], begin - 1, end + 1);
  for (int y = rectangle[1]; y < rectangle[3]; ++y)
  {
    this->ClearBlocks(y, begin - 1, begin);
    this->ClearBlocks(y, end, end + 1);
  }
}

void vtkSurfaceImage::ClearBlocks(int y, int begin, int end)
{
  float* radii = this->GetRow(y, Radius);
  std::fill(radii + begin * BlockSize, radii + end * BlockSize, 0.0f);
  unsigned char* occupied = this->GetOccupied(y);
  std::fill(occupied + begin, occupied + end, static_cast<unsigned char>(0));
}

//------------------------------------------------------------------------------
void vtkSurfaceImage::ReadSurface(vtkSurfacePixels& pixels)
{
  const auto& r = this->Bounds;
  pixels.Allocate(r, this->WithIds, this->HasColors());
  const size_t width = static_cast<size_t>(r[2] - r[0]);
  auto readRow = [&](int y)
  {
    const float* values = this->GetRow(y, 0);
    const size_t plane = this->GetPlaneStride();
    size_t pixel = static_cast<size_t>(y - r[1]) * width;
    for (int x = r[0]; x < r[2]; ++x, ++pixel)
    {
      const float* value = values + x;
      const bool valid = value[Radius * plane] > 0.0f;
      for (int k = 0; k < 3; ++k)
      {
        pixels.Surface[4 * pixel + k] = valid ? value[(NormalX + k) * plane] : 0.0f;
      }
      pixels.Surface[4 * pixel + 3] = valid ? value[IntervalX * plane] : 0.0f;
      if (this->WithIds)
      {
        pixels.Id[pixel] = valid ? this->GetIds(y)[x] : 0;
      }
      for (int k = 0; k < 4 && this->HasColors(); ++k)
      {
        pixels.Color[4 * pixel + k] = valid ? value[(Red + k) * plane] : 0.0f;
      }
    }
  };
  constexpr int Grain = 16;
  vtkSMPTools::For(r[1], r[3], Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType y = begin; y < end; ++y)
      {
        readRow(static_cast<int>(y));
      }
    });
}

//------------------------------------------------------------------------------
std::vector<float> vtkSurfaceImage::ReadFloats(vtkSurfaceTarget::Layer layer)
{
  const int first = layer == vtkSurfaceTarget::Shape ? NormalX
    : layer == vtkSurfaceTarget::Interval            ? IntervalX
                                                     : Red;
  std::vector<float> pixels(static_cast<size_t>(this->Width) * this->Height * 4, 0.0f);
  for (int y = this->Bounds[1]; y < this->Bounds[3]; ++y)
  {
    const float* radii = this->GetRow(y, Radius);
    for (int x = this->Bounds[0]; x < this->Bounds[2]; ++x)
    {
      float* pixel = &pixels[(static_cast<size_t>(y) * this->Width + x) * 4];
      for (int k = 0; k < 4 && radii[x] > 0.0f; ++k)
      {
        pixel[k] = this->GetRow(y, first + k)[x];
      }
    }
  }
  return pixels;
}

std::vector<unsigned int> vtkSurfaceImage::ReadIds()
{
  std::vector<unsigned int> pixels(static_cast<size_t>(this->Width) * this->Height, 0);
  for (int y = this->Bounds[1]; y < this->Bounds[3]; ++y)
  {
    const float* radii = this->GetRow(y, Radius);
    const unsigned int* ids = this->GetIds(y);
    for (int x = this->Bounds[0]; x < this->Bounds[2]; ++x)
    {
      pixels[static_cast<size_t>(y) * this->Width + x] = radii[x] > 0.0f ? ids[x] : 0;
    }
  }
  return pixels;
}
