// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointProjectionCPU.h"

#include "vtkDrawablePoints.h"
#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceVectorize.h"
#include "vtkPointSurfaceView.h"
#include "vtkSurfaceImage.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

namespace
{
/// Points that are transformed together.
constexpr int BlockSize = 256;

/// Blocks that one thread finds the tiles of at a time.
constexpr vtkIdType ChunkBlocks = 32;

/// Pixels along the sides of a tile: one thread makes all of it, in memory that its cache holds.
constexpr int TileSize = 64;
constexpr int TilePixels = TileSize * TileSize;

/// No point: above every key of MakeKey().
constexpr std::uint64_t NoPoint = ~std::uint64_t(0);

/// A number that orders points by depth and, where depths are the same, by index.
std::uint64_t MakeKey(float depth, unsigned int index)
{
  std::uint32_t bits;
  std::memcpy(&bits, &depth, sizeof(bits));
  // floats of one sign are ordered as their bits are
  const std::uint32_t negative = 0u - (bits >> 31);
  bits ^= negative | 0x80000000u;
  return (std::uint64_t(bits) << 32) | index;
}

unsigned int GetIndex(std::uint64_t key)
{
  return static_cast<unsigned int>(key & 0xffffffffu);
}

/// Three coordinates of each of the points of a block.
struct Block
{
  alignas(64) float X[BlockSize], Y[BlockSize], Z[BlockSize];
};

template <typename T>
VTK_POINT_SURFACE_INLINE void LoadTuples(
  Block& block, int count, const T* tuples, const double* origin)
{
  const T o[3] = { static_cast<T>(origin[0]), static_cast<T>(origin[1]),
    static_cast<T>(origin[2]) };
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    block.X[i] = static_cast<float>(tuples[3 * i] - o[0]);
    block.Y[i] = static_cast<float>(tuples[3 * i + 1] - o[1]);
    block.Z[i] = static_cast<float>(tuples[3 * i + 2] - o[2]);
  }
}

VTK_POINT_SURFACE_CLONES
void LoadInOrder(Block& block, int count, const float* tuples, const double* origin)
{
  LoadTuples(block, count, tuples, origin);
}

VTK_POINT_SURFACE_CLONES
void LoadInOrder(Block& block, int count, const double* tuples, const double* origin)
{
  LoadTuples(block, count, tuples, origin);
}

void LoadInOrder(Block& block, int count, const float* tuples)
{
  const double zero[3] = { 0.0, 0.0, 0.0 };
  LoadInOrder(block, count, tuples, zero);
}

/// The tuples at the listed places.
void LoadListed(Block& block, int count, const float* tuples, const unsigned int* places)
{
  float listed[3 * BlockSize];
  for (int i = 0; i < count; ++i)
  {
    std::copy_n(tuples + 3 * static_cast<size_t>(places[i]), 3, listed + 3 * i);
  }
  LoadInOrder(block, count, listed);
}

/// The rows of a matrix of eye or clip coordinates, for column vectors.
struct Row
{
  float X, Y, Z, W;
  VTK_POINT_SURFACE_INLINE float Of(float x, float y, float z) const
  {
    return this->X * x + this->Y * y + this->Z * z + this->W;
  }
};
}

struct vtkPointProjectionCPU::Transform
{
  Row Eye[3];  // from coordinates about the origin to the eye
  Row Clip[4]; // from there to clip coordinates
  Row Normal[3];
  Row Planes[6]; // of clipping, in eye coordinates
  int NumberOfPlanes;
  float RadiusScale;
  float HalfSize[2]; // of the viewport
  int Cull;
  bool Parallel;
};

/// What the points of a block leave in their pixels.
struct vtkPointProjectionCPU::Footprints
{
  Block Positions; // in eye coordinates
  Block Normals;   // at first the cloud's, zero where none is known; then of unit length
  alignas(64) float Radii[BlockSize]; // at first the cloud's, then in eye coordinates
  alignas(64) int Columns[BlockSize], Rows[BlockSize];
  alignas(64) float CenterX[BlockSize], CenterY[BlockSize];
  // how far behind it points of its pixel are averaged with it
  alignas(64) float Reaches[BlockSize];
};

namespace
{
VTK_POINT_SURFACE_CLONES
void BringToEye(Block& block, int count, const vtkPointProjectionCPU::Transform& transform)
{
  const vtkPointProjectionCPU::Transform t = transform; // that no write below can change
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    const float x = t.Eye[0].Of(block.X[i], block.Y[i], block.Z[i]);
    const float y = t.Eye[1].Of(block.X[i], block.Y[i], block.Z[i]);
    const float z = t.Eye[2].Of(block.X[i], block.Y[i], block.Z[i]);
    block.X[i] = x;
    block.Y[i] = y;
    block.Z[i] = z;
  }
}

/// The unit normal of a point in eye coordinates, where (x, y, z) is the point; a normal that is
/// not known, zero, faces the viewer.
struct EyeNormal
{
  float X, Y, Z;
};

VTK_POINT_SURFACE_INLINE EyeNormal FindEyeNormal(const vtkPointProjectionCPU::Transform& t,
  const Block& normals, int i, float x, float y, float z, float distance)
{
  // towards the viewer is (0, 0, 1) in parallel, else minus the position
  const float parallel = t.Parallel ? 1.0f : 0.0f;
  const float perspective = t.Parallel ? 0.0f : -1.0f;
  const float nx = t.Normal[0].Of(normals.X[i], normals.Y[i], normals.Z[i]);
  const float ny = t.Normal[1].Of(normals.X[i], normals.Y[i], normals.Z[i]);
  const float nz = t.Normal[2].Of(normals.X[i], normals.Y[i], normals.Z[i]);
  const float length = std::sqrt(nx * nx + ny * ny + nz * nz);
  const bool known = length > 0.0f;
  const float ofNormal = known ? 1.0f / length : 0.0f;
  const float ofPosition = -perspective / distance; // no number at the eye, in parallel
  const float unknown = parallel > 0.0f ? 1.0f : ofPosition;
  const float ofViewer = known ? 0.0f : unknown;
  return { ofNormal * nx + ofViewer * perspective * x, ofNormal * ny + ofViewer * perspective * y,
    ofNormal * nz + ofViewer * (perspective * z + parallel) };
}

