// SPDX-License-Identifier: BSD-3-Clause
#include "PullPushReference.h"

#include <algorithm>
#include <cmath>

using Pixel = PullPushReference::Pixel;
using Image = PullPushReference::Image;
using Vector2 = std::array<double, 2>;
using Vector3 = std::array<double, 3>;

namespace
{
constexpr double CLOSE = 1e-5;
constexpr double SHORTEST_NORMAL_SUM = 1e-6;
constexpr double SMALLEST_SQUEEZE = 1e-3;

bool IsClose(double a, double b)
{
  return std::abs(a - b) <= CLOSE * std::max(std::abs(a), std::abs(b));
}

double Length(const Vector3& v)
{
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

Vector2 PixelCenter(int level, int x, int y)
{
  const double size = std::ldexp(1.0, level);
  return { (x + 0.5) * size, (y + 0.5) * size };
}

// Section 3.3: a valid pixel is occluded if its minimum depth is outside of the interval of the
// corresponding coarser pixel.
bool IsOccluded(const Pixel& pixel, const Pixel& coarse, bool& nearDecision)
{
  // The minimum of a coarser pixel that the push phase left alone is a point's depth, as the
  // pixel's own is. Such numbers are copied, never computed, so that no rounding turns their order.
  nearDecision |= (coarse.Recomputed && IsClose(pixel.MinimumDepth, coarse.MinimumDepth)) ||
    IsClose(pixel.MinimumDepth, coarse.MaximumDepth);
  return pixel.MinimumDepth < coarse.MinimumDepth || pixel.MinimumDepth > coarse.MaximumDepth;
}
}

//------------------------------------------------------------------------------
PullPushReference::Image::Image(int width, int height)
  : Width(width)
  , Height(height)
  , Pixels(static_cast<size_t>(width) * height)
{
}

//------------------------------------------------------------------------------
bool PullPushReference::Image::Contains(int x, int y) const
{
  return x >= 0 && y >= 0 && x < this->Width && y < this->Height;
}

//------------------------------------------------------------------------------
Pixel PullPushReference::MakePoint(const Vector3& normal, double radius, double depth, int source)
{
  Pixel pixel;
  pixel.Valid = true;
  pixel.Normal = normal;
  pixel.Radius = radius;
  pixel.MinimumDepth = depth;
  pixel.MaximumDepth = depth + radius;
  pixel.Source = source;
  return pixel;
}

//------------------------------------------------------------------------------
int PullPushReference::FullLevels(int width, int height)
{
  int levels = 0;
  for (int size = std::max(width, height); size > 1; size = (size + 1) / 2)
  {
    ++levels;
  }
  return levels;
}

//------------------------------------------------------------------------------
PullPushReference::PullPushReference(const Image& projected, const Matrix& projection, int levels)
  : Levels{ projected }
  , Projection(projection)
{
  for (int fine = 0; fine < levels; ++fine)
  {
    this->Pull(fine);
  }
  for (int fine = levels - 1; fine >= 0; --fine)
  {
    this->Push(fine);
  }
}

//------------------------------------------------------------------------------
void PullPushReference::Pull(int fineLevel)
{
  const Image& fine = this->Levels[fineLevel];
  Image coarse((fine.GetWidth() + 1) / 2, (fine.GetHeight() + 1) / 2);
  for (int y = 0; y < coarse.GetHeight(); ++y)
  {
    for (int x = 0; x < coarse.GetWidth(); ++x)
    {
      coarse.At(x, y) = this->PullPixel(fineLevel, x, y);
    }
  }
  this->Levels.push_back(coarse);
}

//------------------------------------------------------------------------------
// Section 3.2, for the pixel (x, y) of the next coarser level.
Pixel PullPushReference::PullPixel(int fineLevel, int x, int y) const
{
  const Image& fine = this->Levels[fineLevel];
  std::vector<Contributor> children;
  for (int child = 0; child < 4; ++child)
  {
    const int childX = 2 * x + child % 2;
    const int childY = 2 * y + child / 2;
    if (fine.Contains(childX, childY) && fine.At(childX, childY).Valid)
    {
      children.push_back({ &fine.At(childX, childY), 1.0, PixelCenter(fineLevel, childX, childY) });
    }
  }
  if (children.empty())
  {
    return Pixel();
  }

  // Minimum depths are the points' depths, copied: which one is in front is no close call.
  const Contributor front = *std::min_element(children.begin(), children.end(),
    [](const Contributor& a, const Contributor& b)
    { return a.Source->MinimumDepth < b.Source->MinimumDepth; });
  bool nearDecision = false;
  std::vector<Contributor> kept;
  for (const Contributor& child : children)
  {
    const double depth = child.Source->MinimumDepth;
    nearDecision |= child.Source != front.Source && IsClose(depth, front.Source->MaximumDepth);
    if (depth <= front.Source->MaximumDepth)
    {
      kept.push_back(child);
    }
  }

  Pixel result = Average(kept, front, PixelCenter(fineLevel + 1, x, y));
  result.NearDecision |= nearDecision;
  result.MinimumDepth = front.Source->MinimumDepth;
  result.MaximumDepth = front.Source->MaximumDepth;
  for (const Contributor& child : kept)
  {
    result.MaximumDepth = std::max(result.MaximumDepth, child.Source->MaximumDepth);
  }
  return result;
}

//------------------------------------------------------------------------------
void PullPushReference::Push(int fineLevel)
{
  Image result = this->Levels[fineLevel];
  for (int y = 0; y < result.GetHeight(); ++y)
  {
    for (int x = 0; x < result.GetWidth(); ++x)
    {
      result.At(x, y) = this->PushPixel(fineLevel, x, y);
    }
  }
  this->Levels[fineLevel] = result;
}

//------------------------------------------------------------------------------
// Section 3.3, for the pixel (x, y) of the finer level.
Pixel PullPushReference::PushPixel(int fineLevel, int x, int y) const
{
  Pixel own = this->Levels[fineLevel].At(x, y);
  const Pixel& coarse = this->Levels[fineLevel + 1].At(x / 2, y / 2);
  if (own.Valid && !IsOccluded(own, coarse, own.NearDecision))
  {
    return own;
  }

  const std::vector<Contributor> contributors =
    this->FindContributors(fineLevel, x, y, own.NearDecision);
  if (contributors.empty())
  {
    return own;
  }
  // The weights are constants, so that a tie is one in every precision.
  const Contributor greatest = *std::max_element(contributors.begin(), contributors.end(),
    [](const Contributor& a, const Contributor& b) { return a.Weight < b.Weight; });
  Pixel result = Average(contributors, greatest, PixelCenter(fineLevel, x, y));
  result.NearDecision |= own.NearDecision;
  result.Recomputed = true;
  return result;
}

//------------------------------------------------------------------------------
// The coarser pixels around (x, y) that are valid and whose ellipses contain its centre, with the
// weights of figure 4: own column and row, neighbour column, neighbour row, both neighbours.
std::vector<PullPushReference::Contributor> PullPushReference::FindContributors(
  int fineLevel, int x, int y, bool& nearDecision) const
{
  const Image& coarse = this->Levels[fineLevel + 1];
  const Vector2 center = PixelCenter(fineLevel, x, y);
  const int sideX = x % 2 == 1 ? 1 : -1;
  const int sideY = y % 2 == 1 ? 1 : -1;
  std::vector<Contributor> contributors;
  for (int neighbor = 0; neighbor < 4; ++neighbor)
  {
    const bool otherColumn = neighbor % 2 == 1;
    const bool otherRow = neighbor / 2 == 1;
    const int coarseX = x / 2 + (otherColumn ? sideX : 0);
    const int coarseY = y / 2 + (otherRow ? sideY : 0);
    if (!coarse.Contains(coarseX, coarseY))
    {
      continue;
    }
    const Pixel& pixel = coarse.At(coarseX, coarseY);
    if (!pixel.Valid)
    {
      nearDecision |= pixel.NearDecision;
      continue;
    }
    const Vector2 pixelCenter = PixelCenter(fineLevel + 1, coarseX, coarseY);
    if (this->EllipseContains(pixel, pixelCenter, center, nearDecision))
    {
      const double weight = (otherColumn ? 0.25 : 0.75) * (otherRow ? 0.25 : 0.75);
      contributors.push_back({ &pixel, weight, pixelCenter });
    }
  }
  return contributors;
}

//------------------------------------------------------------------------------
// Section 3.2: the ellipse is the orthogonal projection of a disc of the pixel's radius and normal,
// its minor axis along the projected normal and shorter by the normal's z.
bool PullPushReference::EllipseContains(
  const Pixel& pixel, const Vector2& pixelCenter, const Vector2& center, bool& nearDecision) const
{
  const Matrix& p = this->Projection;
  const double clipW = p[14] * -pixel.MinimumDepth + p[15];
  const double width = this->Levels[0].GetWidth();
  const double height = this->Levels[0].GetHeight();
  const double clipX = (center[0] - pixelCenter[0] - pixel.Displacement[0]) * 2.0 * clipW / width;
  const double clipY = (center[1] - pixelCenter[1] - pixel.Displacement[1]) * 2.0 * clipW / height;
  const double eyeY = clipY / p[5];
  const double eyeX = (clipX - p[1] * eyeY) / p[0]; // a camera's transform may shear the picture

  double distance2 = eyeX * eyeX + eyeY * eyeY;
  const double tilt = std::hypot(pixel.Normal[0], pixel.Normal[1]);
  if (tilt >= 1e-6)
  {
    const double minorX = pixel.Normal[0] / tilt;
    const double minorY = pixel.Normal[1] / tilt;
    const double squeeze = std::max(std::abs(pixel.Normal[2]), SMALLEST_SQUEEZE);
    const double alongMinor = (eyeX * minorX + eyeY * minorY) / squeeze;
    const double alongMajor = -eyeX * minorY + eyeY * minorX;
    distance2 = alongMinor * alongMinor + alongMajor * alongMajor;
  }
  const double radius2 = pixel.Radius * pixel.Radius;
  nearDecision |= IsClose(distance2, radius2);
  return distance2 <= radius2;
}

//------------------------------------------------------------------------------
// Of all attributes, with the weights brought to a sum of 1, for a pixel with its centre at
// `center`. The fallback gives the source, and the normal if the contributors' cancel out.
Pixel PullPushReference::Average(
  const std::vector<Contributor>& contributors, const Contributor& fallback, const Vector2& center)
{
  double sum = 0.0;
  for (const Contributor& contributor : contributors)
  {
    sum += contributor.Weight;
  }
  Pixel result;
  result.Valid = true;
  result.Source = fallback.Source->Source;
  for (const Contributor& contributor : contributors)
  {
    const Pixel& pixel = *contributor.Source;
    const double weight = contributor.Weight / sum;
    result.Radius += weight * pixel.Radius;
    result.MinimumDepth += weight * pixel.MinimumDepth;
    result.MaximumDepth += weight * pixel.MaximumDepth;
    result.NearDecision |= pixel.NearDecision;
    for (int i = 0; i < 2; ++i)
    {
      result.Displacement[i] +=
        weight * (contributor.Center[i] + pixel.Displacement[i] - center[i]);
    }
    for (int i = 0; i < 3; ++i)
    {
      result.Normal[i] += weight * pixel.Normal[i];
    }
    for (int i = 0; i < 4; ++i)
    {
      result.Color[i] += weight * pixel.Color[i];
    }
  }

  const double length = Length(result.Normal);
  result.NearDecision |= std::abs(length - SHORTEST_NORMAL_SUM) <= CLOSE;
  if (length < SHORTEST_NORMAL_SUM)
  {
    result.Normal = fallback.Source->Normal;
    return result;
  }
  for (double& component : result.Normal)
  {
    component /= length;
  }
  return result;
}
