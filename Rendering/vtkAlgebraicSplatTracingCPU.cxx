// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAlgebraicSplatTracingCPU.h"

#include "vtkAlgebraicSplatBounds.h"
#include "vtkAlgebraicSplatOptions.h"
#include "vtkAlgebraicSplatTransform.h"
#include "vtkDrawableSplats.h"
#include "vtkPointSurfaceVectorize.h"
#include "vtkPointSurfaceView.h"
#include "vtkPolynomialRoots.h"
#include "vtkSurfacePixels.h"

#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace
{
using Splat = vtkDrawableSplats::Splat;
using Cloud = vtkAlgebraicSplatTracingCPU::Cloud;
using Vector = std::array<double, 3>;

constexpr int TileSize = 32;

/// Pixels of a row that are traced at once; a row of a tile goes on for as many.
constexpr int Lanes = 8;
constexpr int Stride = TileSize + Lanes;

constexpr float Far = 3e38f;

double Dot(const Vector& a, const Vector& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// A number that changes linearly over the image: its value for the pixel (0, 0), and its changes
/// along x and y.
using Linear = std::array<double, 3>;

Linear Combine(const Vector& factors, const std::array<Linear, 3>& numbers)
{
  Linear sum;
  for (int i = 0; i < 3; ++i)
  {
    sum[i] = factors[0] * numbers[0][i] + factors[1] * numbers[1][i] + factors[2] * numbers[2][i];
  }
  return sum;
}

/// A splat as rays meet it. They start at the depth of its centre.
struct TracedSplat
{
  const Splat* Source = nullptr;
  const Cloud* Of = nullptr;
  int Order = 1;
  std::array<Linear, 3> Start; // of the ray, in the splat's frame in units of its disc
  std::array<Linear, 3> Step;
  std::array<std::array<float, 3>, 3> ToLocal; // rows, from eye vectors to the splat's frame
  float Depth = 0.0f;                          // of the centre
  float Nearest = 0.0f;                        // depth that no part of it is before
  float Unit = 0.0f;                           // of depth along the ray, of the size of the disc
  bool Clipped = false;                        // some plane may cut it
  bool CullFront = false;                      // as its cloud's view has it
  bool CullBack = false;
  std::array<int, 4> Bounds{}; // x, y, x end, y end in pixels; empty: not seen
};

struct Hit
{
  std::uint16_t Pixel; // of the tile
  bool Front;
  float Depth;
  float Square; // of the distance from the centre, in units of the disc
  std::array<float, 3> Normal;
  const TracedSplat* Splat;
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

/// Makes splats ready for the rays of a view.
class Placer
{
public:
  Placer(const vtkPointSurfaceView& view, const std::array<double, 3>& origin)
    : View(view)
    , Transform(view, origin)
  {
    const auto& first = this->Transform.Rays.First;
    const auto& step = this->Transform.Rays.Step;
    auto make = [&](int k, int axis) -> Linear
    {
      Linear numbers = { first[k] + 0.5 * step[k], 0.0, 0.0 };
      numbers[1 + axis] = step[k];
      return numbers;
    };
    this->Direction = { make(0, 0), make(1, 1), Linear{ -1.0, 0.0, 0.0 } };
    this->Position = { make(2, 0), make(3, 1), Linear{} };
    for (int i = 0; i < 3; ++i)
    {
      this->Direction[0][i] -= this->Transform.Rays.Shear * this->Direction[1][i];
      this->Position[0][i] -= this->Transform.Rays.Shear * this->Position[1][i];
    }
  }

  TracedSplat Place(const Splat& splat, int order) const;

  const std::array<Linear, 3>& GetDirection() const { return this->Direction; }

  /// How far the rays' points at the depth of z = `z` are before a plane.
  Linear GetDistance(const std::array<double, 4>& plane, double z) const
  {
    Linear distance = Combine({ plane[0], plane[1], plane[2] }, this->GetPosition(z));
    distance[0] += plane[3];
    return distance;
  }
  const std::vector<std::array<double, 4>>& GetPlanes() const { return this->Transform.Planes; }

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
  std::array<Linear, 3> GetPosition(double z) const
  {
    std::array<Linear, 3> position = this->Position;
    for (int k = 0; k < 2; ++k)
    {
      for (int i = 0; i < 3; ++i)
      {
        position[k][i] -= z * this->Direction[k][i];
      }
    }
    position[2][0] = z;
    return position;
  }
  std::array<int, 4> GetBounds(
    const Vector& center, const Vector& u, const Vector& v, const Vector& n, const Splat&) const;

  const vtkPointSurfaceView& View;
  const vtkAlgebraicSplatTransform Transform;
  std::array<Linear, 3> Direction; // of rays, a unit of depth
  std::array<Linear, 3> Position;  // of rays, at the eye's depth
};

TracedSplat Placer::Place(const Splat& splat, int order) const
{
  TracedSplat placed;
  placed.Source = &splat;
  placed.Order = order;
  placed.CullFront = this->View.Cull == vtkPointSurfaceView::FrontfaceCulling;
  placed.CullBack = this->View.Cull == vtkPointSurfaceView::BackfaceCulling;
  const Vector u = this->ToEye(splat.U, splat.Radius);
  const Vector v = this->ToEye(splat.V, splat.Radius);
  const Vector n = this->ToEye(splat.Normal, splat.Radius);
  Vector center = this->ToEye(splat.Center, 1.0);
  for (int k = 0; k < 3; ++k)
  {
    center[k] += this->Transform.Origin[k];
  }
  std::array<Vector, 3> toLocal = { Cross(v, n), Cross(n, u), Cross(u, v) };
  const double volume = Dot(u, toLocal[0]);
  if (!std::isfinite(1.0 / volume))
  {
    return placed;
  }
  // between which a linear function lies on the cylinder that the patch lies in
  auto getRange = [&](const Vector& gradient, double atCenter) -> std::array<double, 2>
  {
    const double ends[2] = { splat.Heights[0] * Dot(gradient, n),
      splat.Heights[1] * Dot(gradient, n) };
    const double reach = std::hypot(Dot(gradient, u), Dot(gradient, v));
    return { atCenter + std::min(ends[0], ends[1]) - reach,
      atCenter + std::max(ends[0], ends[1]) + reach };
  };
  for (const auto& plane : this->Transform.Planes)
  {
    const Vector gradient = { plane[0], plane[1], plane[2] };
    const auto range = getRange(gradient, Dot(gradient, center) + plane[3]);
    if (range[1] < 0.0)
    {
      return placed;
    }
    placed.Clipped = placed.Clipped || range[0] < 0.0;
  }
  placed.Bounds = this->GetBounds(center, u, v, n, splat);
  const double unit = std::cbrt(std::abs(volume));
  placed.Unit = static_cast<float>(unit);
  placed.Depth = static_cast<float>(-center[2]);
  placed.Nearest = static_cast<float>(getRange({ 0.0, 0.0, -1.0 }, -center[2])[0]);
  std::array<Linear, 3> offset = this->GetPosition(center[2]);
  for (int k = 0; k < 3; ++k)
  {
    offset[k][0] -= center[k];
  }
  for (int k = 0; k < 3; ++k)
  {
    for (int i = 0; i < 3; ++i)
    {
      toLocal[k][i] /= volume;
      placed.ToLocal[k][i] = static_cast<float>(unit * toLocal[k][i]);
    }
    placed.Start[k] = Combine(toLocal[k], offset);
    placed.Step[k] = Combine(toLocal[k], this->Direction);
    for (double& number : placed.Step[k])
    {
      number *= unit;
    }
  }
  return placed;
}

// All where the splat is beside the eye, or behind.
std::array<int, 4> Placer::GetBounds(
  const Vector& center, const Vector& u, const Vector& v, const Vector& n, const Splat& splat) const
{
  const auto& r = this->View.Rectangle;
  std::array<int, 4> bounds = { r[0], r[1], r[0] + r[2], r[1] + r[3] };
  std::array<double, 4> around;
  if (vtkAlgebraicSplatBounds::Get(this->View.VCDC, center, u, v, n, splat.Heights, around))
  {
    const std::array<int, 4> all = bounds;
    for (int k = 0; k < 2; ++k)
    {
      const double half = 0.5 * this->View.Size[k];
      auto clamp = [&](double pixel)
      { return static_cast<int>(std::min<double>(std::max<double>(pixel, all[k]), all[2 + k])); };
      bounds[k] = clamp(std::floor(half * (around[k] + 1.0) - 0.51));
      bounds[2 + k] = clamp(std::ceil(half * (around[2 + k] + 1.0) + 0.51));
    }
  }
  return bounds;
}

/// What all tiles are traced with.
struct Scene
{
  const Placer& Rays;
  float Shift;         // what is farther than the visible depth times this is hidden
  float DirectionX[3]; // of rays, as Linear
  float DirectionY[3];

  Scene(const Placer& rays, const vtkAlgebraicSplatOptions& options)
    : Rays(rays)
    , Shift(static_cast<float>(1.0 + options.DepthShift))
  {
    for (int i = 0; i < 3; ++i)
    {
      this->DirectionX[i] = static_cast<float>(rays.GetDirection()[0][i]);
      this->DirectionY[i] = static_cast<float>(rays.GetDirection()[1][i]);
    }
  }
};

/// The rays of a row of pixels in a splat's frame, and the part of each that is of interest.
struct Rays
{
  alignas(64) float Start[3][Lanes];
  alignas(64) float Step[3][Lanes];
  alignas(64) float Begin[Lanes];
  alignas(64) float End[Lanes];
};

VTK_POINT_SURFACE_INLINE double At(const Linear& number, int x, int y)
{
  return number[0] + x * number[1] + y * number[2];
}

/// Leaves of rays the part where value + t * change >= 0.
VTK_POINT_SURFACE_INLINE void Limit(const float* value, const float* change, Rays& rays)
{
  VTK_POINT_SURFACE_LANES
  for (int i = 0; i < Lanes; ++i)
  {
    const float t = -value[i] / change[i]; // NaN, for which comparisons fail, or infinite with 0
    const float begin = rays.Begin[i];
    const float end = rays.End[i];
    rays.Begin[i] = ((change[i] > 0.0f) & (t > begin)) ? t : begin;
    const float nearer = ((change[i] < 0.0f) & (t < end)) ? t : end;
    rays.End[i] = ((change[i] == 0.0f) & (value[i] < 0.0f)) ? -Far : nearer;
  }
}

/// Starts rays from the pixel (x, y) on; they end where they leave the cylinder around the patch.
VTK_POINT_SURFACE_INLINE void MakeRays(const TracedSplat& splat, int x, int y, Rays& rays)
{
  for (int k = 0; k < 3; ++k)
  {
    const auto start = static_cast<float>(At(splat.Start[k], x, y));
    const auto startX = static_cast<float>(splat.Start[k][1]);
    const auto step = static_cast<float>(At(splat.Step[k], x, y));
    const auto stepX = static_cast<float>(splat.Step[k][1]);
    VTK_POINT_SURFACE_LANES
    for (int i = 0; i < Lanes; ++i)
    {
      rays.Start[k][i] = start + i * startX;
      rays.Step[k][i] = step + i * stepX;
    }
  }
  VTK_POINT_SURFACE_LANES
  for (int i = 0; i < Lanes; ++i)
  {
    const float x0 = rays.Start[0][i];
    const float y0 = rays.Start[1][i];
    const float dx = rays.Step[0][i];
    const float dy = rays.Step[1][i];
    const float a = dx * dx + dy * dy;
    const float b = x0 * dx + y0 * dy;
    const float c = x0 * x0 + y0 * y0 - 1.0f;
    const float discriminant = b * b - a * c;
    const float root = std::sqrt(discriminant > 0.0f ? discriminant : 0.0f);
    const bool along = a < 1e-20f; // the axis
    const bool inside = along ? c <= 0.0f : discriminant > 0.0f;
    const float begin = along ? -Far : (-b - root) / a;
    const float end = along ? Far : (-b + root) / a;
    rays.Begin[i] = begin;
    rays.End[i] = inside ? end : -Far;
  }
  const float low = splat.Source->Heights[0];
  const float high = splat.Source->Heights[1];
  alignas(64) float above[Lanes];
  alignas(64) float below[Lanes];
  alignas(64) float down[Lanes];
  VTK_POINT_SURFACE_LANES
  for (int i = 0; i < Lanes; ++i)
  {
    above[i] = rays.Start[2][i] - low;
    below[i] = high - rays.Start[2][i];
    down[i] = -rays.Step[2][i];
  }
  Limit(above, rays.Step[2], rays);
  Limit(below, down, rays);
}

/// Leaves of rays what is before all planes.
VTK_POINT_SURFACE_INLINE void ClipRays(
  const Scene& scene, const TracedSplat& splat, int x, int y, Rays& rays)
{
  for (const auto& plane : scene.Rays.GetPlanes())
  {
    const Linear distance = scene.Rays.GetDistance(plane, -splat.Depth);
    const Linear change = Combine({ plane[0], plane[1], plane[2] }, scene.Rays.GetDirection());
    alignas(64) float value[Lanes];
    alignas(64) float slope[Lanes];
    for (int i = 0; i < Lanes; ++i)
    {
      value[i] = static_cast<float>(At(distance, x + i, y));
      slope[i] = static_cast<float>(splat.Unit * At(change, x + i, y));
    }
    Limit(value, slope, rays);
  }
}

/// Polynomials of a degree, by coefficients.
template <int Degree>
struct Polynomials
{
  alignas(64) float Of[Degree + 1][Lanes];
};

/// As the scalar Compose().
template <int Order>
VTK_POINT_SURFACE_INLINE void Compose(
  const float* c, const float (*start)[Lanes], const float (*step)[Lanes], Polynomials<Order>& sum)
{
  sum = {};
  VTK_POINT_SURFACE_UNROLL
  for (int a = Order; a >= 0; --a)
  {
    Polynomials<Order> inner = {};
    VTK_POINT_SURFACE_UNROLL
    for (int b = Order - a; b >= 0; --b)
    {
      VTK_POINT_SURFACE_UNROLL
      for (int k = Order - a - b; k > 0; --k)
      {
        VTK_POINT_SURFACE_LANES
        for (int i = 0; i < Lanes; ++i)
        {
          inner.Of[k][i] = inner.Of[k][i] * start[1][i] + inner.Of[k - 1][i] * step[1][i];
        }
      }
      const float coefficient = c[vtkAlgebraicSplat::Index(a, b)];
      VTK_POINT_SURFACE_LANES
      for (int i = 0; i < Lanes; ++i)
      {
        inner.Of[0][i] = inner.Of[0][i] * start[1][i] + coefficient;
      }
    }
    VTK_POINT_SURFACE_UNROLL
    for (int k = Order - a; k > 0; --k)
    {
      VTK_POINT_SURFACE_LANES
      for (int i = 0; i < Lanes; ++i)
      {
        sum.Of[k][i] = sum.Of[k][i] * start[0][i] + sum.Of[k - 1][i] * step[0][i] + inner.Of[k][i];
      }
    }
    VTK_POINT_SURFACE_LANES
    for (int i = 0; i < Lanes; ++i)
    {
      sum.Of[0][i] = sum.Of[0][i] * start[0][i] + inner.Of[0][i];
    }
  }
  VTK_POINT_SURFACE_LANES
  for (int i = 0; i < Lanes; ++i)
  {
    sum.Of[0][i] -= start[2][i];
    sum.Of[1][i] -= step[2][i];
  }
}

template <int Degree>
VTK_POINT_SURFACE_INLINE void Evaluate(
  const Polynomials<Degree>& p, const float* t, float* value, float* slope)
{
  VTK_POINT_SURFACE_LANES
  for (int i = 0; i < Lanes; ++i)
  {
    float v = p.Of[Degree][i];
    float s = 0.0f;
    VTK_POINT_SURFACE_UNROLL
    for (int k = Degree - 1; k >= 0; --k)
    {
      s = s * t[i] + v;
      v = v * t[i] + p.Of[k][i];
    }
    value[i] = v;
    slope[i] = s;
  }
}

/// As vtkPolynomialRoots::RootInBracket() between 0 and 1, to the precision of depths along the
/// interval, for those lanes of `seeking` that are not 0.
template <int Degree>
VTK_POINT_SURFACE_INLINE void FindRootsInBracket(
  const Polynomials<Degree>& p, const int* seeking, float* t)
{
  constexpr int MaximumIterations = 40;
  constexpr float Precision = 1.2e-7f;
  alignas(64) float begin[Lanes], end[Lanes], last[Lanes], value[Lanes], slope[Lanes];
  alignas(64) int active[Lanes];
  VTK_POINT_SURFACE_LANES
  for (int i = 0; i < Lanes; ++i)
  {
    float atEnd = 0.0f;
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k <= Degree; ++k)
    {
      atEnd += p.Of[k][i];
    }
    begin[i] = 0.0f;
    end[i] = 1.0f;
    last[i] = 1.0f;
    const float chord = p.Of[0][i] / (p.Of[0][i] - atEnd);
    const bool within = (chord >= 0.0f) & (chord <= 1.0f);
    t[i] = within ? chord : 0.5f;
    active[i] = seeking[i];
  }
  for (int iteration = 0; iteration < MaximumIterations; ++iteration)
  {
    Evaluate<Degree>(p, t, value, slope);
    int any = 0;
    VTK_POINT_SURFACE_LANES
    for (int i = 0; i < Lanes; ++i)
    {
      const bool before = (value[i] < 0.0f) == (p.Of[0][i] < 0.0f);
      begin[i] = before ? t[i] : begin[i];
      end[i] = before ? end[i] : t[i];
      const float newton = t[i] - value[i] / slope[i];
      const float change = std::abs(newton - t[i]);
      const bool good = (newton > begin[i]) & (newton < end[i]) & (change <= 0.5f * last[i]);
      const float next = good ? newton : 0.5f * (begin[i] + end[i]);
      const bool moves = (active[i] != 0) & (value[i] != 0.0f);
      last[i] = std::abs(next - t[i]);
      t[i] = moves ? next : t[i];
      active[i] = (moves & (last[i] > Precision)) ? 1 : 0;
      any |= active[i];
    }
    if (!any)
    {
      break;
    }
  }
}

/// As vtkPolynomialRoots::CountSignChanges().
template <int Degree>
VTK_POINT_SURFACE_INLINE void CountSignChanges(const Polynomials<Degree>& p, int* changes)
{
  // of 1 / binomial(Degree, i) on the way to the Bernstein coefficients, as whole numbers
  constexpr float shares[2][5][5] = { { {}, { 3, 1 }, { 3, 2, 1 }, { 3, 3, 3, 3 } },
    { {}, { 12, 3 }, { 12, 6, 2 }, { 12, 9, 6, 3 }, { 12, 12, 12, 12, 12 } } };
  alignas(64) int negative[Lanes];
  VTK_POINT_SURFACE_LANES
  for (int i = 0; i < Lanes; ++i)
  {
    changes[i] = 0;
    negative[i] = p.Of[0][i] < 0.0f ? 1 : 0;
  }
  VTK_POINT_SURFACE_UNROLL
  for (int order = 1; order <= Degree; ++order)
  {
    alignas(64) float sum[Lanes] = {};
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k <= order; ++k)
    {
      const float share = shares[Degree - 3][order][k];
      VTK_POINT_SURFACE_LANES
      for (int i = 0; i < Lanes; ++i)
      {
        sum[i] += share * p.Of[k][i];
      }
    }
    VTK_POINT_SURFACE_LANES
    for (int i = 0; i < Lanes; ++i)
    {
      const int now = sum[i] < 0.0f ? 1 : 0;
      changes[i] += now ^ negative[i];
      negative[i] = now;
    }
  }
}

/// The first roots in [0, 1] for those lanes of `found` that are not 0; it becomes 0 where there is
/// none. Most lanes are done together, the others one by one.
template <int Order>
VTK_POINT_SURFACE_INLINE void FindFirstRoots(const float* coefficients, const float (*start)[Lanes],
  const float (*step)[Lanes], int* found, float* t)
{
  Polynomials<Order> p;
  Compose<Order>(coefficients, start, step, p);
  if constexpr (Order == 1)
  {
    VTK_POINT_SURFACE_LANES
    for (int i = 0; i < Lanes; ++i)
    {
      t[i] = -p.Of[0][i] / p.Of[1][i];
      found[i] &= ((t[i] >= 0.0f) & (t[i] <= 1.0f)) ? 1 : 0;
    }
  }
  else if constexpr (Order == 2)
  {
    VTK_POINT_SURFACE_LANES
    for (int i = 0; i < Lanes; ++i)
    {
      const float half = -0.5f * p.Of[1][i];
      // exact products: nearly equal ones would leave rounding alone, and with it wrong roots
      const auto discriminant = static_cast<float>(
        static_cast<double>(half) * half - static_cast<double>(p.Of[2][i]) * p.Of[0][i]);
      const float size = std::sqrt(discriminant > 0.0f ? discriminant : 0.0f);
      const float sum = half < 0.0f ? half - size : half + size;
      const float one = sum / p.Of[2][i];
      const float other = p.Of[0][i] / sum;
      const bool hitsOne = (one >= 0.0f) & (one <= 1.0f);
      const bool hitsOther = (other >= 0.0f) & (other <= 1.0f);
      const bool takesOne = hitsOne & (!hitsOther | (one < other));
      t[i] = takesOne ? one : other;
      found[i] &= (discriminant >= 0.0f) & (hitsOne | hitsOther) ? 1 : 0;
    }
  }
  else
  {
    alignas(64) int changes[Lanes];
    CountSignChanges<Order>(p, changes);
    alignas(64) int single[Lanes];
    int severalFound = 0;
    VTK_POINT_SURFACE_LANES
    for (int i = 0; i < Lanes; ++i)
    {
      single[i] = (found[i] != 0) & (changes[i] == 1) ? 1 : 0;
      severalFound |= (found[i] != 0) & (changes[i] > 1) ? 1 : 0;
      found[i] &= changes[i] > 0 ? 1 : 0;
    }
    FindRootsInBracket<Order>(p, single, t);
    for (int i = 0; severalFound && i < Lanes; ++i)
    {
      if (found[i] && !single[i])
      {
        double root = 0.0;
        found[i] = vtkPolynomialRoots::FirstRoot<Order>(
          Compose<Order>(coefficients, { start[0][i], start[1][i], start[2][i] },
            { step[0][i], step[1][i], step[2][i] }),
          root);
        t[i] = static_cast<float>(root);
      }
    }
  }
}

/// The gradient of g.
template <int Order>
VTK_POINT_SURFACE_INLINE void GetSlopes(
  const float* c, const float* u, const float* v, float* du, float* dv)
{
  VTK_POINT_SURFACE_LANES
  for (int i = 0; i < Lanes; ++i)
  {
    float alongU = 0.0f;
    float alongV = 0.0f;
    VTK_POINT_SURFACE_UNROLL
    for (int a = Order; a >= 0; --a)
    {
      float inner = 0.0f;
      float innerSlope = 0.0f;
      VTK_POINT_SURFACE_UNROLL
      for (int b = Order - a; b >= 0; --b)
      {
        const float coefficient = c[vtkAlgebraicSplat::Index(a, b)];
        inner = inner * v[i] + coefficient;
        innerSlope = b > 0 ? innerSlope * v[i] + b * coefficient : innerSlope;
      }
      alongU = a > 0 ? alongU * u[i] + a * inner : alongU;
      alongV = alongV * u[i] + innerSlope;
    }
    du[i] = alongU;
    dv[i] = alongV;
  }
}

/// What is found in a tile: all hits, and how far they leave it open.
struct TileHits
{
  std::vector<Hit> Hits;
  alignas(64) float Visible[TileSize * Stride]; // what is farther is hidden
};

/// The hits of a splat in a tile, but for those that are hidden.
template <int Order>
VTK_POINT_SURFACE_INLINE void TraceSplat(
  const Scene& scene, const TracedSplat& splat, const std::array<int, 4>& area, TileHits& tile)
{
  const int x0 = std::max(area[0], splat.Bounds[0]);
  const int x1 = std::min(area[2], splat.Bounds[2]);
  const int y0 = std::max(area[1], splat.Bounds[1]);
  const int y1 = std::min(area[3], splat.Bounds[3]);
  const float* coefficients = splat.Source->Coefficients.data();
  const auto& toLocal = splat.ToLocal;
  for (int y = y0; y < y1; ++y)
  {
    for (int x = x0; x < x1; x += Lanes)
    {
      const int first = (y - area[1]) * Stride + x - area[0];
      float* visible = tile.Visible + first;
      const int count = std::min(Lanes, x1 - x);
      Rays rays;
      MakeRays(splat, x, y, rays);
      if (splat.Clipped)
      {
        ClipRays(scene, splat, x, y, rays);
      }
      alignas(64) int found[Lanes];
      int any = 0;
      VTK_POINT_SURFACE_LANES
      for (int i = 0; i < Lanes; ++i)
      {
        const float nearest = splat.Depth + splat.Unit * rays.Begin[i];
        const bool open = (rays.Begin[i] < rays.End[i]) & (nearest <= visible[i]) & (i < count);
        found[i] = open ? 1 : 0;
        any |= found[i];
      }
      if (!any)
      {
        continue;
      }
      for (int k = 0; k < 3; ++k)
      {
        VTK_POINT_SURFACE_LANES
        for (int i = 0; i < Lanes; ++i)
        {
          rays.Start[k][i] += rays.Begin[i] * rays.Step[k][i];
          rays.Step[k][i] *= rays.End[i] - rays.Begin[i];
        }
      }
      alignas(64) float t[Lanes], u[Lanes], v[Lanes], du[Lanes], dv[Lanes];
      FindFirstRoots<Order>(coefficients, rays.Start, rays.Step, found, t);
      VTK_POINT_SURFACE_LANES
      for (int i = 0; i < Lanes; ++i)
      {
        u[i] = rays.Start[0][i] + t[i] * rays.Step[0][i];
        v[i] = rays.Start[1][i] + t[i] * rays.Step[1][i];
      }
      GetSlopes<Order>(coefficients, u, v, du, dv);
      alignas(64) float normal[3][Lanes], depth[Lanes];
      alignas(64) int front[Lanes];
      const auto& ofX = scene.DirectionX;
      const auto& ofY = scene.DirectionY;
      const float directionX = ofX[0] + x * ofX[1] + y * ofX[2];
      const float directionY = ofY[0] + x * ofY[1] + y * ofY[2];
      any = 0;
      VTK_POINT_SURFACE_LANES
      for (int i = 0; i < Lanes; ++i)
      {
        const float nx = toLocal[2][0] - du[i] * toLocal[0][0] - dv[i] * toLocal[1][0];
        const float ny = toLocal[2][1] - du[i] * toLocal[0][1] - dv[i] * toLocal[1][1];
        const float nz = toLocal[2][2] - du[i] * toLocal[0][2] - dv[i] * toLocal[1][2];
        const float size = std::sqrt(nx * nx + ny * ny + nz * nz);
        const float facing = nx * (directionX + i * ofX[1]) + ny * (directionY + i * ofY[1]) - nz;
        const bool isFront = facing < 0.0f;
        const bool culled = isFront ? splat.CullFront : splat.CullBack;
        normal[0][i] = nx / size;
        normal[1][i] = ny / size;
        normal[2][i] = nz / size;
        front[i] = isFront ? 1 : 0;
        depth[i] =
          splat.Depth + splat.Unit * (rays.Begin[i] + t[i] * (rays.End[i] - rays.Begin[i]));
        found[i] = culled ? 0 : found[i];
        const float shifted = scene.Shift * depth[i];
        visible[i] = (found[i] != 0) & (shifted < visible[i]) ? shifted : visible[i];
        any |= found[i];
      }
      for (int i = 0; any && i < Lanes; ++i)
      {
        if (found[i])
        {
          const int pixel = (y - area[1]) * TileSize + x - area[0] + i;
          tile.Hits.push_back({ static_cast<std::uint16_t>(pixel), front[i] != 0, depth[i],
            u[i] * u[i] + v[i] * v[i], { normal[0][i], normal[1][i], normal[2][i] }, &splat });
        }
      }
    }
  }
}

VTK_POINT_SURFACE_CLONES
void TracePlane(
  const Scene& scene, const TracedSplat& splat, const std::array<int, 4>& area, TileHits& tile)
{
  TraceSplat<1>(scene, splat, area, tile);
}

VTK_POINT_SURFACE_CLONES
void TraceQuadric(
  const Scene& scene, const TracedSplat& splat, const std::array<int, 4>& area, TileHits& tile)
{
  TraceSplat<2>(scene, splat, area, tile);
}

VTK_POINT_SURFACE_CLONES
void TraceCubic(
  const Scene& scene, const TracedSplat& splat, const std::array<int, 4>& area, TileHits& tile)
{
  TraceSplat<3>(scene, splat, area, tile);
}

VTK_POINT_SURFACE_CLONES
void TraceQuartic(
  const Scene& scene, const TracedSplat& splat, const std::array<int, 4>& area, TileHits& tile)
{
  TraceSplat<4>(scene, splat, area, tile);
}

constexpr decltype(&TracePlane) TraceBy[] = { TracePlane, TraceQuadric, TraceCubic, TraceQuartic };

/// One tile after the other, with room for the hits of one.
class Tiles
{
public:
  Tiles(const Scene& scene, const vtkAlgebraicSplatOptions& options,
    const std::vector<TracedSplat>& splats, vtkSurfacePixels& surface)
    : MyScene(scene)
    , Options(options)
    , Splats(splats)
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

  // From front to back, so that most of what is hidden is known to be before its roots are sought.
  void Draw(int index, TileHits& tile)
  {
    const auto& r = this->Surface.Rectangle;
    const int x0 = r[0] + index % this->Columns * TileSize;
    const int y0 = r[1] + index / this->Columns * TileSize;
    const std::array<int, 4> area = { x0, y0, std::min(x0 + TileSize, r[2]),
      std::min(y0 + TileSize, r[3]) };
    std::vector<int>& list = this->Lists[index];
    std::stable_sort(list.begin(), list.end(),
      [this](int a, int b) { return this->Splats[a].Nearest < this->Splats[b].Nearest; });
    tile.Hits.clear();
    std::fill_n(tile.Visible, TileSize * Stride, Far);
    for (int i : list)
    {
      const TracedSplat& splat = this->Splats[i];
      TraceBy[splat.Order - 1](this->MyScene, splat, area, tile);
    }
    this->Blend(area, tile);
  }

private:
  void Blend(const std::array<int, 4>& area, const TileHits& tile) const
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
    const auto falloff = static_cast<float>(this->Options.WeightFalloff);
    for (const Hit& hit : tile.Hits)
    {
      float& nearness = visible[hit.Pixel][hit.Front || !this->Options.SeparateSides ? 1 : 0];
      nearness = std::max(nearness, 1.0f / (this->MyScene.Shift * hit.Depth));
    }
    for (const Hit& hit : tile.Hits)
    {
      const auto& nearness = visible[hit.Pixel];
      const bool front = nearness[1] >= nearness[0];
      if ((this->Options.SeparateSides && hit.Front != front) ||
        hit.Depth * nearness[front ? 1 : 0] > 1.0f)
      {
        continue;
      }
      Sum& sum = sums[hit.Pixel];
      const float weight = std::exp(-falloff * hit.Square);
      for (int k = 0; k < 3; ++k)
      {
        sum.Normal[k] += weight * hit.Normal[k];
      }
      sum.Depth += weight * hit.Depth;
      sum.Weight += weight;
      if (!this->Surface.Color.empty())
      {
        const std::array<float, 4> color = hit.Splat->Of->Color(hit.Splat->Source->Id);
        for (int k = 0; k < 4; ++k)
        {
          sum.Color[k] += weight * color[k];
        }
      }
      if (weight > sum.Heaviest)
      {
        sum.Heaviest = weight;
        sum.Id = static_cast<unsigned int>(hit.Splat->Of->FirstId) + hit.Splat->Source->Id + 1;
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

  const Scene& MyScene;
  const vtkAlgebraicSplatOptions& Options;
  const std::vector<TracedSplat>& Splats;
  vtkSurfacePixels& Surface;
  int Columns = 0;
  int Rows = 0;
  std::vector<std::vector<int>> Lists; // of splats, by tile
};

void Place(const Cloud& cloud, std::vector<TracedSplat>& placed)
{
  const Placer placer(cloud.View, cloud.Splats->GetOrigin());
  for (int order = 1; order <= vtkAlgebraicSplat::MaximumOrder; ++order)
  {
    const std::vector<Splat>& group = cloud.Splats->GetSplats(order);
    for (const vtkDrawableSplats::Range& range : cloud.Splats->GetRanges(order, cloud.View.Ranges))
    {
      const vtkIdType first = static_cast<vtkIdType>(placed.size()) - range[0];
      placed.resize(placed.size() + range[1] - range[0]);
      vtkSMPTools::For(range[0], range[1],
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType i = begin; i < end; ++i)
          {
            placed[first + i] = placer.Place(group[i], order);
            placed[first + i].Of = &cloud;
          }
        });
    }
  }
}
}

void vtkAlgebraicSplatTracingCPU::Run(const std::vector<Cloud>& clouds,
  const vtkPointSurfaceView& view, const vtkAlgebraicSplatOptions& options, bool ids, bool colors,
  vtkSurfacePixels& surface)
{
  const auto& r = view.Rectangle;
  surface.Allocate({ r[0], r[1], r[0] + r[2], r[1] + r[3] }, ids, colors);
  std::vector<TracedSplat> placed;
  for (const Cloud& cloud : clouds)
  {
    Place(cloud, placed);
  }

  const Placer rays(clouds.front().View, clouds.front().Splats->GetOrigin());
  const Scene scene(rays, options);
  Tiles tiles(scene, options, placed, surface);
  vtkSMPThreadLocal<TileHits> hits;
  vtkSMPTools::For(0, tiles.GetNumberOfTiles(), 4,
    [&](vtkIdType begin, vtkIdType end)
    {
      TileHits& tile = hits.Local();
      for (vtkIdType i = begin; i < end; ++i)
      {
        tiles.Draw(static_cast<int>(i), tile);
      }
    });
}