/// Where a point in eye coordinates falls in a rectangle (x, y, x end, y end); -1, -1 if it is not
/// seen there.
struct Place
{
  int Column, Row;
};

VTK_POINT_SURFACE_INLINE Place FindPlace(const vtkPointProjectionCPU::Transform& t,
  const std::array<int, 4>& rectangle, float x, float y, float z)
{
  const auto left = static_cast<float>(rectangle[0]);
  const auto bottom = static_cast<float>(rectangle[1]);
  const auto right = static_cast<float>(rectangle[2]);
  const auto top = static_cast<float>(rectangle[3]);
  const float clipZ = t.Clip[2].Of(x, y, z);
  const float w = t.Clip[3].Of(x, y, z);
  const float windowX = t.HalfSize[0] * (t.Clip[0].Of(x, y, z) / w + 1.0f);
  const float windowY = t.HalfSize[1] * (t.Clip[1].Of(x, y, z) / w + 1.0f);
  const bool seen = (w > 0.0f) & (std::abs(clipZ) <= w) & (windowX >= left) & (windowY >= bottom) &
    (windowX < right) & (windowY < top);
  return { static_cast<int>(seen ? windowX : -1.0f), static_cast<int>(seen ? windowY : -1.0f) };
}

/// The pixels of the rectangle that the points of a block lie between, clipped or not: x, y of the
/// first and of the last ones.
VTK_POINT_SURFACE_CLONES
std::array<int, 4> FindBounds(Block& block, int count,
  const vtkPointProjectionCPU::Transform& transform, const std::array<int, 4>& rectangle)
{
  BringToEye(block, count, transform);
  const vtkPointProjectionCPU::Transform t = transform; // that no write below can change
  const std::array<int, 4> r = rectangle;
  unsigned int firstColumn = VTK_UNSIGNED_INT_MAX;
  unsigned int firstRow = VTK_UNSIGNED_INT_MAX;
  int lastColumn = -1;
  int lastRow = -1;
  for (int i = 0; i < count; ++i)
  {
    const Place place = FindPlace(t, r, block.X[i], block.Y[i], block.Z[i]);
    const auto column = static_cast<unsigned int>(place.Column); // the largest where not seen
    const auto row = static_cast<unsigned int>(place.Row);
    firstColumn = column < firstColumn ? column : firstColumn;
    firstRow = row < firstRow ? row : firstRow;
    lastColumn = place.Column > lastColumn ? place.Column : lastColumn;
    lastRow = place.Row > lastRow ? place.Row : lastRow;
  }
  return { static_cast<int>(firstColumn), static_cast<int>(firstRow), lastColumn, lastRow };
}

/// Where the points of a block fall: the pixel of the tile that begins with the rectangle's row and
/// with `firstColumn`, -1 for those that are not seen.
VTK_POINT_SURFACE_CLONES
void ProjectBlock(Block& block, const Block& normals, int count,
  const vtkPointProjectionCPU::Transform& transform, const std::array<int, 4>& rectangle,
  int firstColumn, int* pixels)
{
  BringToEye(block, count, transform);
  const vtkPointProjectionCPU::Transform t = transform; // that no write below can change
  const std::array<int, 4> r = rectangle;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    const Place place = FindPlace(t, r, block.X[i], block.Y[i], block.Z[i]);
    const int pixel = (place.Row - r[1]) * TileSize + place.Column - firstColumn;
    pixels[i] = place.Row >= 0 ? pixel : -1;
  }
  for (int p = 0; p < t.NumberOfPlanes; ++p)
  {
    VTK_POINT_SURFACE_INDEPENDENT
    for (int i = 0; i < count; ++i)
    {
      const float distance = t.Planes[p].Of(block.X[i], block.Y[i], block.Z[i]);
      const int pixel = pixels[i];
      pixels[i] = distance >= 0.0f ? pixel : -1;
    }
  }
  if (t.Cull == vtkPointSurfaceView::NoCulling)
  {
    return;
  }
  // toViewer is (0, 0, 1) in parallel, else minus the position
  const float parallel = t.Parallel ? 1.0f : 0.0f;
  const float perspective = t.Parallel ? 0.0f : -1.0f;
  const bool keepFront = t.Cull == vtkPointSurfaceView::BackfaceCulling;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    const float x = t.Normal[0].Of(normals.X[i], normals.Y[i], normals.Z[i]);
    const float y = t.Normal[1].Of(normals.X[i], normals.Y[i], normals.Z[i]);
    const float z = t.Normal[2].Of(normals.X[i], normals.Y[i], normals.Z[i]);
    const float toViewer = perspective * (x * block.X[i] + y * block.Y[i] + z * block.Z[i]);
    const int facesViewer = toViewer + parallel * z >= 0.0f ? 1 : 0;
    const int pixel = pixels[i];
    pixels[i] = facesViewer == static_cast<int>(keepFront) ? pixel : -1;
  }
}

/// From positions, normals, radii and pixels.
VTK_POINT_SURFACE_CLONES
void FindFootprints(vtkPointProjectionCPU::Footprints& points, int count,
  const vtkPointProjectionCPU::Transform& transform, const vtkPointProjectionOptions& options)
{
  const vtkPointProjectionCPU::Transform t = transform; // that no write below can change
  // toViewer is (0, 0, 1) in parallel, else minus the position
  const float parallel = t.Parallel ? 1.0f : 0.0f;
  const float perspective = t.Parallel ? 0.0f : -1.0f;
  const float subpixel = options.SubpixelCenters ? 1.0f : 0.0f;
  const float largestReach = options.LargestReach;
  const float leastAlong = 1.0f / largestReach;
  const float pixelSize = 1.0f / (t.HalfSize[1] * std::abs(t.Clip[1].Y)); // where w is 1
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    const float x = points.Positions.X[i];
    const float y = points.Positions.Y[i];
    const float z = points.Positions.Z[i];
    const float distance = std::sqrt(x * x + y * y + z * z);
    const EyeNormal normal = FindEyeNormal(t, points.Normals, i, x, y, z, distance);
    points.Normals.X[i] = normal.X;
    points.Normals.Y[i] = normal.Y;
    points.Normals.Z[i] = normal.Z;

    const float w = t.Clip[3].Of(x, y, z);
    const float windowX = t.HalfSize[0] * (t.Clip[0].Of(x, y, z) / w + 1.0f);
    const float windowY = t.HalfSize[1] * (t.Clip[1].Of(x, y, z) / w + 1.0f);
    points.CenterX[i] = subpixel * (windowX - (static_cast<float>(points.Columns[i]) + 0.5f));
    points.CenterY[i] = subpixel * (windowY - (static_cast<float>(points.Rows[i]) + 0.5f));

    const float radius = t.RadiusScale * points.Radii[i];
    const float toEye = (normal.X * x + normal.Y * y + normal.Z * z) / distance;
    const float along = std::abs(parallel * normal.Z + perspective * toEye);
    const float across2 = 1.0f - along * along;
    const float across = std::sqrt(across2 > 0.0f ? across2 : 0.0f);
    const float slope = across / (along > leastAlong ? along : leastAlong);
    const float reach = w * pixelSize * slope / radius;
    const float atLeast = reach > 1.0f ? reach : 1.0f;
    points.Reaches[i] = radius * (atLeast < largestReach ? atLeast : largestReach);
    points.Radii[i] = radius;
  }
}
}

