// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceSplattingCPU.h"

#include "vtkPointSurfaceVectorize.h"
#include "vtkSurfacePixels.h"
#include "vtkSurfaceSplatParameters.h"

#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>

namespace
{
constexpr int TileSize = 32;

/// Pixels of a row that are worked on at once; a row of a tile goes on for as many.
constexpr int Lanes = 8;
constexpr int Stride = TileSize + Lanes;

/// Pixels of a part of the tile, along a side, that splats may be hidden in as a whole.
constexpr int PartSize = 8;
constexpr int Parts = TileSize / PartSize;

/// A tile has as many cells as a number has bits, row by row; and pixels of one, along a side.
constexpr int Cells = 8;
constexpr int CellSize = TileSize / Cells;
constexpr std::uint64_t AllCells = ~std::uint64_t(0);

/// Points are sorted by one thread a group, whatever the number of threads is.
constexpr size_t LargestNumberOfGroups = 32;

/// Splats that are fetched into the cache before they are worked on.
constexpr size_t ReadAhead = 6;
constexpr size_t WrittenAhead = 12;

constexpr float Far = 3e38f;

enum Side
{
  Front,
  Back
};
}

/// As long as a line of the cache, so that none is read from two of them.
struct alignas(64) vtkSurfaceSplattingCPU::Splat
{
  float X, Y;    // of the centre, in pixels from the rectangle's corner
  float A, B, C; // e = A dx^2 + B dx dy + C dy^2
  float Depth;   // of the centre
  float SlopeX, SlopeY;
  float Normal[3];
  float ReachX, ReachY; // of what is blended, in pixels
  float Tolerance;      // of depth
  float Nearest;        // least depth of what is blended
  unsigned int Tag;     // twice the id, and 1 where it is face-on
};
static_assert(sizeof(vtkSurfaceSplattingCPU::Splat) == 64, "a splat is as long as a line");

