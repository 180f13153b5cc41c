// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPullPushReconstructionCPU.h"

#include "vtkPointSurfaceVectorize.h"
#include "vtkPullPushParameters.h"
#include "vtkSurfacePixels.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>

// A block of pixels is worked on in three steps: gather the pixels that each one depends on into
// plain arrays, compute on all lanes at once, and store. The second step is the shader's text with
// choices in place of branches.

namespace
{
constexpr int BlockSize = vtkSurfaceImage::BlockSize;
constexpr int PairSize = 2 * BlockSize; // what a block of a coarser level covers
constexpr int ShapePlanes = vtkSurfaceImage::NumberOfShapePlanes;
constexpr float Infinite = 3.4e38f;

/// A pixel of a pyramid; see vtkPullPushCommon.glsl.
struct Pixel
{
  float NormalX, NormalY, NormalZ, Radius, DepthX, DepthY, CenterX, CenterY;
};

struct Range
{
  float Nearest, Farthest;
};

/// `N` pixels, a plane after the other.
template <int N>
struct Pixels
{
  alignas(64) float Planes[ShapePlanes][N];

  VTK_POINT_SURFACE_INLINE Pixel Get(int i) const
  {
    const auto& p = this->Planes;
    return { p[0][i], p[1][i], p[2][i], p[3][i], p[4][i], p[5][i], p[6][i], p[7][i] };
  }
  VTK_POINT_SURFACE_INLINE void Set(int i, const Pixel& pixel)
  {
    auto& p = this->Planes;
    p[0][i] = pixel.NormalX;
    p[1][i] = pixel.NormalY;
    p[2][i] = pixel.NormalZ;
    p[3][i] = pixel.Radius;
    p[4][i] = pixel.DepthX;
    p[5][i] = pixel.DepthY;
    p[6][i] = pixel.CenterX;
    p[7][i] = pixel.CenterY;
  }
};

/// The planes of a row of an image from one pixel on.
struct Row
{
  float* First;
  size_t Stride;

  float* Plane(int plane) const { return this->First + plane * this->Stride; }
};

Row GetRow(vtkSurfaceImage& image, int y, int x)
{
  return { image.GetRow(y, 0) + x, image.GetPlaneStride() };
}

template <int N>
VTK_POINT_SURFACE_INLINE void Copy(const float* from, float* to)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < N; ++i)
  {
    to[i] = from[i];
  }
}

/// The parameters that a pixel needs, by value. Options are numbers to calculate with, since a
/// choice that is the same for all lanes keeps compilers from running them together.
struct Uniforms
{
  float PixelToEye[4];
  float EyeRay[4];
  float EyeRayStep[4];
  float Shear;
  float UnionShare;
  float FineSize;       // pixels of level 0 along a side of a fine pixel
  float OppositeSide;   // factor on normals that point to the other side: 1 leaves them
  float BackLimit;      // how far the front reaches over the back, a distance as in Hit
  float BackShare;      // of a back's weight where it is behind its front
  float HidesOwnBacks;  // 1: nor does a back stay in its own pixel there
  float DistanceWeight; // 1: weights fall with the distance
  float ConstantWeight; // 1: weights are those of the paper
  float OwnWeight;      // 1: a pixel that stays is averaged with the coarser ones
  float FrontEndMargin; // added to the end of the frontmost interval
  float OutlineSlack;
  float PixelReach; // from a fine pixel's centre to its corner, in eye units where w is 1
  int NumberOfClippingPlanes;
  float ClippingPlanes[6][4];

  Uniforms(const vtkPullPushParameters& p, int fineLevel)
    : Shear(p.Shear)
    , UnionShare(p.UnionShare)
    , FineSize(static_cast<float>(1 << fineLevel))
    , OppositeSide(p.TwoSided ? -1.0f : 1.0f)
    , BackLimit(p.TwoSided ? 4.0f : 1.0f)
    , BackShare(p.HidesBacks() ? 0.0f : 1.0f)
    , HidesOwnBacks(p.HidesBacks() && !p.BlendsPixels ? 1.0f : 0.0f)
    , DistanceWeight(p.Options.DistanceWeights ? 1.0f : 0.0f)
    , ConstantWeight(p.Options.DistanceWeights ? 0.0f : 1.0f)
    , OwnWeight(p.BlendsPixels && fineLevel == 0 ? 1.0f : 0.0f)
    , FrontEndMargin(p.Options.DepthTestInPush ? 0.0f : Infinite)
    , OutlineSlack(p.OutlineSlack)
    , PixelReach(0.71f * (this->FineSize - 1.0f) *
        std::hypot(
          std::abs(p.PixelToEye[0]) + std::abs(p.Shear * p.PixelToEye[1]), p.PixelToEye[1]))
    , NumberOfClippingPlanes(p.NumberOfClippingPlanes)
  {
    for (int i = 0; i < 6; ++i)
    {
      std::copy_n(p.ClippingPlanes[i].data(), 4, this->ClippingPlanes[i]);
    }
    std::copy(p.PixelToEye.begin(), p.PixelToEye.end(), this->PixelToEye);
    std::copy(p.EyeRay.begin(), p.EyeRay.end(), this->EyeRay);
    std::copy(p.EyeRayStep.begin(), p.EyeRayStep.end(), this->EyeRayStep);
  }
};

VTK_POINT_SURFACE_INLINE float Largest(float a, float b)
{
  return a > b ? a : b;
}

template <bool CenterDepths>
VTK_POINT_SURFACE_INLINE Range GetDepthRange(const Pixel& p)
{
  return CenterDepths ? Range{ p.DepthX - p.DepthY, p.DepthX + p.DepthY + p.Radius }
                      : Range{ p.DepthX, p.DepthY };
}

