// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSpaceReference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

using Pixel = ImageSpaceReference::Pixel;

namespace
{
// A few units in the last place of the float depths that are compared.
constexpr double CLOSE = 5e-7;

// Figure 4, rows from top to bottom: the runs of five white pixels in a row around the centre.
const char* const MASKS[8] = {
  "www"
  "w.w"
  "...",
  "ww."
  "w.."
  "ww.",
  "..."
  "w.w"
  "www",
  ".ww"
  "..w"
  ".ww",
  "www"
  "w.."
  "w..",
  "w.."
  "w.."
  "www",
  "..w"
  "..w"
  "www",
  "www"
  "..w"
  "..w",
};

// Counter-clockwise from the right.
constexpr int AROUND[8][2] = { { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, 1 }, { -1, 0 }, { -1, -1 },
  { 0, -1 }, { 1, -1 } };

bool IsClose(double a, double b)
{
  return std::isfinite(b) && std::abs(a - b) <= CLOSE * std::max(std::abs(a), std::abs(b));
}
}

//------------------------------------------------------------------------------
ImageSpaceReference::ImageSpaceReference(int width, int height)
  : Width(width)
  , Height(height)
  , Pixels(static_cast<size_t>(width) * height)
{
}

//------------------------------------------------------------------------------
const Pixel& ImageSpaceReference::Get(int x, int y) const
{
  static const Pixel background;
  const bool inside = x >= 0 && y >= 0 && x < this->Width && y < this->Height;
  return inside ? this->Pixels[static_cast<size_t>(y) * this->Width + x] : background;
}

//------------------------------------------------------------------------------
bool ImageSpaceReference::IsInFront(const Pixel& pixel, double limit, CloseCalls closeCalls) const
{
  const bool close = pixel.NearDecision || (pixel.Depth > 0.0 && IsClose(pixel.Depth, limit));
  return close && closeCalls != AsTheyAre ? closeCalls == InFront
                                          : pixel.Depth > 0.0 && pixel.Depth <= limit;
}

//------------------------------------------------------------------------------
// Whether three neighbouring directions are open.
bool ImageSpaceReference::IsOpen(int x, int y, double limit, int reach, CloseCalls closeCalls) const
{
  bool open[8];
  for (int i = 0; i < 8; ++i)
  {
    open[i] = true;
    for (int far = 1; far <= reach; ++far)
    {
      const Pixel& other = this->Get(x + far * AROUND[i][0], y + far * AROUND[i][1]);
      open[i] &= !this->IsInFront(other, limit, closeCalls);
    }
  }
  bool any = false;
  for (int i = 0; i < 8; ++i)
  {
    any |= reach > 0 && open[i] && open[(i + 1) % 8] && open[(i + 2) % 8];
  }
  return any;
}

//------------------------------------------------------------------------------
// "For each mask the depth values of corresponding white pixels are summed up. If the product of
// all eight sums equals zero, at least one of the eight filters detected that the observed pixel is
// beyond the object's silhouette." What is deeper than the limit counts as zero.
bool ImageSpaceReference::MaskFits(int x, int y, double limit, CloseCalls closeCalls) const
{
  bool fits = false;
  for (const char* mask : MASKS)
  {
    double sum = 0.0;
    for (int i = 0; i < 9; ++i)
    {
      if (mask[i] == 'w')
      {
        const Pixel& other = this->Get(x + i % 3 - 1, y + 1 - i / 3);
        sum += this->IsInFront(other, limit, closeCalls) ? std::max(other.Depth, 1.0) : 0.0;
      }
    }
    fits |= sum == 0.0;
  }
  return fits;
}

//------------------------------------------------------------------------------
bool ImageSpaceReference::FillPixel(
  const ImageSpaceReference& before, int x, int y, double limit, int reach)
{
  Pixel& pixel = this->At(x, y);
  auto stays = [&](CloseCalls closeCalls)
  {
    return before.MaskFits(x, y, limit, closeCalls) ||
      before.IsOpen(x, y, limit, reach, closeCalls);
  };
  pixel.NearDecision |= stays(InFront) != stays(Beyond);
  if (stays(AsTheyAre))
  {
    return false;
  }
  const Pixel* nearest = nullptr;
  for (const auto& offset : AROUND)
  {
    const Pixel& other = before.Get(x + offset[0], y + offset[1]);
    pixel.NearDecision |= other.NearDecision;
    if (other.Depth > 0.0 && other.Depth <= limit && (!nearest || other.Depth < nearest->Depth))
    {
      nearest = &other;
    }
  }
  const bool near = pixel.NearDecision;
  pixel = *nearest;
  pixel.NearDecision |= near;
  return true;
}