//------------------------------------------------------------------------------
namespace
{
/// The splats of a block of points, by their members.
struct Shapes
{
  static constexpr int Capacity = vtkPointProjectionCPU::EyePoints::Capacity;
  alignas(64) float X[Capacity], Y[Capacity];
  alignas(64) float A[Capacity], B[Capacity], C[Capacity];
  alignas(64) float Depth[Capacity], SlopeX[Capacity], SlopeY[Capacity];
  alignas(64) float ReachX[Capacity], ReachY[Capacity];
  alignas(64) float Tolerance[Capacity], Nearest[Capacity];
  alignas(64) float Facing[Capacity];
  alignas(64) int X0[Capacity], Y0[Capacity], X1[Capacity], Y1[Capacity]; // see Box
};

/// What they are made with, in single precision.
struct Lens
{
  float Rows[2][4]; // of the matrix from the eye to clip coordinates
  float W[4];
  float HalfSize[2];
  float Corner[2]; // of the rectangle
  float Last[2];   // column and row
  float PixelSize; // in eye units, times w
  float BlendRadius;
  float DepthTolerance;
  bool Parallel;
};

Lens MakeLens(const vtkSurfaceSplatParameters& parameters)
{
  const vtkPointSurfaceView& view = parameters.View;
  Lens lens;
  for (int i = 0; i < 4; ++i)
  {
    lens.Rows[0][i] = static_cast<float>(view.VCDC[4 * i]);
    lens.Rows[1][i] = static_cast<float>(view.VCDC[4 * i + 1]);
    lens.W[i] = static_cast<float>(view.VCDC[4 * i + 3]);
  }
  for (int k = 0; k < 2; ++k)
  {
    lens.HalfSize[k] = 0.5f * view.Size[k];
    lens.Corner[k] = static_cast<float>(view.Rectangle[k]);
    lens.Last[k] = view.Rectangle[2 + k] - 1.0f;
  }
  lens.PixelSize = parameters.GetPixelSize();
  lens.BlendRadius = static_cast<float>(parameters.Options.BlendRadius);
  lens.DepthTolerance = static_cast<float>(parameters.Options.DepthTolerance);
  lens.Parallel = view.IsParallel();
  return lens;
}

/// Of a row whose last pixel is given: the first pixel whose centre is not below a place, and the
/// last one whose centre is not above it. last + 1 and -1 for none, as for what is not a number.
VTK_POINT_SURFACE_INLINE int GetFirstPixel(float place, float last)
{
  const float low = place - 0.5f > 0.0f ? place - 0.5f : 0.0f;
  const float limited = low < last + 1.0f ? low : last + 1.0f;
  const int below = static_cast<int>(limited);
  return static_cast<float>(below) < limited ? below + 1 : below;
}

VTK_POINT_SURFACE_INLINE int GetLastPixel(float place, float last)
{
  const float high = place + 0.5f > 0.0f ? place + 0.5f : 0.0f;
  return static_cast<int>(high < last + 1.0f ? high : last + 1.0f) - 1;
}

VTK_POINT_SURFACE_CLONES
void MakeShapes(
  const vtkPointProjectionCPU::EyePoints& points, const Lens& givenLens, Shapes& shapes)
{
  using Parameters = vtkSurfaceSplatParameters;
  const Lens lens = givenLens; // that no write below can change
  const int count = points.Count;
  const float parallel = lens.Parallel ? 1.0f : 0.0f;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    const float x = points.X[i];
    const float y = points.Y[i];
    const float z = points.Z[i];
    const float nx = points.NormalX[i];
    const float ny = points.NormalY[i];
    const float nz = points.NormalZ[i];
    const float w = lens.W[0] * x + lens.W[1] * y + lens.W[2] * z + lens.W[3];
    const float ndcX =
      (lens.Rows[0][0] * x + lens.Rows[0][1] * y + lens.Rows[0][2] * z + lens.Rows[0][3]) / w;
    const float ndcY =
      (lens.Rows[1][0] * x + lens.Rows[1][1] * y + lens.Rows[1][2] * z + lens.Rows[1][3]) / w;

    const float distance = std::sqrt(x * x + y * y + z * z);
    // a choice by a number: by a truth value the loop would not run on all lanes
    const float cosine = -(x * nx + y * ny + z * nz) / distance;
    const float facing = parallel > 0.0f ? nz : cosine;
    const float tilt = std::sqrt(nx * nx + ny * ny);
    const float limit = Parameters::LargestShareOfDepth * -z / tilt; // infinite without a tilt
    const float given = points.Radius[i];
    const float limited = given < limit ? given : limit;
    const float radius = parallel > 0.0f ? given : limited;
    const float tolerance =
      lens.DepthTolerance * radius + Parameters::TolerancePixels * lens.PixelSize * w;
    // a step of the radius along an axis of the eye, in pixels
    const float ofX = radius * lens.HalfSize[0] / w;
    const float ofY = radius * lens.HalfSize[1] / w;
    const float xx = ofX * (lens.Rows[0][0] - ndcX * lens.W[0]);
    const float xy = ofX * (lens.Rows[0][1] - ndcX * lens.W[1]);
    const float xz = ofX * (lens.Rows[0][2] - ndcX * lens.W[2]);
    const float yx = ofY * (lens.Rows[1][0] - ndcY * lens.W[0]);
    const float yy = ofY * (lens.Rows[1][1] - ndcY * lens.W[1]);
    const float yz = ofY * (lens.Rows[1][2] - ndcY * lens.W[2]);
    const float xn = xx * nx + xy * ny + xz * nz;
    const float yn = yx * nx + yy * ny + yz * nz;
    const float v11 = xx * xx + xy * xy + xz * xz - xn * xn + Parameters::LowPassVariance;
    const float v12 = xx * yx + xy * yy + xz * yz - xn * yn;
    const float v22 = yx * yx + yy * yy + yz * yz - yn * yn + Parameters::LowPassVariance;
    const float inverse = 1.0f / (v11 * v22 - v12 * v12);
    // covariances of the place on the screen with the depth
    const float ofDepthX = radius * (nz * xn - xz);
    const float ofDepthY = radius * (nz * yn - yz);
    const float centerX = lens.HalfSize[0] * (ndcX + 1.0f) - lens.Corner[0];
    const float centerY = lens.HalfSize[1] * (ndcY + 1.0f) - lens.Corner[1];
    const float reachX = lens.BlendRadius * std::sqrt(v11);
    const float reachY = lens.BlendRadius * std::sqrt(v22);
    shapes.X[i] = centerX;
    shapes.Y[i] = centerY;
    shapes.X0[i] = GetFirstPixel(centerX - reachX, lens.Last[0]);
    shapes.Y0[i] = GetFirstPixel(centerY - reachY, lens.Last[1]);
    shapes.X1[i] = GetLastPixel(centerX + reachX, lens.Last[0]);
    shapes.Y1[i] = GetLastPixel(centerY + reachY, lens.Last[1]);
    shapes.A[i] = v22 * inverse;
    shapes.B[i] = -2.0f * v12 * inverse;
    shapes.C[i] = v11 * inverse;
    shapes.Depth[i] = -z;
    shapes.SlopeX[i] = (ofDepthX * v22 - ofDepthY * v12) * inverse;
    shapes.SlopeY[i] = (ofDepthY * v11 - ofDepthX * v12) * inverse;
    shapes.ReachX[i] = reachX;
    shapes.ReachY[i] = reachY;
    shapes.Tolerance[i] = tolerance;
    shapes.Nearest[i] = -z - lens.BlendRadius * radius;
    shapes.Facing[i] = facing;
  }
}
}

/// Makes the splats of a group of points; those of the front are sorted into the tiles.
class vtkSurfaceSplattingCPU::Maker
{
public:
  Maker(vtkSurfaceSplattingCPU* splatting, const vtkSurfaceSplatParameters& parameters,
    const vtkPointProjectionCPU::EyeBlocks& blocks, bool colors)
    : Splatting(splatting)
    , Blocks(blocks)
    , Colors(colors)
    , MyLens(MakeLens(parameters))
  {
  }