//------------------------------------------------------------------------------
// Pull

/// What becomes of four pixels of the finer level in one of the coarser one.
struct Pulled
{
  Pixels<BlockSize> Result;
  float Share[4][BlockSize]; // of each of the four in the colour
  int Front[BlockSize];      // the one that the id comes from
};

template <bool CenterDepths>
VTK_POINT_SURFACE_INLINE void PullPixels(
  const Pixels<BlockSize> (&fine)[4], const Uniforms& uniforms, Pulled& pulled)
{
  const Uniforms u = uniforms;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < BlockSize; ++i)
  {
    Pixel p[4];
    Range range[4];
    Pixel front = {};
    float nearest = Infinite;
    float frontEnd = -Infinite;
    int frontIndex = 0;
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      p[k] = fine[k].Get(i);
      range[k] = GetDepthRange<CenterDepths>(p[k]);
      p[k].CenterX += u.FineSize * ((k & 1) - 0.5f);
      p[k].CenterY += u.FineSize * ((k >> 1) - 0.5f);
      const bool isFront = (p[k].Radius > 0.0f) & (range[k].Nearest < nearest);
      nearest = isFront ? range[k].Nearest : nearest;
      frontEnd = isFront ? range[k].Farthest : frontEnd;
      front.NormalX = isFront ? p[k].NormalX : front.NormalX;
      front.NormalY = isFront ? p[k].NormalY : front.NormalY;
      front.NormalZ = isFront ? p[k].NormalZ : front.NormalZ;
      frontIndex = isFront ? k : frontIndex;
    }

    Pixel sum = {};
    float count = 0.0f;
    float farthest = frontEnd;
    float share[4];
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      // the preliminary depth test: only what overlaps the frontmost interval is averaged
      const bool kept = (p[k].Radius > 0.0f) & (range[k].Nearest <= frontEnd);
      share[k] = kept ? 1.0f : 0.0f;
      const float dot =
        p[k].NormalX * front.NormalX + p[k].NormalY * front.NormalY + p[k].NormalZ * front.NormalZ;
      const float side = share[k] * (dot < 0.0f ? u.OppositeSide : 1.0f);
      sum.NormalX += side * p[k].NormalX;
      sum.NormalY += side * p[k].NormalY;
      sum.NormalZ += side * p[k].NormalZ;
      sum.Radius += share[k] * p[k].Radius;
      sum.DepthX += share[k] * p[k].DepthX;
      sum.CenterX += share[k] * p[k].CenterX;
      sum.CenterY += share[k] * p[k].CenterY;
      count += share[k];
      farthest = kept ? Largest(farthest, range[k].Farthest) : farthest;
    }

    const float size =
      std::sqrt(sum.NormalX * sum.NormalX + sum.NormalY * sum.NormalY + sum.NormalZ * sum.NormalZ);
    const float inverseSize = 1.0f / Largest(size, 1e-6f);
    const float inverseCount = 1.0f / Largest(count, 1.0f);
    Pixel result;
    result.NormalX = size < 1e-6f ? front.NormalX : sum.NormalX * inverseSize;
    result.NormalY = size < 1e-6f ? front.NormalY : sum.NormalY * inverseSize;
    result.NormalZ = size < 1e-6f ? front.NormalZ : sum.NormalZ * inverseSize;
    result.Radius = sum.Radius * inverseCount;
    result.CenterX = sum.CenterX * inverseCount;
    result.CenterY = sum.CenterY * inverseCount;
    const bool valid = count > 0.0f;
    const float mean = sum.DepthX * inverseCount;
    result.DepthX = valid ? (CenterDepths ? mean : nearest) : 0.0f;
    result.DepthY = (valid & !CenterDepths) ? farthest : 0.0f;
    float unionRadius = 0.0f;
    const float w = u.PixelToEye[2] * result.DepthX + u.PixelToEye[3];
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      if (CenterDepths)
      {
        const float span = std::abs(p[k].DepthX - result.DepthX) + p[k].DepthY;
        result.DepthY = Largest(result.DepthY, share[k] * span);
      }
      const float y = (p[k].CenterY - result.CenterY) * u.PixelToEye[1] * w;
      const float x = (p[k].CenterX - result.CenterX) * u.PixelToEye[0] * w - u.Shear * y;
      const float reach = p[k].Radius + 0.5f * std::sqrt(x * x + y * y);
      unionRadius = Largest(unionRadius, share[k] * reach);
    }
    result.Radius += u.UnionShare * (unionRadius - result.Radius);
    pulled.Result.Set(i, result);
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      pulled.Share[k][i] = share[k] * inverseCount;
    }
    pulled.Front[i] = frontIndex;
  }
}

/// Every other one of a row's values.
VTK_POINT_SURFACE_INLINE void GatherChildren(const float* row, float* even, float* odd)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < BlockSize; ++i)
  {
    even[i] = row[2 * i];
    odd[i] = row[2 * i + 1];
  }
}

