// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAlgebraicSplatTracingCPU.h"

#include "vtkAlgebraicSplatOptions.h"
#include "vtkAlgebraicSplatTransform.h"
#include "vtkDrawableSplats.h"
#include "vtkPointSurfaceView.h"
#include "vtkPolynomialRoots.h"
#include "vtkSurfacePixels.h"

#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace
{
using Splat = vtkDrawableSplats::Splat;
using Vector = std::array<double, 3>;

constexpr int TileSize = 32;

double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// A splat in eye coordinates.
struct TracedSplat
{
  const Splat* Source = nullptr;
  int Order = 1;
  Vector Center;
  std::array<Vector, 3> ToLocal; // rows, from eye vectors to the splat's frame in units of its disc
  double Unit = 0.0;             // of depth along the ray, of the size of the disc
  std::array<int, 4> Bounds{};   // x, y, x end, y end in pixels
};

struct Hit
{
  std::uint16_t Pixel; // of the tile
  bool Front;
  float Depth;
  float Weight;
  std::array<float, 3> Normal;
  const Splat* Source;
};

/// The polynomial of the splat less the ray's height, over the ray from (u, v, n) on by (du, dv,
/// dn).
template <int Order>
vtkPolynomialRoots::Polynomial<Order, double> Compose(
  const float* c, const Vector& start, const Vector& step)
{
  vtkPolynomialRoots::Polynomial<Order, double> sum{};
  for (int a = Order; a >= 0; --a)
  {
    vtkPolynomialRoots::Polynomial<Order, double> inner{};
    for (int b = Order - a; b >= 0; --b)
    {
      for (int i = Order - a - b; i > 0; --i)
      {
        inner[i] = inner[i] * start[1] + inner[i - 1] * step[1];
      }
      inner[0] = inner[0] * start[1] + c[vtkAlgebraicSplat::Index(a, b)];
    }
    for (int i = Order - a; i > 0; --i)
    {
      sum[i] = sum[i] * start[0] + sum[i - 1] * step[0] + inner[i];
    }
    sum[0] = sum[0] * start[0] + inner[0];
  }
  sum[0] -= start[2];
  sum[1] -= step[2];
  return sum;
}

/// The gradient of g.
template <int Order>
void GetSlopes(const float* c, double u, double v, double& du, double& dv)
{
  du = 0.0;
  dv = 0.0;
  for (int a = Order; a >= 0; --a)
  {
    double inner = 0.0;
    double innerSlope = 0.0;
    for (int b = Order - a; b >= 0; --b)
    {
      const double coefficient = c[vtkAlgebraicSplat::Index(a, b)];
      inner = inner * v + coefficient;
      innerSlope = b > 0 ? innerSlope * v + b * coefficient : innerSlope;
    }
    du = a > 0 ? du * u + a * inner : du;
    dv = dv * u + innerSlope;
  }
}

class Tracer
{
public:
  Tracer(const vtkPointSurfaceView& view, const vtkAlgebraicSplatOptions& options,
    const vtkAlgebraicSplatTransform& transform)
    : View(view)
    , Options(options)
    , Transform(transform)
  {
  }

  TracedSplat Place(const Splat& splat, int order) const;
  template <int Order>
  bool Trace(const TracedSplat& splat, int x, int y, Hit& hit) const;

private:
  Vector ToEye(const std::array<float, 3>& v, double scale) const
  {
    Vector eye;
    for (int k = 0; k < 3; ++k)
    {
      eye[k] = scale *
        (v[0] * this->Transform.ToEye[k] + v[1] * this->Transform.ToEye[3 + k] +
          v[2] * this->Transform.ToEye[6 + k]);
    }
    return eye;
  }
  std::array<int, 4> GetBounds(
    const Vector& center, const Vector& u, const Vector& v, const Vector& n, const Splat&) const;

  const vtkPointSurfaceView& View;
  const vtkAlgebraicSplatOptions& Options;
  const vtkAlgebraicSplatTransform& Transform;
};

TracedSplat Tracer::Place(const Splat& splat, int order) const
{
  TracedSplat placed;
  placed.Source = &splat;
  placed.Order = order;
  const Vector u = this->ToEye(splat.U, splat.Radius);
  const Vector v = this->ToEye(splat.V, splat.Radius);
  const Vector n = this->ToEye(splat.Normal, splat.Radius);
  const Vector offset = this->ToEye(splat.Center, 1.0);
  for (int k = 0; k < 3; ++k)
  {
    placed.Center[k] = this->Transform.Origin[k] + offset[k];
  }
  placed.ToLocal = { Cross(v, n), Cross(n, u), Cross(u, v) };
  const double volume = Dot(u, placed.ToLocal[0]);
  for (Vector& row : placed.ToLocal)
  {
    for (double& value : row)
    {
      value /= volume;
    }
  }
  placed.Unit = std::cbrt(std::abs(volume));
  if (std::isfinite(1.0 / volume))
  {
    placed.Bounds = this->GetBounds(placed.Center, u, v, n, splat);
  }
  return placed;
}

// The rectangle around the cylinder that the patch lies in: around the discs at its two ends. A
// disc's x / w is least and largest where a line of constant x / w touches it.
std::array<int, 4> Tracer::GetBounds(
  const Vector& center, const Vector& u, const Vector& v, const Vector& n, const Splat& splat) const
{
  const auto& r = this->View.Rectangle;
  const std::array<int, 4> all = { r[0], r[1], r[0] + r[2], r[1] + r[3] };
  std::array<int, 4> bounds = { all[2], all[3], all[0], all[1] };
  const auto& m = this->View.VCDC;
  for (float height : splat.Heights)
  {
    Vector c;
    for (int k = 0; k < 3; ++k)
    {
      c[k] = center[k] + height * n[k];
    }
    const double w = m[11] * c[2] + m[15];
    const double wu = m[11] * u[2];
    const double wv = m[11] * v[2];
    if (w <= 1.0001 * std::hypot(wu, wv))
    {
      return all; // it is beside the eye, or behind
    }
    for (int k = 0; k < 2; ++k)
    {
      auto clip = [&](const Vector& p) { return m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2]; };
      const double x = clip(c) + m[12 + k];
      const double xu = clip(u);
      const double xv = clip(v);
      const double a2 = w * w - wu * wu - wv * wv;
      const double b = x * w - xu * wu - xv * wv;
      const double root = std::sqrt(std::max(b * b - a2 * (x * x - xu * xu - xv * xv), 0.0));
      const double half = 0.5 * this->View.Size[k];
      const double low = std::floor(half * ((b - root) / a2 + 1.0) - 0.51);
      const double high = std::ceil(half * ((b + root) / a2 + 1.0) + 0.51);
      auto clamp = [&](double pixel)
      { return static_cast<int>(std::min<double>(std::max<double>(pixel, all[k]), all[2 + k])); };
      bounds[k] = std::min(bounds[k], clamp(low));
      bounds[2 + k] = std::max(bounds[2 + k], clamp(high));
    }
  }
  return bounds;
}