  void Make(int number) const
  {
    const size_t groups = this->Splatting->Groups.size();
    const size_t begin = this->Blocks.GetSize() * number / groups;
    const size_t end = this->Blocks.GetSize() * (number + 1) / groups;
    Group& group = this->Splatting->Groups[number];
    group.Clear();
    vtkPointProjectionCPU::EyePoints points;
    Shapes shapes;
    for (size_t block = begin; block < end; ++block)
    {
      this->Blocks.Fetch(block, points);
      MakeShapes(points, this->MyLens, shapes);
      this->Add(group, points, shapes);
    }
  }

private:
  void Add(Group& group, const vtkPointProjectionCPU::EyePoints& points, const Shapes& shapes) const
  {
    group.Reserve(points.Count);
    // listed for both sides, without a branch that half of the points would take
    Entry entries[2][Shapes::Capacity];
    int count[2] = { 0, 0 };
    for (int i = 0; i < points.Count; ++i)
    {
      const Box box = { shapes.X0[i], shapes.Y0[i], shapes.X1[i], shapes.Y1[i] };
      if (box.X0 > box.X1 || box.Y0 > box.Y1)
      {
        continue;
      }
      const auto place = static_cast<unsigned int>(group.NumberOfSplats++);
      VTK_POINT_SURFACE_FETCH_TO_WRITE(group.Splats.data() + place + WrittenAhead);
      Write(points, shapes, i, group.Splats[place]);
      if (this->Colors)
      {
        group.Colors.push_back(this->Blocks.GetColor(points.Place[i]));
      }
      const int isFront = shapes.Facing[i] >= 0.0f ? 1 : 0;
      entries[Front][count[Front]] = { box, shapes.Nearest[i], place };
      entries[Back][count[Back]] = { box, shapes.Nearest[i], place };
      count[Front] += isFront;
      count[Back] += 1 - isFront;
    }
    for (int i = 0; i < count[Front]; ++i)
    {
      this->Splatting->Sort(group.Tiles[Front], entries[Front][i]);
    }
    group.Backs.insert(group.Backs.end(), entries[Back], entries[Back] + count[Back]);
  }

  /// Member by member: a whole splat would be made elsewhere first, and be waited for.
  static void Write(
    const vtkPointProjectionCPU::EyePoints& points, const Shapes& shapes, int i, Splat& splat)
  {
    splat.X = shapes.X[i];
    splat.Y = shapes.Y[i];
    splat.A = shapes.A[i];
    splat.B = shapes.B[i];
    splat.C = shapes.C[i];
    splat.Depth = shapes.Depth[i];
    splat.SlopeX = shapes.SlopeX[i];
    splat.SlopeY = shapes.SlopeY[i];
    splat.Normal[0] = points.NormalX[i];
    splat.Normal[1] = points.NormalY[i];
    splat.Normal[2] = points.NormalZ[i];
    splat.ReachX = shapes.ReachX[i];
    splat.ReachY = shapes.ReachY[i];
    splat.Tolerance = shapes.Tolerance[i];
    splat.Nearest = shapes.Nearest[i];
    const bool isFaceOn = shapes.Facing[i] > vtkSurfaceSplatParameters::MarginCosine;
    splat.Tag = 2 * points.Id[i] + (isFaceOn ? 1 : 0);
  }

  vtkSurfaceSplattingCPU* Splatting;
  const vtkPointProjectionCPU::EyeBlocks& Blocks;
  bool Colors;
  Lens MyLens;
};

vtkSurfaceSplattingCPU::vtkSurfaceSplattingCPU() = default;
vtkSurfaceSplattingCPU::~vtkSurfaceSplattingCPU() = default;

void vtkSurfaceSplattingCPU::Group::Clear()
{
  this->NumberOfSplats = 0;
  this->Colors.clear();
  this->Backs.clear();
  for (auto& tiles : this->Tiles)
  {
    for (std::vector<unsigned int>& places : tiles)
    {
      places.clear();
    }
  }
}

/// Makes room for that many splats more; what was there is kept from frame to frame.
void vtkSurfaceSplattingCPU::Group::Reserve(int count)
{
  const size_t size = this->NumberOfSplats + count;
  if (size > this->Splats.size())
  {
    this->Splats.resize(std::max(size, 2 * this->Splats.size()));
  }
}

void vtkSurfaceSplattingCPU::MakeSplats(const vtkSurfaceSplatParameters& parameters,
  const std::vector<vtkPointProjectionCPU::Cloud>& clouds, bool colors)
{
  const vtkPointProjectionCPU::EyeBlocks blocks(
    clouds, static_cast<float>(parameters.Options.BlendRadius));
  const auto& r = parameters.View.Rectangle;
  this->Columns = (r[2] + TileSize - 1) / TileSize;
  this->Rows = (r[3] + TileSize - 1) / TileSize;
  const size_t tiles = static_cast<size_t>(this->Columns) * this->Rows;
  this->Groups.resize(std::min(std::max<size_t>(blocks.GetSize(), 1), LargestNumberOfGroups));
  for (Group& group : this->Groups)
  {
    group.Tiles[Front].resize(tiles);
    group.Tiles[Back].resize(tiles);
  }
  this->FrontDepths.resize(tiles * TileSize * Stride);
  this->Farthest.resize(tiles * Parts * Parts);
  const Maker maker(this, parameters, blocks, colors);
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Groups.size()), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType group = begin; group < end; ++group)
      {
        maker.Make(static_cast<int>(group));
      }
    });
}

void vtkSurfaceSplattingCPU::Sort(
  std::vector<std::vector<unsigned int>>& tiles, const Entry& entry) const
{
  const Box& box = entry.Pixels;
  for (int row = box.Y0 / TileSize; row <= box.Y1 / TileSize; ++row)
  {
    for (int column = box.X0 / TileSize; column <= box.X1 / TileSize; ++column)
    {
      tiles[static_cast<size_t>(row) * this->Columns + column].push_back(entry.Place);
    }
  }
}