VTK_POINT_SURFACE_CLONES
void PullBlock(const Row (&fine)[2], const Row& coarse, int planes, bool centerDepths,
  const Uniforms& uniforms, Pulled& pulled)
{
  Pixels<BlockSize> children[4];
  for (int k = 0; k < ShapePlanes; ++k)
  {
    for (int row = 0; row < 2; ++row)
    {
      GatherChildren(
        fine[row].Plane(k), children[2 * row].Planes[k], children[2 * row + 1].Planes[k]);
    }
  }
  centerDepths ? PullPixels<true>(children, uniforms, pulled)
               : PullPixels<false>(children, uniforms, pulled);
  for (int k = 0; k < ShapePlanes; ++k)
  {
    Copy<BlockSize>(pulled.Result.Planes[k], coarse.Plane(k));
  }
  for (int k = ShapePlanes; k < planes; ++k)
  {
    const float* row0 = fine[0].Plane(k);
    const float* row1 = fine[1].Plane(k);
    float* color = coarse.Plane(k);
    VTK_POINT_SURFACE_INDEPENDENT
    for (int i = 0; i < BlockSize; ++i)
    {
      color[i] = pulled.Share[0][i] * row0[2 * i] + pulled.Share[1][i] * row0[2 * i + 1] +
        pulled.Share[2][i] * row1[2 * i] + pulled.Share[3][i] * row1[2 * i + 1];
    }
  }
}

//------------------------------------------------------------------------------
// Push

/// Where a ray meets a disc: the square of the distance from the centre, 1 at the edge; the depth.
struct Hit
{
  float Distance, Depth;
};

/// The orthogonal projection of a disc, as published. `p`'s centre is relative to the pixel.
VTK_POINT_SURFACE_INLINE Hit HitEllipse(const Pixel& p, const Uniforms& u)
{
  const float w = (u.PixelToEye[2] * p.DepthX + u.PixelToEye[3]) / p.Radius;
  const float y = p.CenterY * u.PixelToEye[1] * w;
  const float x = p.CenterX * u.PixelToEye[0] * w - u.Shear * y;
  // along and across the minor axis, both times the slope
  const float along = x * p.NormalX + y * p.NormalY;
  const float across = y * p.NormalX - x * p.NormalY;
  const float slope2 = p.NormalX * p.NormalX + p.NormalY * p.NormalY;
  const float squeeze = Largest(std::abs(p.NormalZ), 1e-3f);
  const float squeeze2 = squeeze * squeeze;
  const bool flat = slope2 < 1e-12f;
  const float numerator = flat ? x * x + y * y : along * along + across * across * squeeze2;
  const float denominator = flat ? 1.0f : slope2 * squeeze2;
  return { numerator / denominator, p.DepthX };
}

/// The disc itself, in perspective. `ray` is the direction through the pixel.
VTK_POINT_SURFACE_INLINE Hit HitDisc(const Pixel& p, const Uniforms& u, const float (&ray)[2])
{
  // the centre from where the ray is at the centre's depth
  const float y = p.CenterY * (u.EyeRayStep[3] + p.DepthX * u.EyeRayStep[1]);
  const float x = p.CenterX * (u.EyeRayStep[2] + p.DepthX * u.EyeRayStep[0]) - u.Shear * y;
  const float slope = p.NormalX * ray[0] + p.NormalY * ray[1] - p.NormalZ;
  const bool grazes = std::abs(slope) < 1e-3f;
  const float deeper = (p.NormalX * x + p.NormalY * y) / (grazes ? 1.0f : slope);
  const float offsetX = (deeper * ray[0] - x) / p.Radius;
  const float offsetY = (deeper * ray[1] - y) / p.Radius;
  const float offsetZ = deeper / p.Radius;
  const float distance = offsetX * offsetX + offsetY * offsetY + offsetZ * offsetZ;
  return { grazes ? 4.0f : distance, grazes ? p.DepthX : p.DepthX + deeper };
}

template <bool CenterDepths>
VTK_POINT_SURFACE_INLINE Hit GetHit(const Pixel& p, const Uniforms& u, const float (&ray)[2])
{
  return CenterDepths ? HitDisc(p, u, ray) : HitEllipse(p, u);
}

/// The weight of a disc that covers a pixel; `constant` is the paper's.
VTK_POINT_SURFACE_INLINE float GetWeight(const Uniforms& u, float distance, float constant)
{
  return u.DistanceWeight * Largest(1.0f - distance, 1e-6f) * (1.0f + constant) +
    u.ConstantWeight * constant;
}

/// Whether a point's disc covers the centre of its own pixel, but for the slack.
template <bool CenterDepths>
VTK_POINT_SURFACE_INLINE bool CoversOwnPixel(
  const Pixel& p, const Uniforms& u, const float (&ray)[2])
{
  const float size = std::sqrt(p.CenterX * p.CenterX + p.CenterY * p.CenterY);
  const float share = Largest(size - u.OutlineSlack, 0.0f);
  return GetHit<CenterDepths>(p, u, ray).Distance * share * share <= size * size;
}

VTK_POINT_SURFACE_INLINE bool FacesAway(const Pixel& p, const float (&ray)[2])
{
  return p.NormalX * ray[0] + p.NormalY * ray[1] - p.NormalZ > 0.0f;
}

/// Whether a disc is the back of a surface and behind its front. What points nearly opposite to the
/// front is rather of the same side, with a normal that was turned.
VTK_POINT_SURFACE_INLINE bool IsBackOf(const Pixel& front, const Pixel& p, const float (&ray)[2])
{
  const float alike =
    p.NormalX * front.NormalX + p.NormalY * front.NormalY + p.NormalZ * front.NormalZ;
  return FacesAway(p, ray) & (p.DepthX >= front.DepthX) & (alike > -0.6f);
}

