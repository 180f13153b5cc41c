// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointTexture.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkScalarsToColors.h"
#include "vtkTexture.h"
#include "vtkTransform.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace
{
using Color = std::array<double, 4>;

/// RGBA of a colour of one to four components, as VTK's lookup tables make them.
Color Expand(const double* c, int components)
{
  const double alpha = components % 2 == 0 ? c[components - 1] : 1.0;
  return components < 3 ? Color{ c[0], c[0], c[0], alpha } : Color{ c[0], c[1], c[2], alpha };
}

double Linear(double value)
{
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

class Texels
{
public:
  Texels(vtkTexture* texture, vtkImageData* image, vtkDataArray* scalars)
    : Wrap(texture->GetWrap())
    , Interpolate(texture->GetInterpolate())
  {
    // the two axes that have an extent, as vtkOpenGLTexture takes them
    const int* d = image->GetDimensions();
    this->Size = { d[0] == 1 ? d[1] : d[0], d[0] == 1 || d[1] == 1 ? d[2] : d[1] };
    const bool mapped = texture->GetColorMode() == VTK_COLOR_MODE_MAP_SCALARS ||
      (texture->GetColorMode() == VTK_COLOR_MODE_DEFAULT &&
        scalars->GetDataType() != VTK_UNSIGNED_CHAR);
    const unsigned char* bytes = mapped ? texture->MapScalarsToColors(scalars) : nullptr;
    const int components = std::min(scalars->GetNumberOfComponents(), 4);
    const double scale = mapped || scalars->GetDataType() == VTK_UNSIGNED_CHAR ? 1.0 / 255.0
      : scalars->GetDataType() == VTK_UNSIGNED_SHORT                           ? 1.0 / 65535.0
                                                                               : 1.0;
    this->Colors.resize(static_cast<size_t>(this->Size[0]) * this->Size[1]);
    for (size_t i = 0; i < this->Colors.size(); ++i)
    {
      double c[4] = { 0.0, 0.0, 0.0, 1.0 };
      for (int k = 0; k < (mapped ? 4 : components); ++k)
      {
        c[k] =
          scale * (mapped ? bytes[4 * i + k] : scalars->GetComponent(static_cast<vtkIdType>(i), k));
      }
      this->Colors[i] = Expand(c, mapped ? 4 : components);
      for (int k = 0; k < 3 && texture->GetUseSRGBColorSpace(); ++k)
      {
        this->Colors[i][k] = Linear(this->Colors[i][k]);
      }
    }
  }

  Color At(double u, double v) const
  {
    const double at[2] = { u, v };
    int low[2];
    double share[2];
    for (int k = 0; k < 2; ++k)
    {
      const double place = at[k] * this->Size[k] - (this->Interpolate ? 0.5 : 0.0);
      low[k] = static_cast<int>(std::floor(place));
      share[k] = this->Interpolate ? place - low[k] : 0.0;
    }
    Color color{};
    for (int corner = 0; corner < (this->Interpolate ? 4 : 1); ++corner)
    {
      const int i = corner & 1;
      const int j = corner >> 1;
      const double weight = (i ? share[0] : 1.0 - share[0]) * (j ? share[1] : 1.0 - share[1]);
      const Color texel = this->Get(low[0] + i, low[1] + j);
      for (int k = 0; k < 4; ++k)
      {
        color[k] += weight * texel[k];
      }
    }
    return color;
  }

private:
  Color Get(int x, int y) const
  {
    int place[2] = { x, y };
    for (int k = 0; k < 2; ++k)
    {
      const int size = this->Size[k];
      const int inPair = ((place[k] % (2 * size)) + 2 * size) % (2 * size);
      if (this->Wrap == vtkTexture::ClampToBorder && (place[k] < 0 || place[k] >= size))
      {
        return Color{}; // OpenGL's default border
      }
      place[k] = this->Wrap == vtkTexture::Repeat ? inPair % size
        : this->Wrap == vtkTexture::MirroredRepeat
        ? (inPair < size ? inPair : 2 * size - 1 - inPair)
        : std::min(std::max(place[k], 0), size - 1);
    }
    return this->Colors[static_cast<size_t>(place[1]) * this->Size[0] + place[0]];
  }

  std::vector<Color> Colors;
  std::array<int, 2> Size{};
  int Wrap;
  bool Interpolate;
};
}

vtkSmartPointer<vtkUnsignedCharArray> vtkPointTexture::Multiply(
  vtkUnsignedCharArray* colors, vtkDataArray* coordinates, vtkTexture* texture)
{
  vtkImageData* image = texture->GetInput();
  vtkDataArray* scalars = image ? image->GetPointData()->GetScalars() : nullptr;
  if (!scalars)
  {
    return nullptr;
  }
  const Texels texels(texture, image, scalars);
  const int components = colors->GetNumberOfComponents();
  auto result = vtkSmartPointer<vtkUnsignedCharArray>::New();
  result->SetNumberOfComponents(4);
  result->SetNumberOfTuples(colors->GetNumberOfTuples());
  for (vtkIdType i = 0; i < colors->GetNumberOfTuples(); ++i)
  {
    double st[3] = { coordinates->GetComponent(i, 0), 0.0, 0.0 };
    if (coordinates->GetNumberOfComponents() > 1)
    {
      st[1] = coordinates->GetComponent(i, 1);
    }
    if (texture->GetTransform())
    {
      texture->GetTransform()->TransformPoint(st, st);
    }
    double own[4];
    for (int k = 0; k < components; ++k)
    {
      own[k] = colors->GetComponent(i, k) / 255.0;
    }
    const Color color = Expand(own, components);
    const bool finite = std::isfinite(st[0]) && std::isfinite(st[1]);
    const Color texel = finite ? texels.At(st[0], st[1]) : Color{ 1.0, 1.0, 1.0, 1.0 };
    for (int k = 0; k < 4; ++k)
    {
      const double value = std::min(color[k] * texel[k], 1.0);
      result->SetTypedComponent(i, k, static_cast<unsigned char>(std::lround(255.0 * value)));
    }
  }
  return result;
}