//------------------------------------------------------------------------------
// How far out the pixel (x, y) lies in the disc of the point of (u, v), widened by half a pixel:
// a disc C + s A + t B is projected to c + s a + t b to first order, where s^2 + t^2 <= 1.
double ImageSpaceReference::GetDiscDistance(const Camera& camera, int x, int y, int u, int v) const
{
  const Pixel& point = this->Get(u, v);
  const auto& n = point.Normal;
  const double center[2] = { u + 0.5 + point.Displacement[0], v + 0.5 + point.Displacement[1] };
  const double scale = camera.Parallel ? 1.0 : point.Depth;
  double eye[3] = { 0.0, 0.0, -point.Depth };
  for (int k = 0; k < 2; ++k)
  {
    eye[k] = (center[k] - camera.Center[k]) * scale / camera.Focal;
  }
  auto project = [&](const double* axis, double step, double* pixel)
  {
    const double depth = camera.Parallel ? 1.0 : -(eye[2] + step * axis[2]);
    for (int k = 0; k < 2; ++k)
    {
      pixel[k] = camera.Center[k] + camera.Focal * (eye[k] + step * axis[k]) / depth;
    }
  };
  // an axis across the normal, and one across both
  const int least = std::abs(n[0]) < 0.6 ? 0 : 1;
  double first[3] = { -n[least] * n[0], -n[least] * n[1], -n[least] * n[2] };
  first[least] += 1.0;
  const double length = std::sqrt(first[0] * first[0] + first[1] * first[1] + first[2] * first[2]);
  for (double& value : first)
  {
    value /= length;
  }
  const double second[3] = { n[1] * first[2] - n[2] * first[1], n[2] * first[0] - n[0] * first[2],
    n[0] * first[1] - n[1] * first[0] };
  const double radius = 0.6 * point.Radius;
  const double step = 1e-4 * radius;
  double xx = 0.5 * 0.5;
  double yy = 0.5 * 0.5;
  double xy = 0.0;
  for (const double* axis : { static_cast<const double*>(first), second })
  {
    double before[2];
    double after[2];
    project(axis, -step, before);
    project(axis, step, after);
    const double a = radius * (after[0] - before[0]) / (2.0 * step);
    const double b = radius * (after[1] - before[1]) / (2.0 * step);
    xx += a * a;
    yy += b * b;
    xy += a * b;
  }
  const double dx = x + 0.5 - center[0];
  const double dy = y + 0.5 - center[1];
  return (yy * dx * dx - 2.0 * xy * dx * dy + xx * dy * dy) / (xx * yy - xy * xy);
}

//------------------------------------------------------------------------------
void ImageSpaceReference::FillWithinDiscs(const Camera& camera, int reach, double layerDistance)
{
  struct Disc
  {
    const Pixel* Point;
    double Distance;
  };
  auto isNear = [](double a, double b) { return std::abs(a - b) < 1e-4 * b; };
  const ImageSpaceReference before = *this;
  for (int y = 0; y < this->Height; ++y)
  {
    for (int x = 0; x < this->Width; ++x)
    {
      Pixel& pixel = this->At(x, y);
      std::vector<Disc> discs;
      int near = 0;
      const double limit =
        pixel.Depth > 0.0 ? pixel.Depth - layerDistance : std::numeric_limits<double>::infinity();
      double front = std::numeric_limits<double>::infinity();
      for (int v = y - reach; v <= y + reach; ++v)
      {
        for (int u = x - reach; u <= x + reach; ++u)
        {
          const Pixel& point = before.Get(u, v);
          pixel.NearDecision |= point.Depth > 0.0 && IsClose(point.Depth, limit);
          if (point.Depth == 0.0 || point.Depth > limit || (u == x && v == y))
          {
            continue;
          }
          const double distance = before.GetDiscDistance(camera, x, y, u, v);
          pixel.NearDecision |= isNear(distance, 1.0) || isNear(distance, 4.0);
          near += distance <= 4.0;
          if (distance <= 1.0)
          {
            discs.push_back({ &point, distance });
            front = std::min(front, point.Depth);
          }
        }
      }
      const Disc* best = nullptr;
      for (const Disc& disc : discs)
      {
        pixel.NearDecision |= IsClose(disc.Point->Depth, front + layerDistance);
        if (disc.Point->Depth > front + layerDistance)
        {
          continue;
        }
        pixel.NearDecision |= best && isNear(disc.Distance, best->Distance);
        best = !best || disc.Distance < best->Distance ? &disc : best;
      }
      if (best && near >= 2)
      {
        const bool close = pixel.NearDecision;
        pixel = *best->Point;
        pixel.NearDecision = close;
      }
    }
  }
}

//------------------------------------------------------------------------------
int ImageSpaceReference::FillBackground(int maximum, int reach)
{
  for (int iteration = 0; iteration < maximum; ++iteration)
  {
    const ImageSpaceReference before = *this;
    bool filled = false;
    for (int y = 0; y < this->Height; ++y)
    {
      for (int x = 0; x < this->Width; ++x)
      {
        if (before.Get(x, y).Depth == 0.0)
        {
          filled |= this->FillPixel(before, x, y, std::numeric_limits<double>::infinity(), reach);
        }
      }
    }
    if (!filled)
    {
      return iteration;
    }
  }
  return maximum;
}