/// 1 where a part of the fine pixel, at a depth, is on the kept side of all planes, else 0: there a
/// disc hides nothing.
VTK_POINT_SURFACE_INLINE float IsKept(
  const Uniforms& u, const float (&ray)[2], const float (&origin)[2], float depth)
{
  const float x = origin[0] + depth * ray[0];
  const float y = origin[1] + depth * ray[1];
  const float reach = u.PixelReach * (u.PixelToEye[2] * depth + u.PixelToEye[3]);
  float kept = 1.0f;
  for (int i = 0; i < u.NumberOfClippingPlanes; ++i)
  {
    const float(&plane)[4] = u.ClippingPlanes[i];
    const float distance = plane[0] * x + plane[1] * y - plane[2] * depth + plane[3];
    kept = distance < -reach ? 0.0f : kept;
  }
  return kept;
}

/// What becomes of the pixels of a row of the finer level.
struct Pushed
{
  Pixels<PairSize> Result;
  float Share[4][PairSize]; // of each of the four coarse pixels
  float OwnShare[PairSize]; // of the fine pixel
  int Main[PairSize];       // the one that the id comes from; -1 where the fine pixel stays
  float Depth[PairSize];    // of the surface at the pixel's own centre
};

/// `x` and `y` are of the first pixel.
template <bool CenterDepths, bool Clips, bool Trims>
VTK_POINT_SURFACE_INLINE void PushPixels(const Pixels<PairSize>& fine,
  const Pixels<PairSize> (&coarse)[4], const Uniforms& uniforms, int x, int y, Pushed& pushed)
{
  const Uniforms u = uniforms;
  const float rayY = u.EyeRay[1] + (static_cast<float>(y) + 0.5f) * u.FineSize * u.EyeRayStep[1];
  const float originY = u.EyeRay[3] + (static_cast<float>(y) + 0.5f) * u.FineSize * u.EyeRayStep[3];
  const float firstRayX = u.EyeRay[0] - u.Shear * rayY;
  const float firstOriginX = u.EyeRay[2] - u.Shear * originY;
  // from the fine pixel's centre to those of its parent and of the parent's neighbour
  const float sideY = y & 1 ? -u.FineSize : u.FineSize;
  const float firstX = static_cast<float>(x);
  float sideX[PairSize];
  float column[PairSize];
  for (int i = 0; i < PairSize; ++i)
  {
    sideX[i] = i & 1 ? -u.FineSize : u.FineSize;
    column[i] = firstX + i;
  }
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < PairSize; ++i)
  {
    const float ray[2] = { firstRayX + (column[i] + 0.5f) * u.FineSize * u.EyeRayStep[0], rayY };
    const float origin[2] = { firstOriginX + (column[i] + 0.5f) * u.FineSize * u.EyeRayStep[2],
      originY };
    const Pixel own = fine.Get(i);
    const Range ownRange = GetDepthRange<CenterDepths>(own);
    const Range parent = GetDepthRange<CenterDepths>(coarse[0].Get(i));
    const bool valid = own.Radius > 0.0f;
    const bool covered = valid & (!Trims || CoversOwnPixel<CenterDepths>(own, u, ray));
    const bool isInFront =
      covered & (ownRange.Nearest >= parent.Nearest) & (ownRange.Nearest <= parent.Farthest);
    // The back of a surface seen through a gap in its front: let the front reach twice as far.
    const bool isBack = valid & FacesAway(own, ray);

    Pixel p[4];
    Range range[4];
    float weight[4];
    float nearness[4]; // to the centre; the id is that of the nearest one
    float front = Infinite;
    float frontEnd = Infinite;
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      p[k] = coarse[k].Get(i);
      range[k] = GetDepthRange<CenterDepths>(p[k]);
      p[k].CenterX += sideX[i] * (k & 1 ? -1.5f : 0.5f);
      p[k].CenterY += sideY * (k >> 1 ? -1.5f : 0.5f);
      const Hit hit = GetHit<CenterDepths>(p[k], u, ray);
      const float distance = hit.Distance;
      const float limit = (isBack & !FacesAway(p[k], ray)) ? u.BackLimit : 1.0f;
      const float kept = Clips ? IsKept(u, ray, origin, hit.Depth) : 1.0f;
      const bool covers = (kept * p[k].Radius > 0.0f) & (distance <= limit);
      // biquadratic B-spline subdivision: 9, 3, 3, 1 of 16
      const float constant = (k & 1 ? 0.25f : 0.75f) * (k >> 1 ? 0.25f : 0.75f);
      weight[k] = covers ? GetWeight(u, distance, constant) : 0.0f;
      nearness[k] =
        u.DistanceWeight * Largest(1.0f - distance, 1e-6f) + u.ConstantWeight * constant;
      const bool isFront = covers & (range[k].Nearest < front);
      // an interval is one radius long; a slanted surface runs through two from pixel to pixel
      frontEnd = isFront ? 2.0f * range[k].Farthest - range[k].Nearest : frontEnd;
      front = isFront ? range[k].Nearest : front;
    }

    Pixel facing = {};
    facing.DepthX = Infinite;
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      const bool isNearer =
        (weight[k] > 0.0f) & !FacesAway(p[k], ray) & (p[k].DepthX < facing.DepthX);
      facing.NormalX = isNearer ? p[k].NormalX : facing.NormalX;
      facing.NormalY = isNearer ? p[k].NormalY : facing.NormalY;
      facing.NormalZ = isNearer ? p[k].NormalZ : facing.NormalZ;
      facing.DepthX = isNearer ? p[k].DepthX : facing.DepthX;
    }
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      weight[k] *= IsBackOf(facing, p[k], ray) ? u.BackShare : 1.0f;
    }
    const bool keep = isInFront & !(valid & IsBackOf(facing, own, ray) & (u.HidesOwnBacks > 0.0f));

    // a pixel that stays, a back alone, for the fill to find, others with what is at their depth
    const float ownDistance = GetHit<CenterDepths>(own, u, ray).Distance;
    const bool alone = isBack & (u.OppositeSide < 0.0f);
    const float ownWeight = (keep & !alone) ? u.OwnWeight * GetWeight(u, ownDistance, 1.0f) : 0.0f;
    const float ownEnd = 2.0f * ownRange.Farthest - ownRange.Nearest;
    Pixel main = {};
    main.NormalX = keep ? own.NormalX : 0.0f;
    main.NormalY = keep ? own.NormalY : 0.0f;
    main.NormalZ = keep ? own.NormalZ : 0.0f;
    Pixel sum = {};
    sum.NormalX = keep ? ownWeight * own.NormalX : 0.0f;
    sum.NormalY = keep ? ownWeight * own.NormalY : 0.0f;
    sum.NormalZ = keep ? ownWeight * own.NormalZ : 0.0f;
    sum.Radius = keep ? ownWeight * own.Radius : 0.0f;
    sum.DepthX = keep ? ownWeight * own.DepthX : 0.0f;
    sum.DepthY = keep ? ownWeight * own.DepthY : 0.0f;
    sum.CenterX = keep ? ownWeight * own.CenterX : 0.0f;
    sum.CenterY = keep ? ownWeight * own.CenterY : 0.0f;
    float weights = ownWeight;
    float mainNearness = 0.0f;
    int mainIndex = -1;
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      const bool apart = (range[k].Nearest > ownEnd) | (range[k].Farthest < ownRange.Nearest);
      const bool behind = range[k].Nearest > frontEnd + u.FrontEndMargin;
      const bool dropped = keep ? (apart | !(ownWeight > 0.0f)) : behind;
      const float w = dropped ? 0.0f : weight[k];
      const float dot =
        p[k].NormalX * main.NormalX + p[k].NormalY * main.NormalY + p[k].NormalZ * main.NormalZ;
      const float side = dot < 0.0f ? u.OppositeSide : 1.0f;
      const float normalX = side * p[k].NormalX;
      const float normalY = side * p[k].NormalY;
      const float normalZ = side * p[k].NormalZ;
      sum.NormalX += w * normalX;
      sum.NormalY += w * normalY;
      sum.NormalZ += w * normalZ;
      sum.Radius += w * p[k].Radius;
      sum.DepthX += w * p[k].DepthX;
      sum.DepthY += w * p[k].DepthY;
      sum.CenterX += w * p[k].CenterX;
      sum.CenterY += w * p[k].CenterY;
      weights += w;
      const bool isMain = !keep & (w > 0.0f) & (nearness[k] > mainNearness);
      main.NormalX = isMain ? normalX : main.NormalX;
      main.NormalY = isMain ? normalY : main.NormalY;
      main.NormalZ = isMain ? normalZ : main.NormalZ;
      mainIndex = isMain ? k : mainIndex;
      mainNearness = isMain ? nearness[k] : mainNearness;
      weight[k] = w;
    }

    // where nothing else covers the pixel, an occluded one is seen after all
    const bool replaced = weights > 0.0f;
    const float inverse = replaced ? 1.0f / weights : 0.0f;
    const float size =
      std::sqrt(sum.NormalX * sum.NormalX + sum.NormalY * sum.NormalY + sum.NormalZ * sum.NormalZ);
    const bool cancels = size < 1e-6f;
    const float inverseSize = 1.0f / Largest(size, 1e-6f);
    const float normalX = cancels ? main.NormalX : sum.NormalX * inverseSize;
    const float normalY = cancels ? main.NormalY : sum.NormalY * inverseSize;
    const float normalZ = cancels ? main.NormalZ : sum.NormalZ * inverseSize;
    Pixel result;
    result.NormalX = replaced ? normalX : own.NormalX;
    result.NormalY = replaced ? normalY : own.NormalY;
    result.NormalZ = replaced ? normalZ : own.NormalZ;
    result.Radius = replaced ? sum.Radius * inverse : covered ? own.Radius : 0.0f;
    result.DepthX = replaced ? sum.DepthX * inverse : own.DepthX;
    result.DepthY = replaced ? sum.DepthY * inverse : own.DepthY;
    result.CenterX = replaced ? sum.CenterX * inverse : own.CenterX;
    result.CenterY = replaced ? sum.CenterY * inverse : own.CenterY;
    pushed.Result.Set(i, result);
    VTK_POINT_SURFACE_UNROLL
    for (int k = 0; k < 4; ++k)
    {
      pushed.Share[k][i] = weight[k] * inverse;
    }
    pushed.OwnShare[i] = replaced ? ownWeight * inverse : 1.0f;
    pushed.Main[i] = mainIndex;
  }
}

