// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDiscFillCPU.h"

#include "vtkDiscFillOptions.h"
#include "vtkPointSurfaceVectorize.h"
#include "vtkSurfaceImage.h"
#include "vtkSurfacePixels.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
constexpr float Infinite = 3.4e38f;

/// Lowers the values to those of a row of depths where there are points.
VTK_POINT_SURFACE_CLONES
void TakeNearest(const float* radii, const float* depths, int count, float* nearest)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int x = 0; x < count; ++x)
  {
    const float depth = radii[x] > 0.0f ? depths[x] : Infinite;
    nearest[x] = depth < nearest[x] ? depth : nearest[x];
  }
}

/// Marks pixels that are empty or show a surface behind another one, with a point in front within
/// reach; `nearest` has as many values before and after the row.
VTK_POINT_SURFACE_CLONES
void MarkCandidates(const float* radii, const float* depths, const float* nearest, int count,
  int reach, float layerDistance, unsigned char* marks)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int x = 0; x < count; ++x)
  {
    float front = Infinite;
    for (int i = -reach; i <= reach; ++i)
    {
      front = nearest[x + i] < front ? nearest[x + i] : front;
    }
    const float limit = radii[x] > 0.0f ? depths[x] - layerDistance : 0.5f * Infinite;
    marks[x] = front <= limit ? 1 : 0;
  }
}

class Filler
{
public:
  Filler(const vtkDiscFillOptions& options, vtkSurfaceImage& projected, vtkSurfacePixels& surface)
    : Options(options)
    , Projected(projected)
    , Surface(surface)
    , Bounds(projected.GetRectangle())
    , Plane(projected.GetPlaneStride())
  {
  }

  void FillRow(int y) const
  {
    const int width = this->Bounds[2] - this->Bounds[0];
    const int reach = this->Options.Reach;
    std::vector<float> nearest(static_cast<size_t>(width) + 2 * reach, Infinite);
    for (int row = std::max(y - reach, this->Bounds[1]);
         row < std::min(y + reach + 1, this->Bounds[3]); ++row)
    {
      TakeNearest(this->Get(this->Bounds[0], row, vtkSurfaceImage::Radius),
        this->Get(this->Bounds[0], row, vtkSurfaceImage::IntervalX), width, nearest.data() + reach);
    }
    std::vector<unsigned char> marks(width);
    MarkCandidates(this->Get(this->Bounds[0], y, vtkSurfaceImage::Radius),
      this->Get(this->Bounds[0], y, vtkSurfaceImage::IntervalX), nearest.data() + reach, width,
      reach, this->Options.LayerDistance, marks.data());
    for (int i = 0; i < width; ++i)
    {
      if (marks[i])
      {
        this->FillPixel(this->Bounds[0] + i, y);
      }
    }
  }

private:
  const float* Get(int x, int y, int plane) const { return this->Projected.GetRow(y, plane) + x; }

  void FillPixel(int x, int y) const
  {
    struct Disc
    {
      int X, Y;
      float Depth, Distance;
    };
    constexpr int side = 2 * vtkDiscFillOptions::LargestReach + 1;
    Disc discs[side * side]; // around the pixel, and in front of what it shows
    int count = 0;
    int near = 0;
    const bool isEmpty = !(*this->Get(x, y, vtkSurfaceImage::Radius) > 0.0f);
    float limit = isEmpty
      ? Infinite
      : *this->Get(x, y, vtkSurfaceImage::IntervalX) - this->Options.LayerDistance;
    float front = Infinite;
    const int reach = this->Options.Reach;
    for (int v = std::max(y - reach, this->Bounds[1]); v < std::min(y + reach + 1, this->Bounds[3]);
         ++v)
    {
      for (int u = std::max(x - reach, this->Bounds[0]);
           u < std::min(x + reach + 1, this->Bounds[2]); ++u)
      {
        const float depth = *this->Get(u, v, vtkSurfaceImage::IntervalX);
        if (!(*this->Get(u, v, vtkSurfaceImage::Radius) > 0.0f) || depth > limit ||
          (u == x && v == y))
        {
          continue;
        }
        const float q = this->GetDistance(x, y, u, v);
        near += q <= vtkDiscFillOptions::NearLimit ? 1 : 0;
        if (q <= 1.0f)
        {
          front = std::min(front, depth);
          discs[count++] = { u, v, depth, q };
        }
      }
    }
    if (near < 2)
    {
      return;
    }
    limit = std::min(limit, front + this->Options.LayerDistance);
    const Disc* source = nullptr;
    for (const Disc* disc = discs; disc < discs + count; ++disc)
    {
      if (disc->Depth <= limit && (!source || disc->Distance < source->Distance))
      {
        source = disc;
      }
    }
    if (source)
    {
      this->Write(x, y, source->X, source->Y);
    }
  }