vtkPointProjectionCPU::vtkPointProjectionCPU() = default;
vtkPointProjectionCPU::~vtkPointProjectionCPU() = default;

//------------------------------------------------------------------------------
void vtkPointProjectionCPU::SetPoints(const vtkDrawablePoints* points, vtkDataArray* colors)
{
  this->Points = points;
  vtkPolyData* cloud = points->GetCloud();
  this->Positions = cloud->GetPoints()->GetData();
  if (this->Positions->GetDataType() != VTK_FLOAT && this->Positions->GetDataType() != VTK_DOUBLE)
  {
    this->Positions = vtkSmartPointer<vtkDoubleArray>::New();
    this->Positions->DeepCopy(cloud->GetPoints()->GetData());
  }
  const bool inFloats = this->Positions->GetDataType() == VTK_FLOAT;
  void* positions = this->Positions->GetVoidPointer(0);
  Arrays& values = this->Values;
  values.FloatPositions = inFloats ? static_cast<const float*>(positions) : nullptr;
  values.DoublePositions = inFloats ? nullptr : static_cast<const double*>(positions);
  auto* normals = static_cast<vtkFloatArray*>(cloud->GetPointData()->GetNormals());
  values.Normals = normals ? normals->GetPointer(0) : nullptr;
  values.Radii = points->GetRadii() ? points->GetRadii()->GetPointer(0) : nullptr;
  values.Ids = points->GetOrder().GetIds().data();

  this->Colors = colors;
  this->ColorsTime = colors ? colors->GetMTime() : 0;
  if (colors && colors->GetDataType() != VTK_UNSIGNED_CHAR && colors->GetDataType() != VTK_FLOAT)
  {
    this->Colors = vtkSmartPointer<vtkFloatArray>::New();
    this->Colors->DeepCopy(colors);
  }
  values.SetColors(this->Colors);

  const double* bounds = points->GetBounds();
  for (int k = 0; k < 3; ++k)
  {
    // a float, so that the difference to a float is the same in single and double precision
    values.Origin[k] = static_cast<float>(0.5 * (bounds[2 * k] + bounds[2 * k + 1]));
  }
  const vtkThinnedPoints::Source source =
    vtkThinnedPoints::GetSource(*points, colors, this->GetFrame());
  if (source != this->ThinnedSource)
  {
    this->ThinnedSource = source;
    this->Thinned.clear();
  }
}

vtkThinnedPoints::Frame vtkPointProjectionCPU::GetFrame() const
{
  return { this->Values.Origin, { 1.0, 1.0, 1.0 } };
}

vtkPointProjectionCPU::Transform vtkPointProjectionCPU::GetTransform(
  const vtkPointSurfaceView& view) const
{
  Transform t;
  const auto& m = view.MCVC;
  const std::array<double, 3>& origin = this->Values.Origin;
  for (int k = 0; k < 3; ++k)
  {
    const double shift = origin[0] * m[k] + origin[1] * m[4 + k] + origin[2] * m[8 + k] + m[12 + k];
    t.Eye[k] = { static_cast<float>(m[k]), static_cast<float>(m[4 + k]),
      static_cast<float>(m[8 + k]), static_cast<float>(shift) };
    t.Normal[k] = { static_cast<float>(view.Normal[k]), static_cast<float>(view.Normal[3 + k]),
      static_cast<float>(view.Normal[6 + k]), 0.0f };
  }
  for (int k = 0; k < 4; ++k)
  {
    t.Clip[k] = { static_cast<float>(view.VCDC[k]), static_cast<float>(view.VCDC[4 + k]),
      static_cast<float>(view.VCDC[8 + k]), static_cast<float>(view.VCDC[12 + k]) };
  }
  t.NumberOfPlanes = view.NumberOfClippingPlanes;
  for (int i = 0; i < t.NumberOfPlanes; ++i)
  {
    const auto& plane = view.ClippingPlanes[i];
    t.Planes[i] = { static_cast<float>(plane[0]), static_cast<float>(plane[1]),
      static_cast<float>(plane[2]), static_cast<float>(plane[3]) };
  }
  t.RadiusScale = static_cast<float>(view.RadiusScale);
  for (int k = 0; k < 2; ++k)
  {
    t.HalfSize[k] = 0.5f * view.Size[k];
  }
  t.Cull = view.Cull;
  t.Parallel = view.IsParallel();
  return t;
}

//------------------------------------------------------------------------------
struct vtkPointProjectionCPU::Part
{
  const Cloud* Source;
  Transform View;

  Arrays Values; // of the points, or of what stands for groups of them

  std::vector<std::array<vtkIdType, 2>> Blocks; // of these

  int GetCount(size_t block) const
  {
    return static_cast<int>(this->Blocks[block][1] - this->Blocks[block][0]);
  }

  /// Where the arrays have the point at a place among all.
  size_t GetOwnPlace(unsigned int place) const
  {
    return place - static_cast<size_t>(this->Source->FirstId);
  }

  unsigned int GetId(size_t ownPlace) const
  {
    return this->Values.Ids[ownPlace] + static_cast<unsigned int>(this->Source->FirstId);
  }