namespace
{
/// The largest value of the parts of pixels that a box of pixels, the last ones included, reaches.
VTK_POINT_SURFACE_INLINE float GetLargest(
  const float* parts, int stride, int x0, int y0, int x1, int y1)
{
  const int left = x0 / PartSize;
  const int right = x1 / PartSize;
  const float* low = parts + static_cast<size_t>(y0 / PartSize) * stride;
  const float* high = parts + static_cast<size_t>(y1 / PartSize) * stride;
  // of all but large boxes these are all parts, with nothing to be guessed of loops
  const float below = low[left] > low[right] ? low[left] : low[right];
  const float above = high[left] > high[right] ? high[left] : high[right];
  float largest = below > above ? below : above;
  if (right - left > 1 || high - low > stride)
  {
    for (const float* row = low; row <= high; row += stride)
    {
      largest = std::max(largest, *std::max_element(row + left, row + right + 1));
    }
  }
  return largest;
}
}

/// Whether the front is before all that a splat of the back could be blended with.
bool vtkSurfaceSplattingCPU::IsHidden(const Entry& back) const
{
  const Box& box = back.Pixels;
  return back.Nearest >=
    GetLargest(this->Farthest.data(), this->Columns * Parts, box.X0, box.Y0, box.X1, box.Y1);
}

void vtkSurfaceSplattingCPU::SortBacks(Group& group) const
{
  for (const Entry& back : group.Backs)
  {
    if (!this->IsHidden(back))
    {
      this->Sort(group.Tiles[Back], back);
    }
  }
}

//------------------------------------------------------------------------------
namespace
{
/// Pixels of a tile. Depths are Far where there is nothing.
struct Planes
{
  alignas(64) float Visible[2][TileSize * Stride]; // depths, of a side
  alignas(64) float Margin[TileSize * Stride];     // depths of the front with margins, in gaps
  alignas(64) float Weight[TileSize * Stride];
  alignas(64) float Sum[4][TileSize * Stride]; // of normals and depths
  alignas(64) float Colors[4][TileSize * Stride];
  alignas(64) float Heaviest[TileSize * Stride];
  alignas(64) unsigned int Id[TileSize * Stride];
  float Farthest[2][Parts * Parts]; // of the visible depths of a part
};

/// The clipping planes, for the pixels of a tile at their depths.
struct Clipping
{
  Lens Eye;
  float Planes[6][4]; // in eye coordinates
  int NumberOfPlanes;
  float Left, Bottom; // of the tile, in pixels of the image

  explicit Clipping(const vtkSurfaceSplatParameters& parameters)
    : Eye(MakeLens(parameters))
    , NumberOfPlanes(parameters.View.NumberOfClippingPlanes)
    , Left(0.0f)
    , Bottom(0.0f)
  {
    for (int p = 0; p < this->NumberOfPlanes; ++p)
    {
      const auto& plane = parameters.View.ClippingPlanes[p];
      std::transform(plane.begin(), plane.end(), this->Planes[p],
        [](double value) { return static_cast<float>(value); });
    }
  }

  void SetTile(const int corner[2])
  {
    this->Left = this->Eye.Corner[0] + corner[0];
    this->Bottom = this->Eye.Corner[1] + corner[1];
  }