/// The depth of the surface at the pixels' own centres.
VTK_POINT_SURFACE_INLINE void FindSurfaceDepths(
  const Uniforms& uniforms, int x, int y, Pushed& pushed)
{
  const Uniforms u = uniforms;
  const float rayY = u.EyeRay[1] + (static_cast<float>(y) + 0.5f) * u.FineSize * u.EyeRayStep[1];
  const float firstRayX = u.EyeRay[0] - u.Shear * rayY;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < PairSize; ++i)
  {
    const float ray[2] = {
      firstRayX + (static_cast<float>(x + i) + 0.5f) * u.FineSize * u.EyeRayStep[0], rayY
    };
    const Pixel p = pushed.Result.Get(i);
    const Hit hit = HitDisc(p, u, ray);
    pushed.Depth[i] = hit.Distance > 1.5f ? p.DepthX : hit.Depth;
  }
}

/// The parents of the pixels of a row, and the parents' neighbours on the pixels' side.
VTK_POINT_SURFACE_INLINE void GatherParents(const float* row, float* parents, float* neighbors)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < BlockSize; ++i)
  {
    parents[2 * i] = row[i];
    parents[2 * i + 1] = row[i];
    neighbors[2 * i] = row[i - 1];
    neighbors[2 * i + 1] = row[i + 1];
  }
}