  std::array<float, 4> GetColor(size_t ownPlace) const
  {
    return this->Source->Projection->Colors ? this->Values.GetColor(ownPlace) : this->Source->Color;
  }

  float GetUniformRadius() const
  {
    return static_cast<float>(this->Source->Projection->Points->GetUniformRadius());
  }

  /// Positions of the points of a block about the origin.
  void LoadPositions(Block& positions, size_t block) const
  {
    const vtkIdType first = 3 * this->Blocks[block][0];
    const int count = this->GetCount(block);
    const Arrays& values = this->Values;
    values.FloatPositions
      ? LoadInOrder(positions, count, values.FloatPositions + first, values.Origin.data())
      : LoadInOrder(positions, count, values.DoublePositions + first, values.Origin.data());
  }

  /// The same of normals, zero where the cloud has none.
  void LoadNormals(Block& normals, size_t block) const
  {
    if (this->Values.Normals)
    {
      LoadInOrder(
        normals, this->GetCount(block), this->Values.Normals + 3 * this->Blocks[block][0]);
    }
    else
    {
      normals = {};
    }
  }

  /// The same of points at listed places.
  void LoadNormals(Block& normals, int count, const unsigned int* ownPlaces) const
  {
    if (this->Values.Normals)
    {
      LoadListed(normals, count, this->Values.Normals, ownPlaces);
    }
    else
    {
      normals = {};
    }
  }

  /// The same of radii.
  void LoadRadii(float* radii, size_t block) const
  {
    const int count = this->GetCount(block);
    this->Values.Radii ? std::copy_n(this->Values.Radii + this->Blocks[block][0], count, radii)
                       : std::fill_n(radii, count, this->GetUniformRadius());
  }

  void LoadRadii(float* radii, int count, const unsigned int* ownPlaces) const
  {
    if (!this->Values.Radii)
    {
      std::fill_n(radii, count, this->GetUniformRadius());
      return;
    }
    for (int i = 0; i < count; ++i)
    {
      radii[i] = this->Values.Radii[ownPlaces[i]];
    }
  }
};

//------------------------------------------------------------------------------
vtkPointProjectionCPU::Ranges vtkPointProjectionCPU::Thin(int size, const Ranges& ranges)
{
  if (size == 1)
  {
    return ranges;
  }
  const auto thinned =
    this->Thinned.try_emplace(size, *this->Points, this->Colors, this->GetFrame(), size).first;
  return vtkThinnedPoints::GetGroups(thinned->second.Firsts, ranges);
}

vtkPointProjectionCPU::Arrays vtkPointProjectionCPU::GetArrays(int thinning) const
{
  if (thinning == 1)
  {
    return this->Values;
  }
  const vtkThinnedPoints& thinned = this->Thinned.at(thinning);
  Arrays arrays;
  arrays.FloatPositions = thinned.Positions.data();
  arrays.Normals = this->Values.Normals ? thinned.Normals.data() : nullptr;
  arrays.Radii = this->Values.Radii ? thinned.Radii.data() : nullptr;
  arrays.Ids = thinned.Ids.data();
  arrays.SetColors(thinned.Colors);
  return arrays;
}

//------------------------------------------------------------------------------
void vtkPointProjectionCPU::Draw(const std::vector<Cloud>& clouds,
  const vtkPointProjectionOptions& options, vtkSurfaceImage& image, vtkSurfaceImage* nearest)
{
  const std::vector<Part> parts = MakeParts(clouds);
  const int tiles = this->FindTiles(parts, image.GetRectangle());
  vtkSMPTools::For(0, tiles, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      std::shared_ptr<Tile>& tile = this->Tiles.Local();
      if (!tile)
      {
        tile = std::make_shared<Tile>();
      }
      for (vtkIdType index = begin; index < end; ++index)
      {
        this->DrawTile(parts, options, static_cast<int>(index), *tile, image, nearest);
      }
    });
}

std::vector<vtkPointProjectionCPU::Part> vtkPointProjectionCPU::MakeParts(
  const std::vector<Cloud>& clouds)
{
  std::vector<Part> parts;
  for (const Cloud& cloud : clouds)
  {
    const vtkPointProjectionCPU& projection = *cloud.Projection;
    parts.push_back(
      { &cloud, projection.GetTransform(cloud.View), projection.GetArrays(cloud.Thinning), {} });
    for (const auto& range : cloud.View.Ranges)
    {
      for (vtkIdType first = range[0]; first < range[1]; first += BlockSize)
      {
        parts.back().Blocks.push_back({ first, std::min<vtkIdType>(first + BlockSize, range[1]) });
      }
    }
  }
  return parts;
}

const vtkPointProjectionCPU::Part& vtkPointProjectionCPU::GetPart(
  const std::vector<Part>& parts, unsigned int place)
{
  size_t i = parts.size() - 1;
  while (place < parts[i].Source->FirstId)
  {
    --i;
  }
  return parts[i];
}

//------------------------------------------------------------------------------
/// A block of points and the tiles that they may fall into: column, row of the first and last one.
struct vtkPointProjectionCPU::Site
{
  unsigned int Part, Block;
  std::array<int, 4> Tiles;
};