//------------------------------------------------------------------------------
int ImageSpaceReference::FillOccluded(int maximum, double layerDistance, int reach)
{
  for (int iteration = 0; iteration < maximum; ++iteration)
  {
    const ImageSpaceReference before = *this;
    bool filled = false;
    for (int y = 0; y < this->Height; ++y)
    {
      for (int x = 0; x < this->Width; ++x)
      {
        const double depth = before.Get(x, y).Depth;
        if (depth > 0.0)
        {
          filled |= this->FillPixel(before, x, y, depth - layerDistance, reach);
        }
      }
    }
    if (!filled)
    {
      return iteration;
    }
  }
  return maximum;
}

//------------------------------------------------------------------------------
void ImageSpaceReference::Smooth(
  const std::array<double, 3>& weights, double layerDistance, bool twoSided)
{
  const ImageSpaceReference before = *this;
  for (int y = 0; y < this->Height; ++y)
  {
    for (int x = 0; x < this->Width; ++x)
    {
      const Pixel& own = before.Get(x, y);
      if (own.Depth == 0.0)
      {
        continue;
      }
      Pixel sum;
      double total = 0.0;
      for (int i = 0; i < 9; ++i)
      {
        const int dx = i % 3 - 1;
        const int dy = i / 3 - 1;
        const Pixel& other = before.Get(x + dx, y + dy);
        const double apart = std::abs(other.Depth - own.Depth);
        sum.NearDecision |= other.NearDecision ||
          (other.Depth > 0.0 && std::abs(apart - layerDistance) <= 2.0 * CLOSE * own.Depth);
        if (other.Depth == 0.0 || apart > layerDistance)
        {
          continue;
        }
        const double alike = own.Normal[0] * other.Normal[0] + own.Normal[1] * other.Normal[1] +
          own.Normal[2] * other.Normal[2];
        sum.NearDecision |= twoSided && std::abs(alike) <= CLOSE;
        const double side = twoSided && alike < 0.0 ? -1.0 : 1.0;
        const double weight = weights[std::abs(dx) + std::abs(dy)];
        total += weight;
        sum.Depth += weight * other.Depth;
        for (int k = 0; k < 3; ++k)
        {
          sum.Normal[k] += weight * side * other.Normal[k];
        }
        for (int k = 0; k < 4; ++k)
        {
          sum.Color[k] += weight * other.Color[k];
        }
      }
      const double length = std::sqrt(sum.Normal[0] * sum.Normal[0] +
        sum.Normal[1] * sum.Normal[1] + sum.Normal[2] * sum.Normal[2]);
      Pixel& result = this->At(x, y);
      result.NearDecision |= sum.NearDecision || std::abs(length - 1e-6 * total) <= CLOSE * total;
      result.Depth = sum.Depth / total;
      for (int k = 0; k < 3; ++k)
      {
        result.Normal[k] = length < 1e-6 * total ? own.Normal[k] : sum.Normal[k] / length;
      }
      for (int k = 0; k < 4; ++k)
      {
        result.Color[k] = sum.Color[k] / total;
      }
    }
  }
}

//------------------------------------------------------------------------------
double ImageSpaceReference::Laplace(int x, int y) const
{
  const double own = this->Get(x, y).Depth;
  double sum = 4.0 * own;
  for (int i = 0; i < 8; i += 2)
  {
    const int nx = x + AROUND[i][0];
    const int ny = y + AROUND[i][1];
    if (nx < 0 || ny < 0 || nx >= this->Width || ny >= this->Height)
    {
      sum -= own; // no border is known there
      continue;
    }
    const double other = this->Get(nx, ny).Depth;
    if ((other == 0.0) != (own == 0.0))
    {
      return std::numeric_limits<double>::infinity();
    }
    sum -= other;
  }
  return sum;
}

//------------------------------------------------------------------------------
std::array<double, 4> ImageSpaceReference::Blend(int x, int y) const
{
  const double weights[3] = { 4.0, 2.0, 1.0 };
  std::array<double, 4> color{};
  double total = 0.0;
  for (int i = 0; i < 9; ++i)
  {
    const int dx = i % 3 - 1;
    const int dy = i / 3 - 1;
    if (x + dx < 0 || y + dy < 0 || x + dx >= this->Width || y + dy >= this->Height)
    {
      continue;
    }
    const double weight = weights[std::abs(dx) + std::abs(dy)];
    total += weight;
    for (int k = 0; k < 4; ++k)
    {
      color[k] += weight * this->Get(x + dx, y + dy).Color[k];
    }
  }
  for (double& value : color)
  {
    value /= total;
  }
  return color;
}