/// Whether all pixels of a row are valid, covered and not occluded, and no backs. `x` and `y` are
/// of the first.
template <bool CenterDepths, bool Trims>
VTK_POINT_SURFACE_INLINE bool AllStay(const Pixels<PairSize>& fine, const Pixels<PairSize>& parents,
  const Uniforms& uniforms, int x, int y)
{
  const Uniforms u = uniforms;
  const float rayY = u.EyeRay[1] + (static_cast<float>(y) + 0.5f) * u.FineSize * u.EyeRayStep[1];
  const float firstRayX = u.EyeRay[0] - u.Shear * rayY;
  int leaving = 0;
  for (int i = 0; i < PairSize; ++i)
  {
    const Pixel own = fine.Get(i);
    const float nearest = GetDepthRange<CenterDepths>(own).Nearest;
    const Range parent = GetDepthRange<CenterDepths>(parents.Get(i));
    const float ray[2] = {
      firstRayX + (static_cast<float>(x + i) + 0.5f) * u.FineSize * u.EyeRayStep[0], rayY
    };
    const bool covered =
      (own.Radius > 0.0f) & (!Trims || CoversOwnPixel<CenterDepths>(own, u, ray));
    const bool mayBeHidden = FacesAway(own, ray) & (u.HidesOwnBacks > 0.0f);
    const bool stays =
      covered & (nearest >= parent.Nearest) & (nearest <= parent.Farthest) & !mayBeHidden;
    leaving += stays ? 0 : 1;
  }
  return leaving == 0;
}

/// `coarse` are the rows of the parent and of its neighbour. False if all pixels stay as they are.
template <bool CenterDepths, bool Trims>
VTK_POINT_SURFACE_INLINE bool PushRows(
  const Row& fine, const Row (&coarse)[2], const Uniforms& uniforms, int x, int y, Pushed& pushed)
{
  Pixels<PairSize> own;
  Pixels<PairSize> parents[4];
  for (int k = 0; k < ShapePlanes; ++k)
  {
    Copy<PairSize>(fine.Plane(k), own.Planes[k]);
    GatherParents(coarse[0].Plane(k), parents[0].Planes[k], parents[1].Planes[k]);
  }
  if (!(uniforms.OwnWeight > 0.0f) && AllStay<CenterDepths, Trims>(own, parents[0], uniforms, x, y))
  {
    pushed.Result = own;
    std::fill_n(pushed.OwnShare, PairSize, 1.0f);
    std::fill_n(pushed.Main, PairSize, -1);
    return false;
  }
  for (int k = 0; k < ShapePlanes; ++k)
  {
    GatherParents(coarse[1].Plane(k), parents[2].Planes[k], parents[3].Planes[k]);
  }
  uniforms.NumberOfClippingPlanes > 0
    ? PushPixels<CenterDepths, true, Trims>(own, parents, uniforms, x, y, pushed)
    : PushPixels<CenterDepths, false, Trims>(own, parents, uniforms, x, y, pushed);
  return true;
}

VTK_POINT_SURFACE_CLONES
bool PushBlock(const Row& fine, const Row (&coarse)[2], bool centerDepths, bool trims,
  const Uniforms& uniforms, int x, int y, Pushed& pushed)
{
  if (trims)
  {
    return centerDepths ? PushRows<true, true>(fine, coarse, uniforms, x, y, pushed)
                        : PushRows<false, true>(fine, coarse, uniforms, x, y, pushed);
  }
  return centerDepths ? PushRows<true, false>(fine, coarse, uniforms, x, y, pushed)
                      : PushRows<false, false>(fine, coarse, uniforms, x, y, pushed);
}

/// Colour plane `plane`, by the shares of the pixels.
VTK_POINT_SURFACE_CLONES
void PushColors(
  const Row& fine, const Row (&coarse)[2], int plane, const Pushed& pushed, float* result)
{
  float parents[4][PairSize];
  GatherParents(coarse[0].Plane(plane), parents[0], parents[1]);
  GatherParents(coarse[1].Plane(plane), parents[2], parents[3]);
  const float* own = fine.Plane(plane);
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < PairSize; ++i)
  {
    const float value = pushed.Share[0][i] * parents[0][i] + pushed.Share[1][i] * parents[1][i] +
      pushed.Share[2][i] * parents[2][i] + pushed.Share[3][i] * parents[3][i];
    const float share = pushed.OwnShare[i];
    const float old = share * own[i];
    result[i] = share == 1.0f ? own[i] : value + (share > 0.0f ? old : 0.0f);
  }
}

/// Four floats a pixel: normal and depth.
VTK_POINT_SURFACE_CLONES
void InterleaveSurface(
  const Uniforms& uniforms, bool centerDepths, int x, int y, Pushed& pushed, float* surface)
{
  if (centerDepths)
  {
    FindSurfaceDepths(uniforms, x, y, pushed);
  }
  else
  {
    std::copy_n(pushed.Result.Planes[vtkSurfaceImage::IntervalX], PairSize, pushed.Depth);
  }
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < PairSize; ++i)
  {
    const float(&p)[ShapePlanes][PairSize] = pushed.Result.Planes;
    const float nx = p[0][i];
    const float ny = p[1][i];
    const float nz = p[2][i];
    const float depth = pushed.Depth[i];
    const bool valid = p[3][i] > 0.0f;
    surface[4 * i] = valid ? nx : 0.0f;
    surface[4 * i + 1] = valid ? ny : 0.0f;
    surface[4 * i + 2] = valid ? nz : 0.0f;
    surface[4 * i + 3] = valid ? depth : 0.0f;
  }
}
}