/// Lists for each tile the blocks of points that may fall into it, in their order; returns the
/// number of tiles.
int vtkPointProjectionCPU::FindTiles(
  const std::vector<Part>& parts, const std::array<int, 4>& rectangle)
{
  const int firstColumn = rectangle[0] / TileSize * TileSize; // where a block of an image begins
  this->TileColumns = (rectangle[2] - firstColumn + TileSize - 1) / TileSize;
  this->Sites.clear();
  for (size_t part = 0; part < parts.size(); ++part)
  {
    for (size_t block = 0; block < parts[part].Blocks.size(); ++block)
    {
      this->Sites.push_back(
        { static_cast<unsigned int>(part), static_cast<unsigned int>(block), {} });
    }
  }
  vtkSMPTools::For(0, static_cast<vtkIdType>(this->Sites.size()), ChunkBlocks,
    [&](vtkIdType begin, vtkIdType end)
    {
      Block positions;
      for (vtkIdType i = begin; i < end; ++i)
      {
        Site& site = this->Sites[i];
        const Part& part = parts[site.Part];
        part.LoadPositions(positions, site.Block);
        const std::array<int, 4> pixels =
          FindBounds(positions, part.GetCount(site.Block), part.View, rectangle);
        const bool seen = pixels[2] >= 0;
        for (int k = 0; k < 4; ++k)
        {
          const int origin = k % 2 == 0 ? firstColumn : rectangle[1];
          site.Tiles[k] = seen ? (pixels[k] - origin) / TileSize : -(k / 2); // none: [0, -1]
        }
      }
    });

  const int tiles = this->TileColumns * ((rectangle[3] - rectangle[1] + TileSize - 1) / TileSize);
  const auto forTiles = [this](const Site& site, auto work)
  {
    for (int row = site.Tiles[1]; row <= site.Tiles[3]; ++row)
    {
      for (int column = site.Tiles[0]; column <= site.Tiles[2]; ++column)
      {
        work(row * this->TileColumns + column);
      }
    }
  };
  this->SiteEnds.assign(tiles, 0);
  for (const Site& site : this->Sites)
  {
    forTiles(site, [this](int tile) { ++this->SiteEnds[tile]; });
  }
  size_t sum = 0;
  for (size_t& end : this->SiteEnds)
  {
    const size_t begin = sum;
    sum += end;
    end = begin;
  }
  this->TileSites.resize(sum);
  for (size_t i = 0; i < this->Sites.size(); ++i)
  {
    forTiles(this->Sites[i],
      [this, i](int tile)
      { this->TileSites[this->SiteEnds[tile]++] = static_cast<unsigned int>(i); });
  }
  return tiles;
}

//------------------------------------------------------------------------------
/// What a thread makes a tile of.
struct vtkPointProjectionCPU::Tile
{
  struct Point
  {
    float X, Y, Z;      // in eye coordinates
    int Pixel;          // of the tile
    unsigned int Place; // in the part's arrays
  };

  /// From one plane of values to the next: not a power of two, which a cache has few places for.
  static constexpr int Stride = TilePixels + 16;

  int X, Y;                     // of its first pixel
  std::array<int, 4> Rectangle; // of its pixels that are in the image's
  std::vector<Point> Points;    // those that are seen in it, by parts, in the order of space
  int Count = 0;                // of them
  std::vector<int> PartEnds;    // in Points

  // Of the pixels: the point that stands for each, its normal and depth, and the largest depth of
  // what is looked for behind it; planes of an image, which are sums of so many points.
  std::array<std::uint64_t, TilePixels> Nearest;
  alignas(64) float FrontNormals[3][Stride] = {};
  alignas(64) float FrontDepths[TilePixels] = {};
  alignas(64) float Limits[TilePixels] = {};
  alignas(64) float Values[vtkSurfaceImage::NumberOfPlanes][Stride] = {};
  alignas(64) float Counts[TilePixels] = {};
  std::array<bool, TileSize> HasCompanions; // of the rows: whether some are sums of several points

  void Append(const Block& positions, const int* pixels, unsigned int firstPlace, int count);
  void FindNearest();
  void FindFarthest(vtkSurfaceImage& nearest, float tolerance);
  void Write(vtkSurfaceImage& image) const;

  /// Calls work(part, begin, end) for the parts that have points, with where these are.
  template <typename Work>
  void ForParts(const std::vector<Part>& parts, const Work& work) const
  {
    int begin = 0;
    for (size_t part = 0; part < parts.size(); ++part)
    {
      if (this->PartEnds[part] > begin)
      {
        work(parts[part], begin, this->PartEnds[part]);
        begin = this->PartEnds[part];
      }
    }
  }
};

/// Those of a block that fall into the tile.
void vtkPointProjectionCPU::Tile::Append(
  const Block& positions, const int* pixels, unsigned int firstPlace, int count)
{
  if (this->Points.size() < static_cast<size_t>(this->Count + BlockSize))
  {
    this->Points.resize(2 * static_cast<size_t>(this->Count + BlockSize));
  }
  // without branches that half of the points would take
  Point* to = &this->Points[this->Count];
  for (int i = 0; i < count; ++i)
  {
    *to = { positions.X[i], positions.Y[i], positions.Z[i], pixels[i], firstPlace + i };
    to += pixels[i] >= 0;
  }
  this->Count = static_cast<int>(to - this->Points.data());
}

void vtkPointProjectionCPU::Tile::FindNearest()
{
  this->Nearest.fill(NoPoint);
  const Point* points = this->Points.data();
  for (int i = 0; i < this->Count; ++i)
  {
    const Point& point = points[i];
    std::uint64_t& nearest = this->Nearest[point.Pixel];
    nearest = std::min(nearest, MakeKey(-point.Z, i));
  }
}

/// The same for the farthest points that are within a tolerance of the nearest ones.
void vtkPointProjectionCPU::Tile::FindFarthest(vtkSurfaceImage& nearest, float tolerance)
{
  for (int y = this->Rectangle[1]; y < this->Rectangle[3]; ++y)
  {
    const float* radii = nearest.GetRow(y, vtkSurfaceImage::Radius);
    const float* depths = nearest.GetRow(y, vtkSurfaceImage::IntervalX);
    float* limits = &this->Limits[(y - this->Y) * TileSize];
    for (int x = this->Rectangle[0]; x < this->Rectangle[2]; ++x)
    {
      limits[x - this->X] = radii[x] > 0.0f ? depths[x] + tolerance : -VTK_FLOAT_MAX;
    }
  }
  this->Nearest.fill(NoPoint);
  for (int i = 0; i < this->Count; ++i)
  {
    const Point& point = this->Points[i];
    const std::uint64_t key = -point.Z <= this->Limits[point.Pixel] ? MakeKey(point.Z, i) : NoPoint;
    std::uint64_t& farthest = this->Nearest[point.Pixel];
    farthest = std::min(farthest, key);
  }
}