/// The part of [begin, end] where value + t * change >= 0.
void Limit(double value, double change, double& begin, double& end)
{
  if (change > 0.0)
  {
    begin = std::max(begin, -value / change);
  }
  else if (change < 0.0)
  {
    end = std::min(end, -value / change);
  }
  else if (value < 0.0)
  {
    end = -std::numeric_limits<double>::max();
  }
}

template <int Order>
bool Tracer::Trace(const TracedSplat& splat, int x, int y, Hit& hit) const
{
  const auto& ray = this->Transform.Rays.First;
  const auto& rayStep = this->Transform.Rays.Step;
  const double pixel[2] = { x + 0.5, y + 0.5 };
  // the ray from the depth of the splat's centre on, in units of the disc
  Vector direction = { 0.0, 0.0, -1.0 };
  Vector position = { 0.0, 0.0, splat.Center[2] };
  for (int k = 0; k < 2; ++k)
  {
    direction[k] = ray[k] + pixel[k] * rayStep[k];
    position[k] = ray[2 + k] + pixel[k] * rayStep[2 + k] - splat.Center[2] * direction[k];
  }
  direction[0] -= this->Transform.Rays.Shear * direction[1];
  position[0] -= this->Transform.Rays.Shear * position[1];
  const Vector offset = { position[0] - splat.Center[0], position[1] - splat.Center[1], 0.0 };
  Vector start;
  Vector step;
  for (int k = 0; k < 3; ++k)
  {
    start[k] = Dot(splat.ToLocal[k], offset);
    step[k] = splat.Unit * Dot(splat.ToLocal[k], direction);
  }

  // where it lies in the disc's cylinder and before all planes
  double begin = -std::numeric_limits<double>::max();
  double end = std::numeric_limits<double>::max();
  const double a = step[0] * step[0] + step[1] * step[1];
  const double b = start[0] * step[0] + start[1] * step[1];
  const double c = start[0] * start[0] + start[1] * start[1] - 1.0;
  if (a > 0.0)
  {
    const double discriminant = b * b - a * c;
    if (discriminant <= 0.0)
    {
      return false;
    }
    const double root = std::sqrt(discriminant);
    begin = (-b - root) / a;
    end = (-b + root) / a;
  }
  else if (c > 0.0)
  {
    return false;
  }
  Limit(start[2] - splat.Source->Heights[0], step[2], begin, end);
  Limit(splat.Source->Heights[1] - start[2], -step[2], begin, end);
  for (const auto& plane : this->Transform.Planes)
  {
    const Vector normal = { plane[0], plane[1], plane[2] };
    Limit(Dot(normal, position) + plane[3], splat.Unit * Dot(normal, direction), begin, end);
  }
  if (!(begin < end))
  {
    return false;
  }
  const double length = end - begin;
  for (int k = 0; k < 3; ++k)
  {
    start[k] += begin * step[k];
    step[k] *= length;
  }

  const float* coefficients = splat.Source->Coefficients.data();
  double t = 0.0;
  bool found;
  if constexpr (Order == 1)
  {
    const auto p = Compose<1>(coefficients, start, step);
    t = -p[0] / p[1];
    found = t >= 0.0 && t <= 1.0;
  }
  else
  {
    found = vtkPolynomialRoots::FirstRoot<Order>(Compose<Order>(coefficients, start, step), t);
  }
  if (!found)
  {
    return false;
  }
  const double u = start[0] + t * step[0];
  const double v = start[1] + t * step[1];
  double du, dv;
  GetSlopes<Order>(coefficients, u, v, du, dv);
  Vector normal;
  for (int k = 0; k < 3; ++k)
  {
    normal[k] = splat.ToLocal[2][k] - du * splat.ToLocal[0][k] - dv * splat.ToLocal[1][k];
  }
  hit.Front = Dot(normal, direction) < 0.0;
  if (this->View.Cull ==
    (hit.Front ? vtkPointSurfaceView::FrontfaceCulling : vtkPointSurfaceView::BackfaceCulling))
  {
    return false;
  }
  const double size = std::sqrt(Dot(normal, normal));
  for (int k = 0; k < 3; ++k)
  {
    hit.Normal[k] = static_cast<float>(normal[k] / size);
  }
  hit.Depth = static_cast<float>(-splat.Center[2] + splat.Unit * (begin + t * length));
  hit.Weight = static_cast<float>(std::exp(-this->Options.WeightFalloff * (u * u + v * v)));
  hit.Source = splat.Source;
  return true;
}