  /// Far for pixels of a row, from (x, y) on, that are beyond a plane, else 0.
  VTK_POINT_SURFACE_INLINE void Cut(
    int x, int y, const float* depths, float added, float* beyond) const
  {
    const auto& rows = this->Eye.Rows;
    const float ndcY = (this->Bottom + y + 0.5f) / this->Eye.HalfSize[1] - 1.0f;
    for (int i = 0; i < Lanes; ++i)
    {
      const float z = -(depths[i] + added);
      const float w = this->Eye.W[2] * z + this->Eye.W[3];
      const float ndcX = (this->Left + (x + i) + 0.5f) / this->Eye.HalfSize[0] - 1.0f;
      const float eyeY = (ndcY * w - rows[1][2] * z - rows[1][3]) / rows[1][1];
      const float eyeX = (ndcX * w - rows[0][1] * eyeY - rows[0][2] * z - rows[0][3]) / rows[0][0];
      beyond[i] = 0.0f;
      for (int p = 0; p < this->NumberOfPlanes; ++p)
      {
        const float* plane = this->Planes[p];
        const float distance = plane[0] * eyeX + plane[1] * eyeY + plane[2] * z + plane[3];
        beyond[i] = distance < 0.0f ? Far : beyond[i];
      }
    }
  }
};

/// Fetches a splat that will be worked on some turns later.
VTK_POINT_SURFACE_INLINE void FetchAhead(const vtkSurfaceSplattingCPU::Splat* splats,
  const std::vector<unsigned int>& places, size_t turn, size_t count)
{
  const size_t next = turn + ReadAhead < count ? turn + ReadAhead : turn;
  VTK_POINT_SURFACE_FETCH_TO_READ(splats + places[next]);
}

/// The pixels of a tile that may lie in a splat, and the polynomials from its first one on.
struct Span
{
  int X0, X1, Y0, Y1;
  float Dx, Dy;
  bool IsEmpty() const { return this->X0 > this->X1 || this->Y0 > this->Y1; }
};

VTK_POINT_SURFACE_INLINE Span MakeSpan(
  const vtkSurfaceSplattingCPU::Splat& splat, const int corner[2], float share)
{
  const float x = splat.X - corner[0] - 0.5f;
  const float y = splat.Y - corner[1] - 0.5f;
  const float reachX = share * splat.ReachX;
  const float reachY = share * splat.ReachY;
  const float last = TileSize - 1.0f;
  Span span;
  span.X0 = static_cast<int>(std::ceil(std::max(x - reachX, 0.0f)));
  span.Y0 = static_cast<int>(std::ceil(std::max(y - reachY, 0.0f)));
  span.X1 = static_cast<int>(std::floor(std::min(x + reachX, last)));
  span.Y1 = static_cast<int>(std::floor(std::min(y + reachY, last)));
  span.Dx = span.X0 - x;
  span.Dy = span.Y0 - y;
  return span;
}

/// The farthest visible depth in the parts of the tile that a span reaches.
VTK_POINT_SURFACE_INLINE float GetFarthest(const float* parts, const Span& span)
{
  return GetLargest(parts, Parts, span.X0, span.Y0, span.X1, span.Y1);
}

/// The cells of the tile that a span reaches, a bit each.
VTK_POINT_SURFACE_INLINE std::uint64_t GetCells(const Span& span)
{
  constexpr std::uint64_t FirstColumn = 0x0101010101010101u;
  const int left = span.X0 / CellSize;
  const int right = span.X1 / CellSize;
  const int bottom = span.Y0 / CellSize;
  const int top = span.Y1 / CellSize;
  const std::uint64_t columns = (std::uint64_t(2) << right) - (std::uint64_t(1) << left);
  const std::uint64_t rows =
    (AllCells << (Cells * bottom)) & (AllCells >> (Cells * (Cells - 1 - top)));
  return columns * FirstColumn & rows;
}

/// The largest value in each of the parts of a row of parts, of `values` by column.
VTK_POINT_SURFACE_INLINE void FindLargest(const float* values, float* parts)
{
  for (int part = 0; part < Parts; ++part)
  {
    parts[part] = *std::max_element(values + part * PartSize, values + (part + 1) * PartSize);
  }
}

VTK_POINT_SURFACE_CLONES
void FindFarthest(const float* depths, float* parts)
{
  for (int row = 0; row < Parts; ++row)
  {
    float farthest[TileSize];
    std::fill_n(farthest, TileSize, -Far);
    for (int y = row * PartSize; y < (row + 1) * PartSize; ++y)
    {
      VTK_POINT_SURFACE_INDEPENDENT
      for (int x = 0; x < TileSize; ++x)
      {
        const float depth = depths[y * Stride + x];
        farthest[x] = depth > farthest[x] ? depth : farthest[x];
      }
    }
    FindLargest(farthest, parts + row * Parts);
  }
}

/// The least depths of the splats where e is below the limit, which those that are face-on have one
/// of their own for; those of the back with the tolerance added. Splats that reach none of the
/// cells that are wanted are left out.
VTK_POINT_SURFACE_CLONES
void FindDepths(const vtkSurfaceSplattingCPU::Splat* splats,
  const std::vector<unsigned int>& places, const int* corner, const Clipping& clipping, float share,
  float limitOfOthers, float limitFaceOn, bool back, std::uint64_t wanted, float* depths)
{
  const size_t count = places.size();
  for (size_t turn = 0; turn < count; ++turn)
  {
    const unsigned int place = places[turn];
    FetchAhead(splats, places, turn, count);
    const vtkSurfaceSplattingCPU::Splat splat = splats[place]; // that no write below can change
    const Span span = MakeSpan(splat, corner, share);
    const float added = back ? splat.Tolerance : 0.0f;
    const float limit = splat.Tag % 2 == 1 ? limitFaceOn : limitOfOthers;
    if (span.IsEmpty() || (GetCells(span) & wanted) == 0)
    {
      continue;
    }
    for (int x = span.X0; x <= span.X1; x += Lanes)
    {
      float quadratic[Lanes];
      float linear[Lanes];
      float start[Lanes];
      float beyond[Lanes] = {};
      VTK_POINT_SURFACE_LANES
      for (int i = 0; i < Lanes; ++i)
      {
        const float dx = span.Dx + static_cast<float>(x - span.X0 + i);
        quadratic[i] = splat.A * dx * dx;
        linear[i] = splat.B * dx;
        start[i] = splat.Depth + splat.SlopeX * dx;
      }
      for (int y = span.Y0; y <= span.Y1; ++y)
      {
        const float dy = span.Dy + static_cast<float>(y - span.Y0);
        float* row = depths + y * Stride + x;
        if (clipping.NumberOfPlanes > 0)
        {
          clipping.Cut(x, y, start, splat.SlopeY * dy, beyond);
        }
        VTK_POINT_SURFACE_LANES
        for (int i = 0; i < Lanes; ++i)
        {
          const float e = quadratic[i] + dy * (linear[i] + splat.C * dy) + beyond[i];
          const float d = start[i] + splat.SlopeY * dy;
          const float key = d + added;
          const float old = row[i];
          const float least = key < old ? key : old;
          row[i] = e < limit ? least : old;
        }
      }
    }
  }
}

/// Adds up what lies at the visible depths.
template <bool Ids, bool WithColors>
VTK_POINT_SURFACE_INLINE void BlendSplats(const vtkSurfaceSplattingCPU::Splat* splats,
  const std::array<float, 4>* colors, const std::vector<unsigned int>& places, const int* corner,
  const Clipping& clipping, float inverseBlend, bool back, Planes& planes)
{
  const float* visible = planes.Visible[back ? Back : Front];
  const float* farthest = planes.Farthest[back ? Back : Front];
  const size_t count = places.size();
  for (size_t turn = 0; turn < count; ++turn)
  {
    const unsigned int place = places[turn];
    FetchAhead(splats, places, turn, count);
    const vtkSurfaceSplattingCPU::Splat splat = splats[place]; // that no write below can change
    const Span span = MakeSpan(splat, corner, 1.0f);
    // as the visible depths of the back have it, so that the difference is the tolerance too
    const float added = back ? splat.Tolerance : 0.0f;
    if (span.IsEmpty() || splat.Nearest + added > GetFarthest(farthest, span) + splat.Tolerance)
    {
      continue;
    }
    const unsigned int id = splat.Tag / 2 + 1;
    for (int x = span.X0; x <= span.X1; x += Lanes)
    {
      float quadratic[Lanes];
      float linear[Lanes];
      float start[Lanes];
      float beyond[Lanes] = {};
      VTK_POINT_SURFACE_LANES
      for (int i = 0; i < Lanes; ++i)
      {
        const float dx = span.Dx + static_cast<float>(x - span.X0 + i);
        quadratic[i] = splat.A * dx * dx;
        linear[i] = splat.B * dx;
        start[i] = splat.Depth + splat.SlopeX * dx;
      }
      for (int y = span.Y0; y <= span.Y1; ++y)
      {
        const float dy = span.Dy + static_cast<float>(y - span.Y0);
        const int first = y * Stride + x;
        float weights[Lanes];
        if (clipping.NumberOfPlanes > 0)
        {
          clipping.Cut(x, y, start, splat.SlopeY * dy, beyond);
        }
        const float* deepest = visible + first;
        float* weight = planes.Weight + first;
        float* sumX = planes.Sum[0] + first;
        float* sumY = planes.Sum[1] + first;
        float* sumZ = planes.Sum[2] + first;
        float* sumDepth = planes.Sum[3] + first;
        VTK_POINT_SURFACE_LANES
        for (int i = 0; i < Lanes; ++i)
        {
          const float e = quadratic[i] + dy * (linear[i] + splat.C * dy) + beyond[i];
          const float d = start[i] + splat.SlopeY * dy;
          const float root = 1.0f - inverseBlend * e;
          const bool seen = (root > 0.0f) & (d + added <= deepest[i] + splat.Tolerance);
          const float square = root * root;
          const float own = seen ? square * square : 0.0f;
          weight[i] += own;
          sumX[i] += own * splat.Normal[0];
          sumY[i] += own * splat.Normal[1];
          sumZ[i] += own * splat.Normal[2];
          sumDepth[i] += own * d;
          weights[i] = own;
        }
        if (WithColors)
        {
          for (int k = 0; k < 4; ++k)
          {
            for (int i = 0; i < Lanes; ++i)
            {
              planes.Colors[k][first + i] += weights[i] * colors[place][k];
            }
          }
        }
        if (Ids)
        {
          for (int i = 0; i < Lanes; ++i)
          {
            const bool heavier = weights[i] > planes.Heaviest[first + i];
            planes.Heaviest[first + i] = heavier ? weights[i] : planes.Heaviest[first + i];
            planes.Id[first + i] = heavier ? id : planes.Id[first + i];
          }
        }
      }
    }
  }
}

VTK_POINT_SURFACE_CLONES
void BlendPlain(const vtkSurfaceSplattingCPU::Splat* splats, const std::array<float, 4>* colors,
  const std::vector<unsigned int>& places, const int* corner, const Clipping& clipping,
  float inverseBlend, bool back, Planes& planes)
{
  BlendSplats<false, false>(splats, colors, places, corner, clipping, inverseBlend, back, planes);
}

VTK_POINT_SURFACE_CLONES
void BlendColors(const vtkSurfaceSplattingCPU::Splat* splats, const std::array<float, 4>* colors,
  const std::vector<unsigned int>& places, const int* corner, const Clipping& clipping,
  float inverseBlend, bool back, Planes& planes)
{
  BlendSplats<false, true>(splats, colors, places, corner, clipping, inverseBlend, back, planes);
}

VTK_POINT_SURFACE_CLONES
void BlendIds(const vtkSurfaceSplattingCPU::Splat* splats, const std::array<float, 4>* colors,
  const std::vector<unsigned int>& places, const int* corner, const Clipping& clipping,
  float inverseBlend, bool back, Planes& planes)
{
  BlendSplats<true, false>(splats, colors, places, corner, clipping, inverseBlend, back, planes);
}

VTK_POINT_SURFACE_CLONES
void BlendBoth(const vtkSurfaceSplattingCPU::Splat* splats, const std::array<float, 4>* colors,
  const std::vector<unsigned int>& places, const int* corner, const Clipping& clipping,
  float inverseBlend, bool back, Planes& planes)
{
  BlendSplats<true, true>(splats, colors, places, corner, clipping, inverseBlend, back, planes);
}

/// Which cells of the tile have pixels where the back is seen, or nothing.
template <bool ShowingBack>
VTK_POINT_SURFACE_INLINE std::uint64_t FindGapsOf(const float* front, const float* back)
{
  std::uint64_t gaps = 0;
  for (int row = 0; row < Cells; ++row)
  {
    int found[TileSize] = {};
    for (int y = row * CellSize; y < (row + 1) * CellSize; ++y)
    {
      VTK_POINT_SURFACE_INDEPENDENT
      for (int x = 0; x < TileSize; ++x)
      {
        const float f = front[y * Stride + x];
        const float b = back[y * Stride + x];
        const bool isGap = ShowingBack ? b < f : (f >= Far) & (b >= Far);
        found[x] |= isGap ? 1 : 0;
      }
    }
    for (int column = 0; column < Cells; ++column)
    {
      int any = 0;
      for (int x = column * CellSize; x < (column + 1) * CellSize; ++x)
      {
        any |= found[x];
      }
      gaps |= static_cast<std::uint64_t>(any) << (Cells * row + column);
    }
  }
  return gaps;
}

VTK_POINT_SURFACE_CLONES
std::uint64_t FindGaps(bool showingBack, const float* front, const float* back)
{
  return showingBack ? FindGapsOf<true>(front, back) : FindGapsOf<false>(front, back);
}

/// A back before the front's discs, or nothing, is seen through a gap between them, if it is not
/// before their margins too.
VTK_POINT_SURFACE_CLONES
void CloseGaps(bool showingBack, float* front, const float* back, const float* margin)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < TileSize * Stride; ++i)
  {
    const float f = front[i];
    const float b = back[i];
    const float m = margin[i];
    const bool isGap = (b < f) == showingBack;
    const bool closes = (isGap & (m < b)) & (showingBack | (f >= Far));
    front[i] = closes ? m : f;
  }
}