/// Copies the planes to the image.
void vtkPointProjectionCPU::Tile::Write(vtkSurfaceImage& image) const
{
  constexpr int Size = vtkSurfaceImage::BlockSize;
  const int begin = this->Rectangle[0] / Size;
  const int end = (this->Rectangle[2] + Size - 1) / Size;
  for (int y = this->Rectangle[1]; y < this->Rectangle[3]; ++y)
  {
    const int first = (y - this->Y) * TileSize - this->X;
    for (int block = begin; block < end; ++block)
    {
      const int x = block * Size;
      const float* radii = &this->Values[vtkSurfaceImage::Radius][first + x];
      int valid = 0;
      for (int i = 0; i < Size; ++i) // on all lanes
      {
        valid |= radii[i] > 0.0f ? 1 : 0;
      }
      if (valid == 0)
      {
        image.ClearBlocks(y, block, block + 1);
        continue;
      }
      image.GetOccupied(y)[block] = 1;
      for (int k = 0; k < image.GetNumberOfPlanes(); ++k)
      {
        std::memcpy(image.GetRow(y, k) + x, &this->Values[k][first + x], Size * sizeof(float));
      }
    }
  }
}

//------------------------------------------------------------------------------
void vtkPointProjectionCPU::DrawTile(const std::vector<Part>& parts,
  const vtkPointProjectionOptions& options, int index, Tile& tile, vtkSurfaceImage& image,
  vtkSurfaceImage* nearest) const
{
  const vtkSurfaceImage::Rectangle& r = image.GetRectangle();
  tile.X = (r[0] / TileSize + index % this->TileColumns) * TileSize;
  tile.Y = r[1] + index / this->TileColumns * TileSize;
  tile.Rectangle = { std::max(tile.X, r[0]), tile.Y, std::min(tile.X + TileSize, r[2]),
    std::min(tile.Y + TileSize, r[3]) };
  std::fill_n(tile.Values[vtkSurfaceImage::Radius], TilePixels, 0.0f);
  std::fill_n(tile.Counts, TilePixels, 0.0f);
  tile.HasCompanions.fill(false);
  this->ListPoints(parts, index, tile);
  if (tile.Count > 0)
  {
    nearest ? tile.FindFarthest(*nearest, options.DepthTolerance) : tile.FindNearest();
    tile.ForParts(parts,
      [&](const Part& part, int begin, int end)
      { FetchNearest(part, options, begin, end, tile, image); });
  }
  if (tile.Count > 0 && options.AveragePoints)
  {
    tile.ForParts(parts,
      [&](const Part& part, int begin, int end)
      { AddCompanions(part, options, begin, end, tile, image.HasColors()); });
    Average(options, image.GetNumberOfPlanes(), tile);
  }
  tile.Write(image);
}

void vtkPointProjectionCPU::ListPoints(const std::vector<Part>& parts, int index, Tile& tile) const
{
  Block positions;
  Block normals;
  int pixels[BlockSize];
  tile.Count = 0;
  tile.PartEnds.assign(parts.size(), 0);
  for (size_t i = index == 0 ? 0 : this->SiteEnds[index - 1]; i < this->SiteEnds[index]; ++i)
  {
    const Site& site = this->Sites[this->TileSites[i]];
    const Part& part = parts[site.Part];
    const int count = part.GetCount(site.Block);
    part.LoadPositions(positions, site.Block);
    if (part.View.Cull != vtkPointSurfaceView::NoCulling)
    {
      part.LoadNormals(normals, site.Block);
    }
    ProjectBlock(positions, normals, count, part.View, tile.Rectangle, tile.X, pixels);
    tile.Append(positions, pixels, static_cast<unsigned int>(part.Blocks[site.Block][0]), count);
    tile.PartEnds[site.Part] = tile.Count;
  }
}

/// What listed points of a part leave in their pixels, and their places in its arrays.
void vtkPointProjectionCPU::FetchFootprints(const Part& part,
  const vtkPointProjectionOptions& options, const Tile& tile, const int* list, int count,
  Footprints& points, unsigned int* places)
{
  for (int i = 0; i < count; ++i)
  {
    const Tile::Point& point = tile.Points[list[i]];
    points.Positions.X[i] = point.X;
    points.Positions.Y[i] = point.Y;
    points.Positions.Z[i] = point.Z;
    points.Columns[i] = tile.X + point.Pixel % TileSize;
    points.Rows[i] = tile.Y + point.Pixel / TileSize;
    places[i] = point.Place;
  }
  part.LoadNormals(points.Normals, count, places);
  part.LoadRadii(points.Radii, count, places);
  FindFootprints(points, count, part.View, options);
}

/// Fills the pixels that points [begin, end) of the tile, of one part, are the nearest ones of.
void vtkPointProjectionCPU::FetchNearest(const Part& part, const vtkPointProjectionOptions& options,
  int begin, int end, Tile& tile, vtkSurfaceImage& image)
{
  constexpr int Rows = BlockSize / TileSize; // that are fetched together
  int list[BlockSize + 1];
  unsigned int places[BlockSize];
  Footprints points;
  for (int first = 0; first < TilePixels; first += Rows * TileSize)
  {
    int count = 0;
    for (int pixel = first; pixel < first + Rows * TileSize; ++pixel)
    {
      const unsigned int index = GetIndex(tile.Nearest[pixel]);
      list[count] = static_cast<int>(index);
      count += index - begin < static_cast<unsigned int>(end - begin);
    }
    FetchFootprints(part, options, tile, list, count, points, places);
    for (int i = 0; i < count; ++i)
    {
      WriteFootprint(part, options, points, i, places[i], tile.Points[list[i]].Pixel, tile, image);
    }
  }
}

void vtkPointProjectionCPU::WriteFootprint(const Part& part,
  const vtkPointProjectionOptions& options, const Footprints& points, int i, unsigned int place,
  int pixel, Tile& tile, vtkSurfaceImage& image)
{
  const float depth = -points.Positions.Z[i];
  tile.Values[vtkSurfaceImage::NormalX][pixel] = points.Normals.X[i];
  tile.Values[vtkSurfaceImage::NormalY][pixel] = points.Normals.Y[i];
  tile.Values[vtkSurfaceImage::NormalZ][pixel] = points.Normals.Z[i];
  tile.Values[vtkSurfaceImage::Radius][pixel] = points.Radii[i];
  tile.Values[vtkSurfaceImage::IntervalX][pixel] = depth;
  tile.Values[vtkSurfaceImage::IntervalY][pixel] =
    options.CenterDepths ? 0.0f : depth + points.Radii[i];
  tile.Values[vtkSurfaceImage::CenterX][pixel] = points.CenterX[i];
  tile.Values[vtkSurfaceImage::CenterY][pixel] = points.CenterY[i];
  if (options.AveragePoints)
  {
    tile.FrontNormals[0][pixel] = points.Normals.X[i];
    tile.FrontNormals[1][pixel] = points.Normals.Y[i];
    tile.FrontNormals[2][pixel] = points.Normals.Z[i];
    tile.FrontDepths[pixel] = depth;
    tile.Limits[pixel] = depth + points.Reaches[i];
    tile.Counts[pixel] = 1.0f;
  }
  if (image.HasIds())
  {
    image.GetIds(points.Rows[i])[points.Columns[i]] = part.GetId(place) + 1;
  }
  if (image.HasColors())
  {
    const std::array<float, 4> color = part.GetColor(place);
    for (int k = 0; k < 4; ++k)
    {
      tile.Values[vtkSurfaceImage::Red + k][pixel] = color[k];
    }
  }
}