/// One tile after the other, with room for the hits of one.
class Tiles
{
public:
  Tiles(const Tracer& tracer, const vtkAlgebraicSplatOptions& options,
    const std::vector<TracedSplat>& splats, const vtkAlgebraicSplatTracingCPU::ColorSource& color,
    vtkSurfacePixels& surface)
    : Trace(tracer)
    , Options(options)
    , Splats(splats)
    , Color(color)
    , Surface(surface)
  {
    const auto& r = surface.Rectangle;
    this->Columns = (r[2] - r[0] + TileSize - 1) / TileSize;
    this->Rows = (r[3] - r[1] + TileSize - 1) / TileSize;
    this->Lists.resize(static_cast<size_t>(this->Columns) * this->Rows);
    for (size_t i = 0; i < splats.size(); ++i)
    {
      const auto& b = splats[i].Bounds;
      if (b[0] >= b[2] || b[1] >= b[3])
      {
        continue;
      }
      for (int row = (b[1] - r[1]) / TileSize; row <= (b[3] - 1 - r[1]) / TileSize; ++row)
      {
        for (int column = (b[0] - r[0]) / TileSize; column <= (b[2] - 1 - r[0]) / TileSize;
             ++column)
        {
          this->Lists[row * this->Columns + column].push_back(static_cast<int>(i));
        }
      }
    }
  }