/// The means of what was added up, of pixels of a row from the first one on: unit normals and
/// depths, and what colours are to be multiplied with.
VTK_POINT_SURFACE_CLONES
void FindMeans(const Planes& planes, int first, int count, float* surface, float* ofColors)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int x = 0; x < count; ++x)
  {
    const float nx = planes.Sum[0][first + x];
    const float ny = planes.Sum[1][first + x];
    const float nz = planes.Sum[2][first + x];
    const float weight = planes.Weight[first + x];
    const float length = std::sqrt(nx * nx + ny * ny + nz * nz);
    const float ofNormal = length > 0.0f ? 1.0f / length : 0.0f;
    const float ofWeight = weight > 0.0f ? 1.0f / weight : 0.0f;
    surface[4 * x] = ofNormal * nx;
    surface[4 * x + 1] = ofNormal * ny;
    surface[4 * x + 2] = ofNormal * nz;
    surface[4 * x + 3] = ofWeight * planes.Sum[3][first + x];
    ofColors[x] = ofWeight;
  }
}

/// Of the two sides the nearer one is visible; the other's depths become such that nothing is.
VTK_POINT_SURFACE_CLONES
void ChooseSides(float* front, float* back)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < TileSize * Stride; ++i)
  {
    const float f = front[i];
    const float b = back[i];
    const bool takesFront = (f <= b) & (f < Far);
    front[i] = takesFront ? f : -Far;
    back[i] = b < f ? b : -Far;
  }
}
}