/// Adds those of the points [begin, end) of the tile, of one part, that share a pixel with a nearer
/// one and are within its reach.
void vtkPointProjectionCPU::AddCompanions(const Part& part,
  const vtkPointProjectionOptions& options, int begin, int end, Tile& tile, bool colors)
{
  const bool twoSided = part.View.Cull == vtkPointSurfaceView::NoCulling;
  int list[BlockSize + 1];
  unsigned int places[BlockSize];
  Footprints points;
  for (int first = begin; first < end; first += BlockSize)
  {
    int count = 0;
    for (int i = first; i < std::min(first + BlockSize, end); ++i)
    {
      const Tile::Point& point = tile.Points[i];
      list[count] = i;
      count += (GetIndex(tile.Nearest[point.Pixel]) != static_cast<unsigned int>(i)) &
        (-point.Z <= tile.Limits[point.Pixel]);
    }
    FetchFootprints(part, options, tile, list, count, points, places);
    for (int i = 0; i < count; ++i)
    {
      const int pixel = tile.Points[list[i]].Pixel;
      const float alike = points.Normals.X[i] * tile.FrontNormals[0][pixel] +
        points.Normals.Y[i] * tile.FrontNormals[1][pixel] +
        points.Normals.Z[i] * tile.FrontNormals[2][pixel];
      // it is turned as the nearest one is
      const float side = twoSided & (alike < 0.0f) ? -1.0f : 1.0f;
      tile.Values[vtkSurfaceImage::NormalX][pixel] += side * points.Normals.X[i];
      tile.Values[vtkSurfaceImage::NormalY][pixel] += side * points.Normals.Y[i];
      tile.Values[vtkSurfaceImage::NormalZ][pixel] += side * points.Normals.Z[i];
      tile.Values[vtkSurfaceImage::Radius][pixel] += points.Radii[i];
      tile.Values[vtkSurfaceImage::IntervalX][pixel] -= points.Positions.Z[i];
      tile.Values[vtkSurfaceImage::CenterX][pixel] += points.CenterX[i];
      tile.Values[vtkSurfaceImage::CenterY][pixel] += points.CenterY[i];
      tile.Counts[pixel] += 1.0f;
      tile.HasCompanions[pixel / TileSize] = true;
      if (colors)
      {
        const std::array<float, 4> color = part.GetColor(places[i]);
        for (int k = 0; k < 4; ++k)
        {
          tile.Values[vtkSurfaceImage::Red + k][pixel] += color[k];
        }
      }
    }
  }
}

namespace
{
/// Of sums of normals, in a row of a tile.
VTK_POINT_SURFACE_CLONES
void AverageNormals(float* x, float* y, float* z, const float* frontX, const float* frontY,
  const float* frontZ, const float* counts)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < TileSize; ++i)
  {
    const float size = std::sqrt(x[i] * x[i] + y[i] * y[i] + z[i] * z[i]);
    const bool cancels = size < 1e-6f;
    const bool several = counts[i] > 1.0f;
    const float meanX = cancels ? frontX[i] : x[i] / size;
    const float meanY = cancels ? frontY[i] : y[i] / size;
    const float meanZ = cancels ? frontZ[i] : z[i] / size;
    x[i] = several ? meanX : x[i];
    y[i] = several ? meanY : y[i];
    z[i] = several ? meanZ : z[i];
  }
}

VTK_POINT_SURFACE_CLONES
void Divide(float* sums, const float* counts)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < TileSize; ++i)
  {
    const float mean = sums[i] / counts[i];
    sums[i] = counts[i] > 1.0f ? mean : sums[i];
  }
}

/// How far the means are behind the nearest points.
VTK_POINT_SURFACE_CLONES
void FindSpans(const float* means, const float* nearest, const float* counts, float* spans)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < TileSize; ++i)
  {
    const float span = means[i] - nearest[i];
    spans[i] = counts[i] > 1.0f ? span : spans[i];
  }
}
}

/// Makes means of the sums in pixels of several points.
void vtkPointProjectionCPU::Average(
  const vtkPointProjectionOptions& options, int planes, Tile& tile)
{
  for (int row = 0; row < TileSize; ++row)
  {
    if (!tile.HasCompanions[row])
    {
      continue;
    }
    const int first = row * TileSize;
    const float* counts = tile.Counts + first;
    AverageNormals(tile.Values[vtkSurfaceImage::NormalX] + first,
      tile.Values[vtkSurfaceImage::NormalY] + first, tile.Values[vtkSurfaceImage::NormalZ] + first,
      tile.FrontNormals[0] + first, tile.FrontNormals[1] + first, tile.FrontNormals[2] + first,
      counts);
    for (int k = vtkSurfaceImage::Radius; k < planes; ++k)
    {
      if (k != vtkSurfaceImage::IntervalX && k != vtkSurfaceImage::IntervalY)
      {
        Divide(tile.Values[k] + first, counts);
      }
    }
    float* depths = tile.Values[vtkSurfaceImage::IntervalX] + first;
    if (!options.CenterDepths) // the interval is the nearest point's
    {
      std::copy_n(tile.FrontDepths + first, TileSize, depths);
      continue;
    }
    Divide(depths, counts);
    FindSpans(
      depths, tile.FrontDepths + first, counts, tile.Values[vtkSurfaceImage::IntervalY] + first);
  }
}