  int GetNumberOfTiles() const { return this->Columns * this->Rows; }

  void Draw(int tile, std::vector<Hit>& hits) const
  {
    const auto& r = this->Surface.Rectangle;
    const int x0 = r[0] + tile % this->Columns * TileSize;
    const int y0 = r[1] + tile / this->Columns * TileSize;
    const std::array<int, 4> area = { x0, y0, std::min(x0 + TileSize, r[2]),
      std::min(y0 + TileSize, r[3]) };
    hits.clear();
    for (int index : this->Lists[tile])
    {
      const TracedSplat& splat = this->Splats[index];
      switch (splat.Order)
      {
        case 1:
          this->Gather<1>(splat, area, hits);
          break;
        case 2:
          this->Gather<2>(splat, area, hits);
          break;
        case 3:
          this->Gather<3>(splat, area, hits);
          break;
        default:
          this->Gather<4>(splat, area, hits);
      }
    }
    this->Blend(area, hits);
  }

private:
  template <int Order>
  void Gather(
    const TracedSplat& splat, const std::array<int, 4>& area, std::vector<Hit>& hits) const
  {
    Hit hit;
    for (int y = std::max(area[1], splat.Bounds[1]); y < std::min(area[3], splat.Bounds[3]); ++y)
    {
      for (int x = std::max(area[0], splat.Bounds[0]); x < std::min(area[2], splat.Bounds[2]); ++x)
      {
        if (this->Trace.template Trace<Order>(splat, x, y, hit))
        {
          hit.Pixel = static_cast<std::uint16_t>((y - area[1]) * TileSize + x - area[0]);
          hits.push_back(hit);
        }
      }
    }
  }

