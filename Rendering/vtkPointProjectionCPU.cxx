// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointProjectionCPU.h"

#include "vtkDrawablePoints.h"
#include "vtkPointProjectionOptions.h"
#include "vtkPointSurfaceVectorize.h"
#include "vtkPointSurfaceView.h"
#include "vtkPointThinning.h"
#include "vtkSurfaceImage.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

namespace
{
/// Points that are transformed together.
constexpr int BlockSize = 256;

/// Blocks that one thread goes through in order, and rows that one thread fetches points for.
constexpr size_t ChunkBlocks = 32;
constexpr int BandRows = 32;

/// Columns of a band for which points are fetched row by row.
constexpr int StripColumns = 64;

/// Chunks whose points are listed, before what is listed is added up: the lists stay small.
constexpr int RoundChunks = 32;

/// No point: above every key of MakeKey().
constexpr std::uint64_t NoPoint = ~std::uint64_t(0);

/// A number that orders points by depth and, where depths are the same, by place in the order.
std::uint64_t MakeKey(float depth, unsigned int place)
{
  std::uint32_t bits;
  std::memcpy(&bits, &depth, sizeof(bits));
  // floats of one sign are ordered as their bits are
  const std::uint32_t negative = 0u - (bits >> 31);
  bits ^= negative | 0x80000000u;
  return (std::uint64_t(bits) << 32) | place;
}

unsigned int GetPlace(std::uint64_t key)
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

/// The tuples at the listed places.
template <typename T>
void LoadListed(
  Block& block, int count, const T* tuples, const unsigned int* places, const double* origin)
{
  T listed[3 * BlockSize];
  for (int i = 0; i < count; ++i)
  {
    const T* tuple = tuples + 3 * static_cast<size_t>(places[i]);
    listed[3 * i] = tuple[0];
    listed[3 * i + 1] = tuple[1];
    listed[3 * i + 2] = tuple[2];
  }
  LoadInOrder(block, count, listed, origin);
}

/// See Part::ListPoints().
void Load(Block& block, vtkIdType first, int count, const float* tuples, const unsigned int* places,
  const double* origin)
{
  first < 0 ? LoadListed(block, count, tuples, places, origin)
            : LoadInOrder(block, count, tuples + 3 * first, origin);
}

void Load(Block& block, vtkIdType first, int count, const double* tuples,
  const unsigned int* places, const double* origin)
{
  first < 0 ? LoadListed(block, count, tuples, places, origin)
            : LoadInOrder(block, count, tuples + 3 * first, origin);
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
  int Rectangle[4];  // x, y, width, height
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

/// Where the points of a block fall: the pixel in the rectangle, -1 for those that are not seen.
VTK_POINT_SURFACE_CLONES
void ProjectBlock(Block& block, const Block& normals, int count,
  const vtkPointProjectionCPU::Transform& transform, int* pixels, float* depths)
{
  BringToEye(block, count, transform);
  const vtkPointProjectionCPU::Transform t = transform; // that no write below can change
  const int x0 = t.Rectangle[0];
  const int y0 = t.Rectangle[1];
  const float left = static_cast<float>(t.Rectangle[0]);
  const float bottom = static_cast<float>(t.Rectangle[1]);
  const float right = static_cast<float>(t.Rectangle[0] + t.Rectangle[2]);
  const float top = static_cast<float>(t.Rectangle[1] + t.Rectangle[3]);
  const int width = t.Rectangle[2];
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    const float x = block.X[i];
    const float y = block.Y[i];
    const float z = block.Z[i];
    depths[i] = -z;
    const float clipZ = t.Clip[2].Of(x, y, z);
    const float w = t.Clip[3].Of(x, y, z);
    const float windowX = t.HalfSize[0] * (t.Clip[0].Of(x, y, z) / w + 1.0f);
    const float windowY = t.HalfSize[1] * (t.Clip[1].Of(x, y, z) / w + 1.0f);
    const bool seen = (w > 0.0f) & (std::abs(clipZ) <= w) & (windowX >= left) &
      (windowY >= bottom) & (windowX < right) & (windowY < top);
    const int column = static_cast<int>(seen ? windowX : left);
    const int row = static_cast<int>(seen ? windowY : bottom);
    const int pixel = (row - y0) * width + column - x0;
    pixels[i] = seen ? pixel : -1;
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

/// Columns and rows of pixels of a rectangle.
VTK_POINT_SURFACE_CLONES
void SplitPixels(
  const int* pixels, int count, const std::array<int, 4>& rectangle, int* columns, int* rows)
{
  const int x = rectangle[0];
  const int y = rectangle[1];
  const int width = rectangle[2] - x;
  const double inverse = 1.0 / width;
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < count; ++i)
  {
    const int row = static_cast<int>((pixels[i] + 0.5) * inverse); // a whole division is slow
    rows[i] = y + row;
    columns[i] = x + pixels[i] - row * width;
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
  this->FloatPositions = inFloats ? static_cast<const float*>(positions) : nullptr;
  this->DoublePositions = inFloats ? nullptr : static_cast<const double*>(positions);
  auto* normals = static_cast<vtkFloatArray*>(cloud->GetPointData()->GetNormals());
  this->Normals = normals ? normals->GetPointer(0) : nullptr;
  this->Radii = points->GetRadii() ? points->GetRadii()->GetPointer(0) : nullptr;

  this->Colors = colors;
  this->ColorsTime = colors ? colors->GetMTime() : 0;
  if (colors && colors->GetDataType() != VTK_UNSIGNED_CHAR && colors->GetDataType() != VTK_FLOAT)
  {
    this->Colors = vtkSmartPointer<vtkFloatArray>::New();
    this->Colors->DeepCopy(colors);
  }
  const bool inBytes = colors && this->Colors->GetDataType() == VTK_UNSIGNED_CHAR;
  void* values = colors ? this->Colors->GetVoidPointer(0) : nullptr;
  this->ByteColors = inBytes ? static_cast<const unsigned char*>(values) : nullptr;
  this->FloatColors = inBytes ? nullptr : static_cast<const float*>(values);

  const double* bounds = points->GetBounds();
  for (int k = 0; k < 3; ++k)
  {
    // a float, so that the difference to a float is the same in single and double precision
    this->Origin[k] = static_cast<float>(0.5 * (bounds[2 * k] + bounds[2 * k + 1]));
  }
}

vtkPointProjectionCPU::Transform vtkPointProjectionCPU::GetTransform(
  const vtkPointSurfaceView& view) const
{
  Transform t;
  const auto& m = view.MCVC;
  for (int k = 0; k < 3; ++k)
  {
    const double shift =
      this->Origin[0] * m[k] + this->Origin[1] * m[4 + k] + this->Origin[2] * m[8 + k] + m[12 + k];
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
  std::copy(view.Rectangle.begin(), view.Rectangle.end(), t.Rectangle);
  t.Cull = view.Cull;
  t.Parallel = view.IsParallel();
  return t;
}

//------------------------------------------------------------------------------
struct vtkPointProjectionCPU::Part
{
  const Cloud* Source;
  Transform View;

  /// Groups of points of a range, see vtkPointThinning.
  struct Groups
  {
    vtkIdType First, End;
    std::array<vtkIdType, 2> Range;
  };
  std::vector<Groups> Blocks;

  int GetNumberOfChunks() const
  {
    return static_cast<int>((this->Blocks.size() + ChunkBlocks - 1) / ChunkBlocks);
  }

  /// The points of a block: lists their places in the cloud and returns their number. `first` is
  /// where they begin if they follow each other; else it is -1.
  int ListPoints(size_t block, unsigned int* places, vtkIdType& first) const
  {
    const Groups& groups = this->Blocks[block];
    const int level = this->Source->Thinning;
    first = level == 0 ? groups.First : -1;
    int count = 0;
    if (level == 0)
    {
      count = static_cast<int>(groups.End - groups.First);
      const auto begin = static_cast<unsigned int>(groups.First);
      for (int i = 0; i < count; ++i)
      {
        places[i] = begin + i;
      }
      return count;
    }
    for (vtkIdType group = groups.First; group < groups.End; ++group)
    {
      const unsigned int place =
        vtkPointThinning::GetPoint(static_cast<unsigned int>(group), level);
      places[count] = place;
      // a group may reach over the range
      count += place >= groups.Range[0] && place < groups.Range[1];
    }
    return count;
  }

  /// Where the arrays of the cloud have the point at a place among all.
  size_t GetOwnPlace(unsigned int place) const
  {
    return place - static_cast<size_t>(this->Source->FirstId);
  }

  unsigned int GetId(size_t ownPlace) const
  {
    const std::vector<unsigned int>& ids = this->Source->Projection->Points->GetOrder().GetIds();
    return ids[ownPlace] + static_cast<unsigned int>(this->Source->FirstId);
  }

  std::array<float, 4> GetColor(size_t ownPlace) const
  {
    const vtkPointProjectionCPU& cloud = *this->Source->Projection;
    return cloud.Colors ? cloud.GetColor(ownPlace) : this->Source->Color;
  }

  float GetRadius(size_t ownPlace) const
  {
    const vtkPointProjectionCPU& cloud = *this->Source->Projection;
    return cloud.Radii ? cloud.Radii[ownPlace]
                       : static_cast<float>(cloud.Points->GetUniformRadius());
  }

  /// Positions about the origin, of points as ListPoints() tells them.
  void LoadPositions(Block& block, vtkIdType first, int count, const unsigned int* ownPlaces) const
  {
    const vtkPointProjectionCPU& cloud = *this->Source->Projection;
    const double* origin = cloud.Origin.data();
    cloud.FloatPositions ? Load(block, first, count, cloud.FloatPositions, ownPlaces, origin)
                         : Load(block, first, count, cloud.DoublePositions, ownPlaces, origin);
  }

  /// The same of normals, zero where the cloud has none.
  void LoadNormals(Block& block, vtkIdType first, int count, const unsigned int* ownPlaces) const
  {
    const vtkPointProjectionCPU& cloud = *this->Source->Projection;
    const double zero[3] = { 0.0, 0.0, 0.0 };
    if (cloud.Normals)
    {
      Load(block, first, count, cloud.Normals, ownPlaces, zero);
    }
    else
    {
      block = {};
    }
  }

  /// Of points whose positions in eye coordinates and pixels are known.
  void FetchFootprints(const vtkPointProjectionOptions& options, const unsigned int* ownPlaces,
    int count, Footprints& points) const
  {
    this->LoadNormals(points.Normals, -1, count, ownPlaces);
    for (int i = 0; i < count; ++i)
    {
      points.Radii[i] = this->GetRadius(ownPlaces[i]);
    }
    FindFootprints(points, count, this->View, options);
  }
};

//------------------------------------------------------------------------------
void vtkPointProjectionCPU::Draw(const std::vector<Cloud>& clouds,
  const vtkPointProjectionOptions& options, vtkSurfaceImage& image, vtkSurfaceImage* nearest)
{
  const vtkSurfaceImage::Rectangle& r = image.GetRectangle();
  const size_t size = static_cast<size_t>(r[2] - r[0]) * (r[3] - r[1]);
  if (this->NearestSize < size)
  {
    this->Nearest.reset(new std::atomic<std::uint64_t>[size]);
    this->NearestSize = size;
  }
  vtkSMPTools::For(0, static_cast<vtkIdType>(size),
    [this](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        this->Nearest[i].store(NoPoint, std::memory_order_relaxed);
      }
    });
  if (nearest)
  {
    this->SetLimits(*nearest, options.DepthTolerance);
  }
  const std::vector<Part> parts = MakeParts(clouds);
  for (const Part& part : parts)
  {
    nearest ? this->FindFarthestPoints(part) : this->FindVisiblePoints(part);
  }
  this->Limits.resize(size);
  this->FetchVisiblePoints(parts, options, image);
  if (options.AveragePoints)
  {
    this->AveragePoints(parts, options, image);
  }
}

std::vector<vtkPointProjectionCPU::Part> vtkPointProjectionCPU::MakeParts(
  const std::vector<Cloud>& clouds)
{
  std::vector<Part> parts;
  for (const Cloud& cloud : clouds)
  {
    parts.push_back({ &cloud, cloud.Projection->GetTransform(cloud.View), {} });
    for (const auto& range : cloud.View.Ranges)
    {
      const vtkIdType end = ((range[1] - 1) >> cloud.Thinning) + 1;
      for (vtkIdType first = range[0] >> cloud.Thinning; first < end; first += BlockSize)
      {
        parts.back().Blocks.push_back(
          { first, std::min<vtkIdType>(first + BlockSize, end), range });
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

int vtkPointProjectionCPU::GetNumberOfBands(const Transform& transform)
{
  return (transform.Rectangle[3] + BandRows - 1) / BandRows;
}

/// The points of a block that something is done with.
struct vtkPointProjectionCPU::BlockPoints
{
  Block Positions;                    // in eye coordinates
  unsigned int Places[BlockSize + 1]; // in the cloud
  int Pixels[BlockSize];              // of the rectangle
  float Depths[BlockSize];
  int List[BlockSize]; // those that are wanted, in their order
  int Count;           // of them
};

/// Calls take(chunk, points) for the blocks of some chunks of a part, with their points that fall
/// into the rectangle and that isWanted(pixel, depth, place) is true of; the blocks of a chunk in
/// their order and from one thread. `place` is among the points of all clouds.
template <typename IsWanted, typename Take>
void vtkPointProjectionCPU::ForSeenBlocks(
  const Part& part, int firstChunk, int endChunk, const IsWanted& isWanted, const Take& take)
{
  const auto firstId = static_cast<unsigned int>(part.Source->FirstId);
  const bool culls = part.View.Cull != vtkPointSurfaceView::NoCulling;
  auto drawChunk = [&](vtkIdType chunk)
  {
    BlockPoints points;
    Block normals;
    const size_t end = std::min(part.Blocks.size(), static_cast<size_t>(chunk + 1) * ChunkBlocks);
    for (size_t block = static_cast<size_t>(chunk) * ChunkBlocks; block < end; ++block)
    {
      vtkIdType first;
      const int size = part.ListPoints(block, points.Places, first);
      part.LoadPositions(points.Positions, first, size, points.Places);
      if (culls)
      {
        part.LoadNormals(normals, first, size, points.Places);
      }
      ProjectBlock(points.Positions, normals, size, part.View, points.Pixels, points.Depths);
      // without branches that half of the points would take
      int count = 0;
      for (int i = 0; i < size; ++i)
      {
        const int pixel = points.Pixels[i];
        const bool isSeen = pixel >= 0;
        points.List[count] = i;
        count +=
          isSeen & isWanted(isSeen ? pixel : 0, points.Depths[i], firstId + points.Places[i]);
      }
      points.Count = count;
      if (count > 0)
      {
        take(static_cast<int>(chunk), points);
      }
    }
  };
  vtkSMPTools::For(firstChunk, endChunk, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType chunk = begin; chunk < end; ++chunk)
      {
        drawChunk(chunk);
      }
    });
}

void vtkPointProjectionCPU::SetLimits(vtkSurfaceImage& nearest, float tolerance)
{
  const vtkSurfaceImage::Rectangle& r = nearest.GetRectangle();
  this->Limits.clear();
  for (int y = r[1]; y < r[3]; ++y)
  {
    const float* radii = nearest.GetRow(y, vtkSurfaceImage::Radius);
    const float* depths = nearest.GetRow(y, vtkSurfaceImage::IntervalX);
    for (int x = r[0]; x < r[2]; ++x)
    {
      this->Limits.push_back(radii[x] > 0.0f ? depths[x] + tolerance : -VTK_FLOAT_MAX);
    }
  }
}

namespace
{
void KeepLeast(std::atomic<std::uint64_t>& least, std::uint64_t key)
{
  std::uint64_t old = least.load(std::memory_order_relaxed);
  while (key < old && !least.compare_exchange_weak(old, key, std::memory_order_relaxed))
  {
  }
}
}

void vtkPointProjectionCPU::FindVisiblePoints(const Part& part)
{
  const auto firstId = static_cast<unsigned int>(part.Source->FirstId);
  std::atomic<std::uint64_t>* nearest = this->Nearest.get();
  ForSeenBlocks(
    part, 0, part.GetNumberOfChunks(),
    [nearest](int pixel, float depth, unsigned int place)
    { return MakeKey(depth, place) < nearest[pixel].load(std::memory_order_relaxed); },
    [nearest, firstId](int, const BlockPoints& points)
    {
      for (int k = 0; k < points.Count; ++k)
      {
        const int i = points.List[k];
        KeepLeast(nearest[points.Pixels[i]], MakeKey(points.Depths[i], firstId + points.Places[i]));
      }
    });
}

/// The same for the farthest points that are within the limits.
void vtkPointProjectionCPU::FindFarthestPoints(const Part& part)
{
  const auto firstId = static_cast<unsigned int>(part.Source->FirstId);
  const float* limits = this->Limits.data();
  std::atomic<std::uint64_t>* nearest = this->Nearest.get();
  ForSeenBlocks(
    part, 0, part.GetNumberOfChunks(),
    [limits](int pixel, float depth, unsigned int) { return depth <= limits[pixel]; },
    [nearest, firstId](int, const BlockPoints& points)
    {
      for (int k = 0; k < points.Count; ++k)
      {
        const int i = points.List[k];
        KeepLeast(
          nearest[points.Pixels[i]], MakeKey(-points.Depths[i], firstId + points.Places[i]));
      }
    });
}

//------------------------------------------------------------------------------
void vtkPointProjectionCPU::FetchVisiblePoints(
  const std::vector<Part>& parts, const vtkPointProjectionOptions& options, vtkSurfaceImage& image)
{
  const vtkSurfaceImage::Rectangle& r = image.GetRectangle();
  vtkSMPTools::For(0, GetNumberOfBands(parts.front().View), 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int band = static_cast<int>(begin); band < end; ++band)
      {
        const int first = r[1] + band * BandRows;
        const int last = std::min(first + BandRows, r[3]);
        for (int y = first; y < last; ++y)
        {
          image.ClearBlocks(y, image.GetBlockBegin(), image.GetBlockEnd());
        }
        // in the order of space points of neighbouring rows are near each other
        for (int x = r[0]; x < r[2]; x += StripColumns)
        {
          for (int y = first; y < last; ++y)
          {
            this->FetchPixels(parts, options, x, std::min(x + StripColumns, r[2]), y, image);
          }
        }
      }
    });
}

/// Columns [x, end) of a row.
void vtkPointProjectionCPU::FetchPixels(const std::vector<Part>& parts,
  const vtkPointProjectionOptions& options, int x, int end, int y, vtkSurfaceImage& image)
{
  const vtkSurfaceImage::Rectangle& r = image.GetRectangle();
  const size_t firstPixel = static_cast<size_t>(y - r[1]) * (r[2] - r[0]);
  Footprints points;
  unsigned int places[BlockSize]; // in the cloud
  while (x < end)
  {
    // those of one cloud that follow each other
    const Part* part = nullptr;
    int count = 0;
    for (; x < end && count < BlockSize; ++x)
    {
      const std::uint64_t key =
        this->Nearest[firstPixel + x - r[0]].load(std::memory_order_relaxed);
      if (key == NoPoint)
      {
        continue;
      }
      const Part* own = &GetPart(parts, GetPlace(key));
      if (part && part != own)
      {
        break;
      }
      part = own;
      points.Columns[count] = x;
      points.Rows[count] = y;
      places[count] = static_cast<unsigned int>(part->GetOwnPlace(GetPlace(key)));
      ++count;
    }
    if (count > 0)
    {
      part->LoadPositions(points.Positions, -1, count, places);
      BringToEye(points.Positions, count, part->View);
      part->FetchFootprints(options, places, count, points);
      this->WriteFootprints(*part, options, places, count, points, image);
    }
  }
}

//------------------------------------------------------------------------------
/// Points that share pixels of the rectangle with nearer ones, within reach of these.
struct vtkPointProjectionCPU::Companions
{
  struct Point
  {
    int Pixel; // of the rectangle
    float Values[vtkSurfaceImage::NumberOfShapePlanes];
  };
  std::vector<Point> Points;
  std::vector<std::array<float, 4>> Colors; // where the layer is wanted
};

/// What the points of a band of rows add up to, in the pixels that have several.
struct vtkPointProjectionCPU::BandSums
{
  struct Sum
  {
    int Pixel; // of the rectangle
    float FrontNormal[3];
    // of the planes of an image; in the place of IntervalY, which has no mean, their number
    float Values[vtkSurfaceImage::NumberOfPlanes];
  };
  static constexpr int Count = vtkSurfaceImage::IntervalY;
  std::vector<int> Places; // in Sums, of each pixel of the band; -1 for none
  std::vector<Sum> Sums;
};

/// Averages the pixels, which hold their nearest points, with the companions of these. Companions
/// are listed by chunk of points and band of rows: a list is written by one thread and read by
/// one, and what is added up is so in one order, whatever the number of threads.
void vtkPointProjectionCPU::AveragePoints(
  const std::vector<Part>& parts, const vtkPointProjectionOptions& options, vtkSurfaceImage& image)
{
  const int bands = GetNumberOfBands(parts.front().View);
  this->Sums.resize(bands);
  this->Listed.resize(static_cast<size_t>(RoundChunks) * bands);
  const auto forBands = [bands](const std::function<void(int)>& work)
  {
    vtkSMPTools::For(0, bands, 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType band = begin; band < end; ++band)
        {
          work(static_cast<int>(band));
        }
      });
  };
  const size_t bandSize = static_cast<size_t>(BandRows) * parts.front().View.Rectangle[2];
  forBands(
    [&](int band)
    {
      this->Sums[band].Sums.clear();
      this->Sums[band].Places.assign(bandSize, -1);
    });
  for (const Part& part : parts)
  {
    for (int chunk = 0; chunk < part.GetNumberOfChunks(); chunk += RoundChunks)
    {
      this->ListCompanions(part, options, chunk, image);
      forBands([&](int band) { this->AddCompanions(part, band, image); });
    }
  }
  forBands([&](int band) { WriteAverages(this->Sums[band], options, image); });
}

void vtkPointProjectionCPU::ListCompanions(const Part& part,
  const vtkPointProjectionOptions& options, int firstChunk, const vtkSurfaceImage& image)
{
  const int bands = GetNumberOfBands(part.View);
  const int bottom = image.GetRectangle()[1];
  for (Companions& companions : this->Listed)
  {
    companions.Points.clear();
    companions.Colors.clear();
  }
  const std::atomic<std::uint64_t>* nearest = this->Nearest.get();
  const float* limits = this->Limits.data();
  ForSeenBlocks(
    part, firstChunk, std::min(firstChunk + RoundChunks, part.GetNumberOfChunks()),
    [nearest, limits](int pixel, float depth, unsigned int place)
    {
      const std::uint64_t key = nearest[pixel].load(std::memory_order_relaxed);
      return (GetPlace(key) != place) & (depth <= limits[pixel]);
    },
    [&](int chunk, const BlockPoints& seen)
    {
      int pixels[BlockSize];
      unsigned int places[BlockSize];
      Footprints points;
      for (int k = 0; k < seen.Count; ++k)
      {
        const int i = seen.List[k];
        pixels[k] = seen.Pixels[i];
        places[k] = seen.Places[i];
        points.Positions.X[k] = seen.Positions.X[i];
        points.Positions.Y[k] = seen.Positions.Y[i];
        points.Positions.Z[k] = seen.Positions.Z[i];
      }
      SplitPixels(pixels, seen.Count, image.GetRectangle(), points.Columns, points.Rows);
      part.FetchFootprints(options, places, seen.Count, points);
      Companions* listed = &this->Listed[static_cast<size_t>(chunk - firstChunk) * bands];
      for (int k = 0; k < seen.Count; ++k)
      {
        Companions& companions = listed[(points.Rows[k] - bottom) / BandRows];
        companions.Points.push_back({ pixels[k],
          { points.Normals.X[k], points.Normals.Y[k], points.Normals.Z[k], points.Radii[k],
            -points.Positions.Z[k], 1.0f, points.CenterX[k], points.CenterY[k] } });
        if (image.HasColors())
        {
          companions.Colors.push_back(part.GetColor(places[k]));
        }
      }
    });
}

void vtkPointProjectionCPU::AddCompanions(const Part& part, int band, vtkSurfaceImage& image)
{
  const vtkSurfaceImage::Rectangle& r = image.GetRectangle();
  const int width = r[2] - r[0];
  const int firstPixel = band * BandRows * width;
  const size_t plane = image.GetPlaneStride();
  const bool twoSided = part.View.Cull == vtkPointSurfaceView::NoCulling;
  const size_t bands = this->Sums.size();
  BandSums& bandSums = this->Sums[band];
  for (size_t list = band; list < this->Listed.size(); list += bands)
  {
    const Companions& companions = this->Listed[list];
    for (size_t i = 0; i < companions.Points.size(); ++i)
    {
      const Companions::Point& point = companions.Points[i];
      int& index = bandSums.Places[point.Pixel - firstPixel];
      if (index < 0)
      {
        index = static_cast<int>(bandSums.Sums.size());
        bandSums.Sums.push_back({});
        BandSums::Sum& sum = bandSums.Sums.back();
        sum.Pixel = point.Pixel;
        const int row = point.Pixel / width;
        const float* pixel = image.GetRow(r[1] + row, 0) + r[0] + point.Pixel - row * width;
        for (int k = 0; k < image.GetNumberOfPlanes(); ++k)
        {
          sum.Values[k] = pixel[k * plane];
        }
        sum.Values[BandSums::Count] = 1.0f;
        std::copy_n(sum.Values, 3, sum.FrontNormal);
      }
      BandSums::Sum& sum = bandSums.Sums[index];
      const float alike = point.Values[0] * sum.FrontNormal[0] +
        point.Values[1] * sum.FrontNormal[1] + point.Values[2] * sum.FrontNormal[2];
      // it is turned as the nearest one is
      const float side = twoSided & (alike < 0.0f) ? -1.0f : 1.0f;
      const float sides[vtkSurfaceImage::NumberOfShapePlanes] = { side, side, side, 1.0f, 1.0f,
        1.0f, 1.0f, 1.0f };
      for (int k = 0; k < vtkSurfaceImage::NumberOfShapePlanes; ++k)
      {
        sum.Values[k] += sides[k] * point.Values[k];
      }
      for (int k = 0; image.HasColors() && k < 4; ++k)
      {
        sum.Values[vtkSurfaceImage::Red + k] += companions.Colors[i][k];
      }
    }
  }
}

void vtkPointProjectionCPU::WriteAverages(
  const BandSums& bandSums, const vtkPointProjectionOptions& options, vtkSurfaceImage& image)
{
  const vtkSurfaceImage::Rectangle& r = image.GetRectangle();
  const int width = r[2] - r[0];
  const size_t plane = image.GetPlaneStride();
  const int planes = image.GetNumberOfPlanes();
  for (const BandSums::Sum& sum : bandSums.Sums)
  {
    const float* n = sum.Values;
    const float size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    const bool cancels = size < 1e-6f;
    const int row = sum.Pixel / width;
    float* pixel = image.GetRow(r[1] + row, 0) + r[0] + sum.Pixel - row * width;
    const float nearest = pixel[vtkSurfaceImage::IntervalX * plane];
    for (int k = 0; k < 3; ++k)
    {
      pixel[k * plane] = cancels ? sum.FrontNormal[k] : n[k] / size;
    }
    for (int k = 3; k < planes; ++k)
    {
      const bool isInterval = k == vtkSurfaceImage::IntervalX || k == vtkSurfaceImage::IntervalY;
      if (!isInterval)
      {
        pixel[k * plane] = sum.Values[k] / sum.Values[BandSums::Count];
      }
    }
    if (options.CenterDepths)
    {
      const float mean = sum.Values[vtkSurfaceImage::IntervalX] / sum.Values[BandSums::Count];
      pixel[vtkSurfaceImage::IntervalX * plane] = mean;
      pixel[vtkSurfaceImage::IntervalY * plane] = mean - nearest;
    }
  }
}

//------------------------------------------------------------------------------
void vtkPointProjectionCPU::WriteFootprints(const Part& part,
  const vtkPointProjectionOptions& options, const unsigned int* places, int count,
  const Footprints& points, vtkSurfaceImage& image)
{
  const vtkSurfaceImage::Rectangle& r = image.GetRectangle();
  const size_t plane = image.GetPlaneStride();
  for (int i = 0; i < count; ++i)
  {
    const int x = points.Columns[i];
    const int y = points.Rows[i];
    const float depth = -points.Positions.Z[i];
    if (options.AveragePoints)
    {
      this->Limits[static_cast<size_t>(y - r[1]) * (r[2] - r[0]) + x - r[0]] =
        depth + points.Reaches[i];
    }
    image.GetOccupied(y)[x / vtkSurfaceImage::BlockSize] = 1;
    float* pixel = image.GetRow(y, 0) + x;
    pixel[vtkSurfaceImage::NormalX * plane] = points.Normals.X[i];
    pixel[vtkSurfaceImage::NormalY * plane] = points.Normals.Y[i];
    pixel[vtkSurfaceImage::NormalZ * plane] = points.Normals.Z[i];
    pixel[vtkSurfaceImage::Radius * plane] = points.Radii[i];
    pixel[vtkSurfaceImage::IntervalX * plane] = depth;
    pixel[vtkSurfaceImage::IntervalY * plane] =
      options.CenterDepths ? 0.0f : depth + points.Radii[i];
    pixel[vtkSurfaceImage::CenterX * plane] = points.CenterX[i];
    pixel[vtkSurfaceImage::CenterY * plane] = points.CenterY[i];
    if (image.HasIds())
    {
      image.GetIds(y)[x] = part.GetId(places[i]) + 1;
    }
    if (image.HasColors())
    {
      const std::array<float, 4> color = part.GetColor(places[i]);
      for (int k = 0; k < 4; ++k)
      {
        pixel[(vtkSurfaceImage::Red + k) * plane] = color[k];
      }
    }
  }
}

std::array<float, 4> vtkPointProjectionCPU::GetColor(size_t place) const
{
  std::array<float, 4> color = { 0.0f, 0.0f, 0.0f, 1.0f };
  const int size = this->Colors->GetNumberOfComponents();
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
  const vtkPointProjectionCPU& cloud = *part.Source->Projection;
  const std::vector<unsigned int>& ids = cloud.Points->GetOrder().GetIds();
  const auto firstId = static_cast<unsigned int>(part.Source->FirstId);
  unsigned int places[BlockSize + 1];
  Block positions;
  Block normals;
  float radii[BlockSize];
  int seen[BlockSize];
  vtkIdType first;
  const int count = part.ListPoints(this->Blocks[index][1], places, first);
  part.LoadPositions(positions, first, count, places);
  part.LoadNormals(normals, first, count, places);
  for (int i = 0; i < count; ++i)
  {
    radii[i] = part.GetRadius(places[i]);
  }
  TransformBlock(positions, normals, radii, count, part.View, this->ClippingReach, points, seen);
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
    points.Place[to] = firstId + places[i];
    points.Id[to] = firstId + ids[places[i]];
    points.Count += seen[i];
  }
}

std::array<float, 4> vtkPointProjectionCPU::EyeBlocks::GetColor(unsigned int place) const
{
  const Part& part = GetPart(this->Parts, place);
  return part.GetColor(part.GetOwnPlace(place));
}