void vtkPointProjectionCPU::Arrays::SetColors(vtkDataArray* colors)
{
  const bool inBytes = colors && colors->GetDataType() == VTK_UNSIGNED_CHAR;
  void* values = colors ? colors->GetVoidPointer(0) : nullptr;
  this->ByteColors = inBytes ? static_cast<const unsigned char*>(values) : nullptr;
  this->FloatColors = inBytes ? nullptr : static_cast<const float*>(values);
  this->ColorComponents = colors ? colors->GetNumberOfComponents() : 0;
}

std::array<float, 4> vtkPointProjectionCPU::Arrays::GetColor(size_t place) const
{
  std::array<float, 4> color = { 0.0f, 0.0f, 0.0f, 1.0f };
  const int size = this->ColorComponents;
  for (int k = 0; k < std::min(size, this->ByteColors ? 4 : 2); ++k)
  {
    color[k] = this->ByteColors ? this->ByteColors[size * place + k] / 255.0f
                                : this->FloatColors[size * place + k];
  }
  return color;
}

//------------------------------------------------------------------------------
namespace
{
/// Brings the points of a block to the eye; tells which of them are to be seen.
VTK_POINT_SURFACE_CLONES
void TransformBlock(const Block& positions, const Block& normals, const float* radii, int count,
  const vtkPointProjectionCPU::Transform& transform, float clippingReach,
  vtkPointProjectionCPU::EyePoints& points, int* seen)
{
  const vtkPointProjectionCPU::Transform t = transform; // that no write below can change
  // toViewer is (0, 0, 1) in parallel, else minus the position
  const float parallel = t.Parallel ? 1.0f : 0.0f;
  const float perspective = t.Parallel ? 0.0f : -1.0f;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    const float x = t.Eye[0].Of(positions.X[i], positions.Y[i], positions.Z[i]);
    const float y = t.Eye[1].Of(positions.X[i], positions.Y[i], positions.Z[i]);
    const float z = t.Eye[2].Of(positions.X[i], positions.Y[i], positions.Z[i]);
    points.X[i] = x;
    points.Y[i] = y;
    points.Z[i] = z;
    points.Radius[i] = t.RadiusScale * radii[i];
    const float clipZ = t.Clip[2].Of(x, y, z);
    const float w = t.Clip[3].Of(x, y, z);
    seen[i] = (w > 0.0f) & (std::abs(clipZ) <= w);

    const float distance = std::sqrt(x * x + y * y + z * z);
    const EyeNormal normal = FindEyeNormal(t, normals, i, x, y, z, distance);
    points.NormalX[i] = normal.X;
    points.NormalY[i] = normal.Y;
    points.NormalZ[i] = normal.Z;
  }
  for (int p = 0; p < t.NumberOfPlanes; ++p)
  {
    const Row& plane = t.Planes[p];
    const float reach =
      clippingReach * std::sqrt(plane.X * plane.X + plane.Y * plane.Y + plane.Z * plane.Z);
    VTK_POINT_SURFACE_INDEPENDENT
    for (int i = 0; i < count; ++i)
    {
      const float distance = plane.Of(points.X[i], points.Y[i], points.Z[i]);
      seen[i] &= distance >= -reach * points.Radius[i] ? 1 : 0;
    }
  }
  if (t.Cull == vtkPointSurfaceView::NoCulling)
  {
    return;
  }
  const int kept = t.Cull == vtkPointSurfaceView::BackfaceCulling ? 1 : 0;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    const float toViewer = perspective *
        (points.NormalX[i] * points.X[i] + points.NormalY[i] * points.Y[i] +
          points.NormalZ[i] * points.Z[i]) +
      parallel * points.NormalZ[i];
    seen[i] &= (toViewer >= 0.0f ? 1 : 0) == kept ? 1 : 0;
  }
}
}

vtkPointProjectionCPU::EyeBlocks::EyeBlocks(const std::vector<Cloud>& clouds, float clippingReach)
  : Parts(MakeParts(clouds))
  , ClippingReach(clippingReach)
{
  static_assert(EyePoints::Capacity == BlockSize, "points are brought to the eye in blocks");
  for (size_t part = 0; part < this->Parts.size(); ++part)
  {
    for (size_t block = 0; block < this->Parts[part].Blocks.size(); ++block)
    {
      this->Blocks.push_back({ part, block });
    }
  }
}

vtkPointProjectionCPU::EyeBlocks::~EyeBlocks() = default;

void vtkPointProjectionCPU::EyeBlocks::Fetch(size_t index, EyePoints& points) const
{
  const Part& part = this->Parts[this->Blocks[index][0]];
  const size_t block = this->Blocks[index][1];
  const auto first = static_cast<unsigned int>(part.Blocks[block][0]);
  const auto firstId = static_cast<unsigned int>(part.Source->FirstId);
  const unsigned int* ids = part.Values.Ids + first;
  Block positions;
  Block normals;
  float radii[BlockSize];
  int seen[BlockSize];
  const int count = part.GetCount(block);
  part.LoadPositions(positions, block);
  part.LoadNormals(normals, block);
  part.LoadRadii(radii, block);
  TransformBlock(positions, normals, radii, count, part.View, this->ClippingReach, points, seen);
  if (std::find(seen, seen + count, 0) == seen + count)
  {
    points.Count = count;
    std::transform(
      ids, ids + count, points.Id, [firstId](unsigned int id) { return firstId + id; });
    std::iota(points.Place, points.Place + count, firstId + first);
    return;
  }
  // without a branch that half of the points would take
  points.Count = 0;
  for (int i = 0; i < count; ++i)
  {
    const int to = points.Count;
    points.X[to] = points.X[i];
    points.Y[to] = points.Y[i];
    points.Z[to] = points.Z[i];
    points.NormalX[to] = points.NormalX[i];
    points.NormalY[to] = points.NormalY[i];
    points.NormalZ[to] = points.NormalZ[i];
    points.Radius[to] = points.Radius[i];
    points.Place[to] = firstId + first + i;
    points.Id[to] = firstId + ids[i];
    points.Count += seen[i];
  }
}

std::array<float, 4> vtkPointProjectionCPU::EyeBlocks::GetColor(unsigned int place) const
{
  const Part& part = GetPart(this->Parts, place);
  return part.GetColor(part.GetOwnPlace(place));
}