  /// How far out the pixel (x, y) lies in the disc of the point of another: 1 is its edge.
  float GetDistance(int x, int y, int u, int v) const
  {
    const float* point = this->Get(u, v, 0);
    auto get = [&](int plane) { return point[plane * this->Plane]; };
    const auto& o = this->Options;
    const float depth = get(vtkSurfaceImage::IntervalX);
    const float center[2] = { u + 0.5f + get(vtkSurfaceImage::CenterX),
      v + 0.5f + get(vtkSurfaceImage::CenterY) };
    float direction[2];
    float origin[2];
    float pixelSize[2];
    float offset[2];
    for (int k = 0; k < 2; ++k)
    {
      direction[k] = o.EyeRay[k] + center[k] * o.EyeRayStep[k];
      origin[k] = o.EyeRay[2 + k] + center[k] * o.EyeRayStep[2 + k];
      pixelSize[k] = o.EyeRayStep[2 + k] + depth * o.EyeRayStep[k];
      offset[k] = ((k == 0 ? x : y) + 0.5f - center[k]) * pixelSize[k];
    }
    for (float* eye : { direction, origin, offset })
    {
      eye[0] -= o.Shear * eye[1];
    }

    // The disc seen along the ray, across the view; in heights of a pixel, as single precision does
    // not hold fourth powers of any length.
    const float normal[3] = { get(vtkSurfaceImage::NormalX), get(vtkSurfaceImage::NormalY),
      get(vtkSurfaceImage::NormalZ) };
    const float heights = 1.0f / pixelSize[1];
    const float radius = heights * vtkDiscFillOptions::RadiusShare * get(vtkSurfaceImage::Radius);
    const float across[2] = { normal[0] + direction[0] * normal[2],
      normal[1] + direction[1] * normal[2] };
    float moment[2];
    float away[2];
    for (int k = 0; k < 2; ++k)
    {
      const float size = heights * pixelSize[k];
      away[k] = heights * offset[k];
      moment[k] = radius * radius * (1.0f + direction[k] * direction[k] - across[k] * across[k]) +
        vtkDiscFillOptions::LowPassVariance * size * size;
    }
    const float mixed = radius * radius * (direction[0] * direction[1] - across[0] * across[1]);
    const float q = (moment[1] * away[0] * away[0] - 2.0f * mixed * away[0] * away[1] +
                      moment[0] * away[1] * away[1]) /
      (moment[0] * moment[1] - mixed * mixed);
    if (o.NumberOfClippingPlanes == 0 || !(q <= 1.0f))
    {
      return q;
    }
    const float slope = normal[0] * direction[0] + normal[1] * direction[1] - normal[2];
    const float behind = -(normal[0] * offset[0] + normal[1] * offset[1]) /
      (slope < 0.0f ? std::min(slope, -0.1f) : std::max(slope, 0.1f));
    const float position[3] = { origin[0] + (depth + behind) * direction[0] + offset[0],
      origin[1] + (depth + behind) * direction[1] + offset[1], -depth - behind };
    return this->IsClipped(position) ? Infinite : q;
  }

  bool IsClipped(const float position[3]) const
  {
    bool clipped = false;
    for (int i = 0; i < this->Options.NumberOfClippingPlanes; ++i)
    {
      const auto& p = this->Options.ClippingPlanes[i];
      clipped |= p[0] * position[0] + p[1] * position[1] + p[2] * position[2] + p[3] < 0.0f;
    }
    return clipped;
  }

  void Write(int x, int y, int u, int v) const
  {
    const auto place = [&](int column, int row)
    {
      return static_cast<size_t>(row - this->Bounds[1]) * (this->Bounds[2] - this->Bounds[0]) +
        (column - this->Bounds[0]);
    };
    const size_t pixel = place(x, y);
    const float* point = this->Get(u, v, 0);
    for (int k = 0; k < 3; ++k)
    {
      this->Surface.Surface[4 * pixel + k] = point[(vtkSurfaceImage::NormalX + k) * this->Plane];
    }
    this->Surface.Surface[4 * pixel + 3] = point[vtkSurfaceImage::IntervalX * this->Plane];
    if (!this->Surface.Id.empty())
    {
      this->Surface.Id[pixel] = this->Projected.GetIds(v)[u];
    }
    for (int k = 0; k < 4 && !this->Surface.Color.empty(); ++k)
    {
      this->Surface.Color[4 * pixel + k] = point[(vtkSurfaceImage::Red + k) * this->Plane];
    }
  }

  const vtkDiscFillOptions& Options;
  vtkSurfaceImage& Projected;
  vtkSurfacePixels& Surface;
  const vtkSurfaceImage::Rectangle& Bounds;
  const size_t Plane;
};
}

void vtkDiscFillCPU::Run(
  const vtkDiscFillOptions& options, vtkSurfaceImage& projected, vtkSurfacePixels& surface)
{
  projected.ReadSurface(surface);
  if (options.Reach == 0)
  {
    return;
  }
  const Filler filler(options, projected, surface);
  constexpr int Grain = 16;
  vtkSMPTools::For(surface.Rectangle[1], surface.Rectangle[3], Grain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType y = begin; y < end; ++y)
      {
        filler.FillRow(static_cast<int>(y));
      }
    });
}