//------------------------------------------------------------------------------
namespace
{
/// Calls `work` with each row of [begin, end), on several threads where there is enough to do.
template <typename Work>
void ForRows(int begin, int end, int blocks, const Work& work)
{
  constexpr int EnoughBlocks = 256;
  auto rows = [&](vtkIdType first, vtkIdType last)
  {
    for (int y = static_cast<int>(first); y < last; ++y)
    {
      work(y);
    }
  };
  const int grain = std::max(EnoughBlocks / std::max(blocks, 1), 1);
  if (end - begin <= grain)
  {
    rows(begin, end);
    return;
  }
  vtkSMPTools::For(begin, end, grain, rows);
}

/// Whether one of the blocks [begin, end) may hold a valid pixel.
bool AnyOccupied(const unsigned char* occupied, int begin, int end)
{
  return std::any_of(
    occupied + begin, occupied + end, [](unsigned char flag) { return flag != 0; });
}

bool AnyValid(const float* radii, int count)
{
  int valid = 0;
  for (int i = 0; i < count; ++i)
  {
    valid += radii[i] > 0.0f ? 1 : 0;
  }
  return valid > 0;
}
}

void vtkPullPushReconstructionCPU::Run(
  const vtkPullPushParameters& parameters, vtkSurfaceImage& projected, vtkSurfacePixels& surface)
{
  const auto& levels = parameters.Levels;
  const int coarsest = parameters.GetCoarsestLevel();
  while (static_cast<int>(this->Coarse.size()) < coarsest)
  {
    this->Coarse.emplace_back(new vtkSurfaceImage);
  }
  auto image = [&](int level) -> vtkSurfaceImage&
  { return level == 0 ? projected : *this->Coarse[level - 1]; };
  for (int level = 1; level <= coarsest; ++level)
  {
    image(level).Allocate(levels[level].Width, levels[level].Height, levels[level].Rectangle,
      projected.HasIds(), projected.HasColors());
    this->Pull(parameters, image(level - 1), image(level), level);
  }
  surface.Allocate(levels[0].Rectangle, projected.HasIds(), projected.HasColors());
  for (int level = coarsest - 1; level > 0; --level)
  {
    this->Push(parameters, image(level), image(level + 1), level);
  }
  this->Finish(parameters, projected, image(1), surface);
  if (parameters.Options.FillPixels)
  {
    this->Fill.Run(parameters, surface);
  }
}

//------------------------------------------------------------------------------
void vtkPullPushReconstructionCPU::Pull(const vtkPullPushParameters& parameters,
  vtkSurfaceImage& fine, vtkSurfaceImage& coarse, int level)
{
  const Uniforms uniforms(parameters, level - 1);
  const int begin = coarse.GetBlockBegin();
  const int end = coarse.GetBlockEnd();
  ForRows(coarse.GetRectangle()[1], coarse.GetRectangle()[3], end - begin,
    [&](int y)
    {
      Pulled pulled;
      for (int block = begin; block < end; ++block)
      {
        if (!AnyOccupied(fine.GetOccupied(2 * y), 2 * block, 2 * block + 2) &&
          !AnyOccupied(fine.GetOccupied(2 * y + 1), 2 * block, 2 * block + 2))
        {
          coarse.ClearBlocks(y, block, block + 1);
          continue;
        }
        const int x = block * BlockSize;
        const Row rows[2] = { GetRow(fine, 2 * y, 2 * x), GetRow(fine, 2 * y + 1, 2 * x) };
        PullBlock(rows, GetRow(coarse, y, x), coarse.GetNumberOfPlanes(),
          parameters.Options.PerspectiveDiscs, uniforms, pulled);
        coarse.GetOccupied(y)[block] = 1;
        if (coarse.HasIds())
        {
          const unsigned int* ids[2] = { fine.GetIds(2 * y) + 2 * x,
            fine.GetIds(2 * y + 1) + 2 * x };
          for (int i = 0; i < BlockSize; ++i)
          {
            const int front = pulled.Front[i];
            coarse.GetIds(y)[x + i] = ids[front >> 1][2 * i + (front & 1)];
          }
        }
      }
    });
}

//------------------------------------------------------------------------------
namespace
{
/// A pair of blocks of a row of the finer level, and the coarse rows that it depends on.
struct PushSite
{
  PushSite(vtkSurfaceImage& fineImage, vtkSurfaceImage& coarseImage, int y, int block)
    : FineImage(fineImage)
    , CoarseImage(coarseImage)
    , X(block * PairSize)
    , Y(y)
    , CoarseX(block * BlockSize)
    , CoarseY{ y >> 1, (y >> 1) + (y & 1 ? 1 : -1) }
    , Fine(GetRow(fineImage, y, this->X))
    , Coarse{ GetRow(coarseImage, this->CoarseY[0], this->CoarseX),
      GetRow(coarseImage, this->CoarseY[1], this->CoarseX) }
  {
  }

  /// Whether there is anything to push: what is valid below has a valid parent.
  bool IsEmpty() const
  {
    const int block = this->CoarseX / BlockSize;
    return !AnyOccupied(this->CoarseImage.GetOccupied(this->CoarseY[0]), block - 1, block + 2) &&
      !AnyOccupied(this->CoarseImage.GetOccupied(this->CoarseY[1]), block - 1, block + 2);
  }