/// One tile after the other, with room for the pixels of one.
class vtkSurfaceSplattingCPU::Tile
{
public:
  /// Finds the depths of the front, and how far they are in the parts of the tile.
  void FindFront(
    vtkSurfaceSplattingCPU* splatting, const vtkSurfaceSplatParameters& parameters, int tile)
  {
    float* depths = splatting->GetFrontDepths(tile);
    std::fill_n(depths, TileSize * Stride, Far);
    this->FindVisible(splatting, parameters, tile, Front, depths);
    float parts[Parts * Parts];
    FindFarthest(depths, parts);
    const int stride = splatting->Columns * Parts;
    float* to =
      &splatting->Farthest[static_cast<size_t>(tile / splatting->Columns) * Parts * stride +
        tile % splatting->Columns * Parts];
    for (int row = 0; row < Parts; ++row)
    {
      std::copy_n(parts + row * Parts, Parts, to + static_cast<size_t>(row) * stride);
    }
  }

  void Draw(vtkSurfaceSplattingCPU* splatting, const vtkSurfaceSplatParameters& parameters,
    int tile, vtkSurfacePixels& pixels)
  {
    const int corner[2] = { tile % splatting->Columns * TileSize,
      tile / splatting->Columns * TileSize };
    const bool empty[2] = { splatting->IsEmpty(tile, Front), splatting->IsEmpty(tile, Back) };
    if (empty[Front] && empty[Back])
    {
      this->WriteNothing(corner, pixels);
      return;
    }
    Planes& planes = this->MyPlanes;
    const auto blend = static_cast<float>(parameters.Options.BlendRadius);
    Clipping clipping(parameters);
    clipping.SetTile(corner);
    std::copy_n(splatting->GetFrontDepths(tile), TileSize * Stride, planes.Visible[Front]);
    std::fill_n(planes.Visible[Back], TileSize * Stride, Far);
    this->FindVisible(splatting, parameters, tile, Back, planes.Visible[Back]);
    for (bool showingBack : { true, false })
    {
      const std::uint64_t gaps = FindGaps(showingBack, planes.Visible[Front], planes.Visible[Back]);
      if (empty[Front] || gaps == 0)
      {
        continue;
      }
      std::fill_n(planes.Margin, TileSize * Stride, Far);
      for (const Group& group : splatting->Groups)
      {
        FindDepths(group.Splats.data(), group.Tiles[Front][tile], corner, clipping, 1.0f,
          showingBack ? blend * blend : vtkSurfaceSplatParameters::CoreLimit, blend * blend, false,
          gaps, planes.Margin);
      }
      CloseGaps(showingBack, planes.Visible[Front], planes.Visible[Back], planes.Margin);
    }
    ChooseSides(planes.Visible[Front], planes.Visible[Back]);

    const bool ids = !pixels.Id.empty();
    const bool colors = !pixels.Color.empty();
    this->Clear(ids, colors);
    const auto blendSplats =
      ids ? (colors ? BlendBoth : BlendIds) : (colors ? BlendColors : BlendPlain);
    for (int side : { Front, Back })
    {
      float* farthest = planes.Farthest[side];
      FindFarthest(planes.Visible[side], farthest);
      if (*std::max_element(farthest, farthest + Parts * Parts) == -Far)
      {
        continue; // none of this side is seen
      }
      for (const Group& group : splatting->Groups)
      {
        blendSplats(group.Splats.data(), group.Colors.data(), group.Tiles[side][tile], corner,
          clipping, 1.0f / (blend * blend), side == Back, planes);
      }
    }
    this->Write(corner, pixels);
  }

private:
  /// The least depths of what covers, of a side.
  static void FindVisible(vtkSurfaceSplattingCPU* splatting,
    const vtkSurfaceSplatParameters& parameters, int tile, int side, float* depths)
  {
    const int corner[2] = { tile % splatting->Columns * TileSize,
      tile / splatting->Columns * TileSize };
    Clipping clipping(parameters);
    clipping.SetTile(corner);
    const auto blend = static_cast<float>(parameters.Options.BlendRadius);
    const float share = std::sqrt(vtkSurfaceSplatParameters::CoreLimit) / blend;
    for (const Group& group : splatting->Groups)
    {
      FindDepths(group.Splats.data(), group.Tiles[side][tile], corner, clipping, share,
        vtkSurfaceSplatParameters::CoreLimit, vtkSurfaceSplatParameters::CoreLimit, side == Back,
        AllCells, depths);
    }
  }