  void Blend(const std::array<int, 4>& area, const std::vector<Hit>& hits) const
  {
    constexpr int Size = TileSize * TileSize;
    struct Sum
    {
      float Normal[3] = { 0.0f, 0.0f, 0.0f };
      float Depth = 0.0f;
      float Weight = 0.0f;
      float Color[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
      float Heaviest = 0.0f;
      unsigned int Id = 0;
    };
    std::vector<std::array<float, 2>> visible(Size, { 0.0f, 0.0f }); // of the back, the front
    std::vector<Sum> sums(Size);
    const auto shift = static_cast<float>(1.0 + this->Options.DepthShift);
    for (const Hit& hit : hits)
    {
      float& nearness = visible[hit.Pixel][hit.Front || !this->Options.SeparateSides ? 1 : 0];
      nearness = std::max(nearness, 1.0f / (shift * hit.Depth));
    }
    for (const Hit& hit : hits)
    {
      const auto& nearness = visible[hit.Pixel];
      const bool front = nearness[1] >= nearness[0];
      if ((this->Options.SeparateSides && hit.Front != front) ||
        hit.Depth * nearness[front ? 1 : 0] > 1.0f)
      {
        continue;
      }
      Sum& sum = sums[hit.Pixel];
      for (int k = 0; k < 3; ++k)
      {
        sum.Normal[k] += hit.Weight * hit.Normal[k];
      }
      sum.Depth += hit.Weight * hit.Depth;
      sum.Weight += hit.Weight;
      if (!this->Surface.Color.empty())
      {
        const std::array<float, 4> color = this->Color(hit.Source->Id);
        for (int k = 0; k < 4; ++k)
        {
          sum.Color[k] += hit.Weight * color[k];
        }
      }
      if (hit.Weight > sum.Heaviest)
      {
        sum.Heaviest = hit.Weight;
        sum.Id = hit.Source->Id + 1;
      }
    }

    const auto& r = this->Surface.Rectangle;
    for (int y = area[1]; y < area[3]; ++y)
    {
      for (int x = area[0]; x < area[2]; ++x)
      {
        const Sum& sum = sums[(y - area[1]) * TileSize + x - area[0]];
        const size_t pixel = static_cast<size_t>(y - r[1]) * (r[2] - r[0]) + (x - r[0]);
        const float weight = sum.Weight > 0.0f ? sum.Weight : 1.0f;
        const float size = std::sqrt(sum.Normal[0] * sum.Normal[0] + sum.Normal[1] * sum.Normal[1] +
          sum.Normal[2] * sum.Normal[2]);
        for (int k = 0; k < 3; ++k)
        {
          this->Surface.Surface[4 * pixel + k] = size > 0.0f ? sum.Normal[k] / size : 0.0f;
        }
        this->Surface.Surface[4 * pixel + 3] = sum.Depth / weight;
        if (!this->Surface.Id.empty())
        {
          this->Surface.Id[pixel] = sum.Id;
        }
        for (int k = 0; k < 4 && !this->Surface.Color.empty(); ++k)
        {
          this->Surface.Color[4 * pixel + k] = sum.Color[k] / weight;
        }
      }
    }
  }

  const Tracer& Trace;
  const vtkAlgebraicSplatOptions& Options;
  const std::vector<TracedSplat>& Splats;
  const vtkAlgebraicSplatTracingCPU::ColorSource& Color;
  vtkSurfacePixels& Surface;
  int Columns = 0;
  int Rows = 0;
  std::vector<std::vector<int>> Lists; // of splats, by tile
};
}

void vtkAlgebraicSplatTracingCPU::Run(const vtkDrawableSplats& splats,
  const vtkPointSurfaceView& view, const vtkAlgebraicSplatOptions& options, bool ids,
  const ColorSource& color, vtkSurfacePixels& surface)
{
  const auto& r = view.Rectangle;
  surface.Allocate({ r[0], r[1], r[0] + r[2], r[1] + r[3] }, ids, static_cast<bool>(color));
  const vtkAlgebraicSplatTransform transform(view, splats.GetOrigin());
  const Tracer tracer(view, options, transform);
  std::vector<TracedSplat> placed;
  placed.reserve(splats.GetNumberOfSplats());
  for (int order = 1; order <= vtkAlgebraicSplat::MaximumOrder; ++order)
  {
    const std::vector<Splat>& group = splats.GetSplats(order);
    for (const vtkDrawableSplats::Range& range : splats.GetRanges(order, view.Ranges))
    {
      const vtkIdType first = static_cast<vtkIdType>(placed.size()) - range[0];
      placed.resize(placed.size() + range[1] - range[0]);
      vtkSMPTools::For(range[0], range[1],
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType i = begin; i < end; ++i)
          {
            placed[first + i] = tracer.Place(group[i], order);
          }
        });
    }
  }

  const Tiles tiles(tracer, options, placed, color, surface);
  vtkSMPThreadLocal<std::vector<Hit>> hits;
  vtkSMPTools::For(0, tiles.GetNumberOfTiles(), 4,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType tile = begin; tile < end; ++tile)
      {
        tiles.Draw(static_cast<int>(tile), hits.Local());
      }
    });
}