  unsigned int GetId(const Pushed& pushed, int i) const
  {
    const int main = pushed.Main[i];
    if (main < 0)
    {
      return this->FineImage.GetIds(this->Y)[this->X + i];
    }
    const int side = (main & 1) * (i & 1 ? 1 : -1);
    return this->CoarseImage.GetIds(this->CoarseY[main >> 1])[this->CoarseX + i / 2 + side];
  }

  vtkSurfaceImage& FineImage;
  vtkSurfaceImage& CoarseImage;
  int X, Y, CoarseX, CoarseY[2];
  Row Fine, Coarse[2];
};

/// Coarse blocks whose pairs hold the columns of a finer level.
int GetPairBegin(const vtkSurfaceImage& fine)
{
  return fine.GetRectangle()[0] / PairSize;
}

int GetPairEnd(const vtkSurfaceImage& fine)
{
  return (fine.GetRectangle()[2] + PairSize - 1) / PairSize;
}
}

void vtkPullPushReconstructionCPU::Push(const vtkPullPushParameters& parameters,
  vtkSurfaceImage& fine, vtkSurfaceImage& coarse, int level)
{
  const Uniforms uniforms(parameters, level);
  const bool centerDepths = parameters.Options.PerspectiveDiscs;
  const int begin = GetPairBegin(fine);
  const int end = GetPairEnd(fine);
  const auto& rectangle = fine.GetRectangle();
  ForRows(rectangle[1], rectangle[3], 4 * (end - begin),
    [&](int y)
    {
      Pushed pushed;
      for (int block = begin; block < end; ++block)
      {
        const PushSite site(fine, coarse, y, block);
        if (site.IsEmpty() ||
          !PushBlock(site.Fine, site.Coarse, centerDepths, false, uniforms, site.X, y, pushed))
        {
          continue;
        }
        for (int k = ShapePlanes; k < fine.GetNumberOfPlanes(); ++k)
        {
          float color[PairSize];
          PushColors(site.Fine, site.Coarse, k, pushed, color);
          std::copy_n(color, PairSize, site.Fine.Plane(k));
        }
        if (fine.HasIds())
        {
          for (int i = 0; i < PairSize; ++i)
          {
            fine.GetIds(y)[site.X + i] = site.GetId(pushed, i);
          }
        }
        for (int k = 0; k < ShapePlanes; ++k)
        {
          std::copy_n(pushed.Result.Planes[k], PairSize, site.Fine.Plane(k));
        }
        // the rectangle ends amid a block
        float* radii = fine.GetRow(y, vtkSurfaceImage::Radius);
        std::fill(radii + site.X, radii + std::max(site.X, rectangle[0]), 0.0f);
        std::fill(
          radii + std::min(site.X + PairSize, rectangle[2]), radii + site.X + PairSize, 0.0f);
        for (int half = 0; half < 2; ++half)
        {
          fine.GetOccupied(y)[2 * block + half] =
            AnyValid(radii + site.X + half * BlockSize, BlockSize);
        }
      }
    });
}

void vtkPullPushReconstructionCPU::Finish(const vtkPullPushParameters& parameters,
  vtkSurfaceImage& projected, vtkSurfaceImage& coarse, vtkSurfacePixels& surface)
{
  const Uniforms uniforms(parameters, 0);
  const bool centerDepths = parameters.Options.PerspectiveDiscs;
  const int begin = GetPairBegin(projected);
  const int end = GetPairEnd(projected);
  const auto& rectangle = projected.GetRectangle();
  ForRows(rectangle[1], rectangle[3], 4 * (end - begin),
    [&](int y)
    {
      Pushed pushed;
      alignas(64) float interleaved[4 * PairSize];
      for (int block = begin; block < end; ++block)
      {
        const PushSite site(projected, coarse, y, block);
        const int first = std::max(site.X, rectangle[0]);
        const int count = std::min(site.X + PairSize, rectangle[2]) - first;
        const size_t pixel = static_cast<size_t>(y - rectangle[1]) * (rectangle[2] - rectangle[0]) +
          first - rectangle[0];
        const int lane = first - site.X;
        if (site.IsEmpty())
        {
          std::fill_n(&surface.Surface[4 * pixel], 4 * count, 0.0f);
          if (!surface.Id.empty())
          {
            std::fill_n(&surface.Id[pixel], count, 0u);
          }
          if (!surface.Color.empty())
          {
            std::fill_n(&surface.Color[4 * pixel], 4 * count, 0.0f);
          }
          continue;
        }
        PushBlock(site.Fine, site.Coarse, centerDepths, parameters.Options.TrimOutlines, uniforms,
          site.X, y, pushed);
        InterleaveSurface(uniforms, centerDepths, site.X, y, pushed, interleaved);
        std::copy_n(interleaved + 4 * lane, 4 * count, &surface.Surface[4 * pixel]);
        const float* radii = pushed.Result.Planes[vtkSurfaceImage::Radius];
        for (int i = 0; !surface.Id.empty() && i < count; ++i)
        {
          surface.Id[pixel + i] = radii[lane + i] > 0.0f ? site.GetId(pushed, lane + i) : 0u;
        }
        for (int k = 0; !surface.Color.empty() && k < 4; ++k)
        {
          float color[PairSize];
          PushColors(site.Fine, site.Coarse, vtkSurfaceImage::Red + k, pushed, color);
          for (int i = 0; i < count; ++i)
          {
            surface.Color[4 * (pixel + i) + k] = radii[lane + i] > 0.0f ? color[lane + i] : 0.0f;
          }
        }
      }
    });
}