  void Clear(bool ids, bool colors)
  {
    Planes& planes = this->MyPlanes;
    std::fill_n(planes.Weight, TileSize * Stride, 0.0f);
    std::fill_n(planes.Sum[0], 4 * TileSize * Stride, 0.0f);
    if (colors)
    {
      std::fill_n(planes.Colors[0], 4 * TileSize * Stride, 0.0f);
    }
    if (ids)
    {
      std::fill_n(planes.Heaviest, TileSize * Stride, 0.0f);
      std::fill_n(planes.Id, TileSize * Stride, 0u);
    }
  }

  static void WriteNothing(const int corner[2], vtkSurfacePixels& pixels)
  {
    const int width = pixels.Rectangle[2] - pixels.Rectangle[0];
    const int height = pixels.Rectangle[3] - pixels.Rectangle[1];
    const int columns = std::min(TileSize, width - corner[0]);
    for (int y = corner[1]; y < std::min(corner[1] + TileSize, height); ++y)
    {
      const size_t first = static_cast<size_t>(y) * width + corner[0];
      std::fill_n(&pixels.Surface[4 * first], 4 * columns, 0.0f);
      if (!pixels.Id.empty())
      {
        std::fill_n(&pixels.Id[first], columns, 0u);
      }
      if (!pixels.Color.empty())
      {
        std::fill_n(&pixels.Color[4 * first], 4 * columns, 0.0f);
      }
    }
  }

  void Write(const int corner[2], vtkSurfacePixels& pixels) const
  {
    const Planes& planes = this->MyPlanes;
    const int width = pixels.Rectangle[2] - pixels.Rectangle[0];
    const int height = pixels.Rectangle[3] - pixels.Rectangle[1];
    const int columns = std::min(TileSize, width - corner[0]);
    const int rows = std::min(TileSize, height - corner[1]);
    for (int y = 0; y < rows; ++y)
    {
      const int first = y * Stride;
      const size_t pixel = static_cast<size_t>(corner[1] + y) * width + corner[0];
      float ofColors[TileSize];
      FindMeans(planes, first, columns, &pixels.Surface[4 * pixel], ofColors);
      if (!pixels.Id.empty())
      {
        std::copy_n(planes.Id + first, columns, &pixels.Id[pixel]);
      }
      for (int x = 0; x < columns && !pixels.Color.empty(); ++x)
      {
        for (int k = 0; k < 4; ++k)
        {
          pixels.Color[4 * (pixel + x) + k] = ofColors[x] * planes.Colors[k][first + x];
        }
      }
    }
  }

  Planes MyPlanes;
};

bool vtkSurfaceSplattingCPU::IsEmpty(int tile, int side) const
{
  return std::all_of(this->Groups.begin(), this->Groups.end(),
    [&](const Group& group) { return group.Tiles[side][tile].empty(); });
}

float* vtkSurfaceSplattingCPU::GetFrontDepths(int tile)
{
  return &this->FrontDepths[static_cast<size_t>(tile) * TileSize * Stride];
}

void vtkSurfaceSplattingCPU::DrawSplats(
  const vtkSurfaceSplatParameters& parameters, bool ids, bool colors, vtkSurfacePixels& pixels)
{
  const auto& r = parameters.View.Rectangle;
  pixels.Allocate({ r[0], r[1], r[0] + r[2], r[1] + r[3] }, ids, colors);
  vtkSMPThreadLocal<std::shared_ptr<Tile>> tiles;
  const auto forAll = [&](int count, const std::function<void(Tile&, int)>& work)
  {
    vtkSMPTools::For(0, count, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        std::shared_ptr<Tile>& tile = tiles.Local();
        if (!tile)
        {
          tile = std::make_shared<Tile>();
        }
        for (vtkIdType i = begin; i < end; ++i)
        {
          work(*tile, static_cast<int>(i));
        }
      });
  };
  const int count = this->Columns * this->Rows;
  forAll(count, [&](Tile& tile, int i) { tile.FindFront(this, parameters, i); });
  forAll(static_cast<int>(this->Groups.size()),
    [&](Tile&, int group) { this->SortBacks(this->Groups[group]); });
  forAll(count, [&](Tile& tile, int i) { tile.Draw(this, parameters, i, pixels); });
}
