// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDirectReconstructionCPU.h"

#include "vtkDirectParameters.h"
#include "vtkPointSurfaceVectorize.h"
#include "vtkSurfaceImage.h"
#include "vtkSurfacePixels.h"
#include "vtkSurfaceTarget.h"

#include "vtkSMPTools.h"
#include "vtkType.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
using Cell = vtkDirectReconstructionCPU::Cell;
using Cells = std::vector<Cell>;

/// Rows of the surface buffer that a thread draws splats to at a time.
constexpr int BandHeight = 32;

/// Where the cells of a level lie in memory.
class Grid
{
public:
  Grid(const vtkDirectParameters::Level& level, Cells& cells)
    : R(level.Rectangle)
    , First(cells.data())
  {
  }
  bool Contains(int x, int y) const
  {
    return x >= this->R[0] && y >= this->R[1] && x < this->R[2] && y < this->R[3];
  }
  Cell* At(int x, int y) const
  {
    return this->First + static_cast<size_t>(y - this->R[1]) * (this->R[2] - this->R[0]) + x -
      this->R[0];
  }
  /// The cell if it is in the grid and occupied; else nullptr.
  Cell* Occupied(int x, int y) const
  {
    Cell* cell = this->Contains(x, y) ? this->At(x, y) : nullptr;
    return cell && cell->IsOccupied() ? cell : nullptr;
  }

private:
  std::array<int, 4> R;
  Cell* First;
};

float GetEyeCell(const vtkDirectParameters& p, float depth)
{
  return std::max(p.CellToEye[0], p.CellToEye[1]) * (p.CellToEye[2] * depth + p.CellToEye[3]);
}

/// The position of a projected point in eye coordinates.
void GetPosition(const vtkDirectParameters& p, vtkSurfaceImage& image, int x, int y, float* out)
{
  const float depth = image.GetRow(y, vtkSurfaceImage::IntervalX)[x];
  const float place[2] = { x + 0.5f + image.GetRow(y, vtkSurfaceImage::CenterX)[x],
    y + 0.5f + image.GetRow(y, vtkSurfaceImage::CenterY)[x] };
  for (int k = 0; k < 2; ++k)
  {
    out[k] = p.EyeRay[2 + k] + place[k] * p.EyeRayStep[2 + k] +
      depth * (p.EyeRay[k] + place[k] * p.EyeRayStep[k]);
  }
  out[0] -= p.Shear * out[1];
  out[2] = -depth;
}

void LoadCell(const vtkDirectParameters& p, vtkSurfaceImage& nearest, vtkSurfaceImage& farthest,
  const std::vector<unsigned char>& copies, int x, int y, Cell& cell)
{
  cell = Cell{};
  if (!(nearest.GetRow(y, vtkSurfaceImage::Radius)[x] > 0.0f))
  {
    return;
  }
  GetPosition(p, nearest, x, y, cell.Nearest);
  vtkSurfaceImage& second = p.Options.FarthestPoints ? farthest : nearest;
  GetPosition(p, second, x, y, cell.Farthest);
  cell.Open = 1;
  cell.Id = nearest.HasIds() ? nearest.GetIds(y)[x] : 0;
  cell.IsCopy = !copies.empty() && copies[cell.Id - 1] != 0;
  for (int k = 0; k < 4 && nearest.HasColors(); ++k)
  {
    const int plane = vtkSurfaceImage::Red + k;
    cell.Color[k] = 0.5f * (nearest.GetRow(y, plane)[x] + second.GetRow(y, plane)[x]);
  }
}

/// Merges up to four cells of the next finer level: their nearest point, and of their points
/// within the tolerance of it the farthest.
void MergeCell(const vtkDirectParameters& p, const Grid& fine, int x, int y, int level, Cell& cell)
{
  cell = Cell{};
  const Cell* children[4];
  const Cell* front = nullptr;
  for (int i = 0; i < 4; ++i)
  {
    children[i] = fine.Occupied(2 * x + (i & 1), 2 * y + (i >> 1));
    if (children[i] && (!front || children[i]->Nearest[2] > front->Nearest[2]))
    {
      front = children[i];
    }
  }
  if (!front)
  {
    return;
  }
  cell.Id = front->Id;
  cell.IsCopy = front->IsCopy;
  std::copy_n(front->Nearest, 3, cell.Nearest);
  std::copy_n(front->Nearest, 3, cell.Farthest);
  const float tolerance = std::max(p.Gamma, (1 << level) * GetEyeCell(p, -front->Nearest[2]));
  float count = 0.0f;
  for (const Cell* child : children)
  {
    if (!child)
    {
      continue;
    }
    cell.Open |= child->Open;
    for (const float* point : { child->Nearest, child->Farthest })
    {
      if (point[2] < cell.Farthest[2] && point[2] >= front->Nearest[2] - tolerance)
      {
        std::copy_n(point, 3, cell.Farthest);
      }
    }
    if (child->Nearest[2] >= front->Nearest[2] - tolerance)
    {
      count += 1.0f;
      for (int k = 0; k < 4; ++k)
      {
        cell.Color[k] += child->Color[k];
      }
    }
  }
  for (float& component : cell.Color)
  {
    component /= count;
  }
}

/// Occupied cells of the 9 around one, itself counted, that are not far behind it: through a gap in
/// a surface its back shows.
int CountNeighbors(const vtkDirectParameters& p, const Grid& grid, int x, int y)
{
  const float depth = -grid.At(x, y)->Nearest[2];
  const float limit =
    depth + std::max(p.Gamma, vtkDirectParameters::NeighborDepth * GetEyeCell(p, depth));
  int count = 0;
  for (int i = 0; i < 9; ++i)
  {
    const Cell* neighbor = grid.Occupied(x - 1 + i % 3, y - 1 + i / 3);
    count += neighbor && -neighbor->Nearest[2] <= limit ? 1 : 0;
  }
  return count;
}

/// The points of the cells around one, about the mean of its own two points and in cells.
struct Neighborhood
{
  static constexpr int Capacity = 2 * 7 * 7;
  alignas(32) float X[Capacity], Y[Capacity], Z[Capacity], Weight[Capacity];
  int Count = 0;
};

/// The plane z = a x + b y + c.
struct Plane
{
  float A = 0.0f, B = 0.0f, C = 0.0f;
};

/// Fits a plane by least squares to those of the points that lie within a distance of the plane
/// that is there, along z. Returns false, and leaves the plane, where they lie on a line, seen from
/// the eye.
VTK_POINT_SURFACE_CLONES
bool FitPlane(const Neighborhood& points, float distance, Plane& plane)
{
  float w = 0.0f, x = 0.0f, y = 0.0f, z = 0.0f;
  float xx = 0.0f, xy = 0.0f, yy = 0.0f, xz = 0.0f, yz = 0.0f;
  for (int i = 0; i < points.Count; ++i)
  {
    const float px = points.X[i];
    const float py = points.Y[i];
    const float pz = points.Z[i];
    const float away = std::abs(pz - plane.A * px - plane.B * py - plane.C);
    const float weight = away <= distance ? points.Weight[i] : 0.0f;
    w += weight;
    x += weight * px;
    y += weight * py;
    z += weight * pz;
    xx += weight * px * px;
    xy += weight * px * py;
    yy += weight * py * py;
    xz += weight * px * pz;
    yz += weight * py * pz;
  }
  if (!(w > 0.0f))
  {
    return false;
  }
  xx -= x * x / w;
  xy -= x * y / w;
  yy -= y * y / w;
  xz -= x * z / w;
  yz -= y * z / w;
  const float determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-3f * (xx + yy) * (xx + yy)))
  {
    return false;
  }
  plane.A = (xz * yy - yz * xy) / determinant;
  plane.B = (yz * xx - xz * xy) / determinant;
  plane.C = (z - plane.A * x - plane.B * y) / w;
  return true;
}

void GatherPoints(const vtkDirectParameters& p, const Grid& grid, int x, int y, float scale,
  const float* mean, Neighborhood& points)
{
  const float perRadius2 = 1.0f / (vtkDirectParameters::FitRadius * vtkDirectParameters::FitRadius);
  const int reach = p.GetFitReach();
  for (int j = y - reach; j <= y + reach; ++j)
  {
    for (int i = x - reach; i <= x + reach; ++i)
    {
      const Cell* neighbor = grid.Occupied(i, j);
      if (!neighbor)
      {
        continue;
      }
      for (const float* point : { neighbor->Nearest, neighbor->Farthest })
      {
        const int k = points.Count;
        const float dx = points.X[k] = scale * (point[0] - mean[0]);
        const float dy = points.Y[k] = scale * (point[1] - mean[1]);
        points.Z[k] = scale * (point[2] - mean[2]);
        const float near = std::max(0.0f, 1.0f - (dx * dx + dy * dy) * perRadius2);
        points.Weight[k] = p.Options.WeightedNormals ? near * near : 1.0f;
        points.Count += points.Weight[k] > 0.0f ? 1 : 0;
      }
    }
  }
}

/// The slope along an axis of a surface that is seen at a grazing angle, and goes on to both sides
/// of a cell; else 0. At the edge of a surface one step is much larger than the other.
float GetSteepSlope(const Grid& grid, int x, int y, int axis, float scale)
{
  const int dx = axis == 0 ? 1 : 0;
  const int dy = 1 - dx;
  const Cell* before = grid.Occupied(x - dx, y - dy);
  const Cell* after = grid.Occupied(x + dx, y + dy);
  if (!before || !after)
  {
    return 0.0f;
  }
  const float middle = grid.At(x, y)->Nearest[2];
  const float steps[2] = { scale * (middle - before->Nearest[2]),
    scale * (after->Nearest[2] - middle) };
  const float least = std::min(std::abs(steps[0]), std::abs(steps[1]));
  const float rise = steps[0] + steps[1];
  const float run = scale * (after->Nearest[axis] - before->Nearest[axis]);
  const bool goesOn =
    steps[0] * steps[1] > 0.0f && std::abs(rise) <= vtkDirectParameters::EvenSteps * least;
  return goesOn && least >= vtkDirectParameters::SteepStep && run > 0.0f ? rise / run : 0.0f;
}

/// Gives the cell its normal and the mean of its two points.
void FitNormal(const vtkDirectParameters& p, const Grid& grid, int x, int y, int level, Cell& cell)
{
  float mean[3];
  for (int k = 0; k < 3; ++k)
  {
    mean[k] = 0.5f * (cell.Nearest[k] + cell.Farthest[k]);
  }
  const float scale = 1.0f / ((1 << level) * GetEyeCell(p, -mean[2]));
  Neighborhood points;
  GatherPoints(p, grid, x, y, scale, mean, points);
  Plane plane;
  bool fits;
  if (p.Options.WeightedNormals)
  {
    plane.A = GetSteepSlope(grid, x, y, 0, scale);
    plane.B = GetSteepSlope(grid, x, y, 1, scale);
    const float gamma = p.Gamma * scale;
    fits = FitPlane(points, std::max(gamma, vtkDirectParameters::FitDepth), plane);
    fits = fits && FitPlane(points, std::max(gamma, vtkDirectParameters::RefitDepth), plane);
  }
  else
  {
    fits = FitPlane(points, VTK_FLOAT_MAX, plane);
  }

  const bool parallel = p.ImageView.IsParallel();
  float normal[3] = { -plane.A, -plane.B, 1.0f };
  if (!fits && plane.A == 0.0f && plane.B == 0.0f && !parallel)
  {
    std::transform(mean, mean + 3, normal, [](float m) { return -m; });
  }
  const float towards =
    parallel ? normal[2] : -(normal[0] * mean[0] + normal[1] * mean[1] + normal[2] * mean[2]);
  const float length = std::copysign(
    std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]), towards);
  cell.Depth = -mean[2];
  for (int k = 0; k < 3; ++k)
  {
    cell.Normal[k] = normal[k] / length;
  }
  const float straight[2] = { mean[0] + p.Shear * mean[1], mean[1] };
  for (int k = 0; k < 2; ++k)
  {
    const float place = (straight[k] - p.EyeRay[2 + k] - cell.Depth * p.EyeRay[k]) /
      (p.EyeRayStep[2 + k] + cell.Depth * p.EyeRayStep[k]);
    cell.Place[k] = place / p.PixelToCell[k];
  }
}

void MakeSplat(const vtkDirectParameters& p, const Grid& grid, int x, int y, int level, Cell& cell)
{
  if (!cell.IsOccupied() || !cell.Open)
  {
    return;
  }
  const bool enough = !p.Options.AdaptiveResolution ||
    CountNeighbors(p, grid, x, y) >= vtkDirectParameters::EnoughNeighbors;
  if (!enough && level < p.GetCoarsestLevel())
  {
    return; // left to the next level
  }
  cell.Open = 0;
  cell.Splats = 1;
  FitNormal(p, grid, x, y, level, cell);
  for (int k = 0; k < 2; ++k)
  {
    // a point far from all others stays small
    cell.Radius[k] =
      vtkDirectParameters::SplatRadius * (enough ? 1 << level : 1) / p.PixelToCell[k];
  }
}

template <typename Functor>
void ForCells(const vtkDirectParameters::Level& level, Cells& cells, const Functor& functor)
{
  const auto& r = level.Rectangle;
  const Grid grid(level, cells);
  vtkSMPTools::For(r[1], r[3], 8,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int y = static_cast<int>(begin); y < end; ++y)
      {
        for (int x = r[0]; x < r[2]; ++x)
        {
          functor(x, y, *grid.At(x, y));
        }
      }
    });
}
}

//------------------------------------------------------------------------------
void vtkDirectReconstructionCPU::FitNormals(const vtkDirectParameters& p, vtkSurfaceImage& nearest,
  vtkSurfaceImage& farthest, const std::vector<unsigned char>& copies)
{
  this->Levels.resize(p.Levels.size());
  for (int level = 0; level <= p.GetCoarsestLevel(); ++level)
  {
    const auto& extent = p.Levels[level];
    const auto& r = extent.Rectangle;
    Cells& cells = this->Levels[level];
    cells.resize(static_cast<size_t>(r[2] - r[0]) * (r[3] - r[1]));
    if (level == 0)
    {
      ForCells(extent, cells,
        [&](int x, int y, Cell& cell) { LoadCell(p, nearest, farthest, copies, x, y, cell); });
    }
    else
    {
      const Grid fine(p.Levels[level - 1], this->Levels[level - 1]);
      ForCells(
        extent, cells, [&](int x, int y, Cell& cell) { MergeCell(p, fine, x, y, level, cell); });
    }
    const Grid grid(extent, cells);
    ForCells(
      extent, cells, [&](int x, int y, Cell& cell) { MakeSplat(p, grid, x, y, level, cell); });
  }
}

//------------------------------------------------------------------------------
namespace
{
/// The splats of a band of rows.
class Band
{
public:
  Band(const vtkDirectParameters& parameters, int begin, int end, vtkSurfacePixels& pixels)
    : P(parameters)
    , Begin(begin)
    , End(end)
    , Left(parameters.Rectangle[0])
    , Width(parameters.Rectangle[2] - parameters.Rectangle[0])
    , Pixels(pixels)
    , Front(static_cast<size_t>(end - begin) * this->Width, std::numeric_limits<float>::max())
    , Weights(this->Front.size(), 0.0f)
    , LargestWeights(pixels.Id.empty() ? 0 : this->Front.size(), 0.0f)
    , Kernel(this->Width)
    , Depths(this->Width)
  {
    const size_t first = static_cast<size_t>(begin - parameters.Rectangle[1]) * this->Width;
    this->Offset = first;
    std::fill_n(pixels.Surface.begin() + 4 * first, 4 * this->Front.size(), 0.0f);
    if (!pixels.Id.empty())
    {
      std::fill_n(pixels.Id.begin() + first, this->Front.size(), 0u);
    }
    if (!pixels.Color.empty())
    {
      std::fill_n(pixels.Color.begin() + 4 * first, 4 * this->Front.size(), 0.0f);
    }
  }

  void FindFront(const Cell& cell)
  {
    if (cell.IsCopy)
    {
      return;
    }
    this->ForRows(cell,
      [&](int row, int begin, int end)
      {
        float* front = &this->Front[static_cast<size_t>(row - this->Begin) * this->Width];
        for (int x = begin; x < end; ++x)
        {
          const float depth = this->Kernel[x] > 0.0f ? this->Depths[x] : front[x];
          front[x] = std::min(front[x], depth);
        }
      });
  }

  void Accumulate(const Cell& cell)
  {
    const float tolerance = std::max(this->P.Gamma, this->GetEyeRadius(cell));
    const bool tests = this->P.Options.DepthTestInSplats;
    this->ForRows(cell,
      [&](int row, int begin, int end)
      {
        const size_t first = static_cast<size_t>(row - this->Begin) * this->Width;
        for (int x = begin; x < end; ++x)
        {
          const float weight = this->Kernel[x];
          const float depth = this->Depths[x];
          const float front = this->Front[first + x];
          const bool counts = weight > 0.0f && (!tests || depth <= front + tolerance);
          if (!counts || (cell.IsCopy && depth < front - tolerance))
          {
            continue;
          }
          const size_t pixel = this->Offset + first + x;
          this->Weights[first + x] += weight;
          float* surface = &this->Pixels.Surface[4 * pixel];
          surface[0] += weight * cell.Normal[0];
          surface[1] += weight * cell.Normal[1];
          surface[2] += weight * cell.Normal[2];
          surface[3] += weight * depth;
          if (!this->Pixels.Color.empty())
          {
            for (int k = 0; k < 4; ++k)
            {
              this->Pixels.Color[4 * pixel + k] += weight * cell.Color[k];
            }
          }
          if (!this->Pixels.Id.empty() && weight > this->LargestWeights[first + x])
          {
            this->LargestWeights[first + x] = weight;
            this->Pixels.Id[pixel] = cell.Id;
          }
        }
      });
  }

  void Normalize()
  {
    for (size_t i = 0; i < this->Weights.size(); ++i)
    {
      const float weight = this->Weights[i];
      if (!(weight > 0.0f))
      {
        continue;
      }
      float* surface = &this->Pixels.Surface[4 * (this->Offset + i)];
      const float length = std::max(1e-20f,
        std::sqrt(surface[0] * surface[0] + surface[1] * surface[1] + surface[2] * surface[2]));
      for (int k = 0; k < 3; ++k)
      {
        surface[k] /= length;
      }
      surface[3] /= weight;
      for (int k = 0; k < 4 && !this->Pixels.Color.empty(); ++k)
      {
        this->Pixels.Color[4 * (this->Offset + i) + k] /= weight;
      }
    }
  }

private:
  float GetEyeRadius(const Cell& cell) const
  {
    return cell.Radius[0] * this->P.PixelToCell[0] * GetEyeCell(this->P, cell.Depth);
  }

  /// Calls the functor for each row of the band that the splat reaches, with a range of columns, of
  /// which Kernel (0 outside of the splat) and Depths are set.
  template <typename Functor>
  void ForRows(const Cell& cell, const Functor& functor)
  {
    const int top = std::min(this->End, static_cast<int>(cell.Place[1] + cell.Radius[1] + 0.5f));
    const int bottom =
      std::max(this->Begin, static_cast<int>(std::ceil(cell.Place[1] - cell.Radius[1] - 0.5f)));
    const int right =
      std::min(this->Width, static_cast<int>(cell.Place[0] + cell.Radius[0] + 0.5f) - this->Left);
    const int left =
      std::max(0, static_cast<int>(std::ceil(cell.Place[0] - cell.Radius[0] - 0.5f)) - this->Left);
    for (int row = bottom; row < top; ++row)
    {
      this->P.Options.PlaneSplats ? this->EvaluatePlane(cell, row, left, right)
                                  : this->EvaluateSquare(cell, row, left, right);
      this->Clip(row, left, right);
      functor(row, left, right);
    }
  }

  void EvaluateSquare(const Cell& cell, int row, int left, int right)
  {
    const float y = (row + 0.5f - cell.Place[1]) / cell.Radius[1];
    for (int x = left; x < right; ++x)
    {
      const float d = (x + this->Left + 0.5f - cell.Place[0]) / cell.Radius[0];
      this->Kernel[x] = std::exp(-4.5f * (d * d + y * y));
      this->Depths[x] = cell.Depth;
    }
  }

  /// A disc in the splat's plane, as an ellipse in the image, and the depth where the ray through a
  /// pixel meets the plane, no farther from the centre than the radius.
  void EvaluatePlane(const Cell& cell, int row, int left, int right)
  {
    const float* normal = cell.Normal;
    const float alongY = normal[1] - this->P.Shear * normal[0]; // of the rays, before the shear
    const float flat = std::max(1e-20f, std::hypot(normal[0], normal[1]));
    const float slant[2] = { normal[0] / flat, normal[1] / flat };
    const float width = std::max(std::abs(normal[2]), vtkDirectParameters::LeastWidth);
    const float extra = 1.0f / (width * width) - 1.0f;
    const float limit = this->GetEyeRadius(cell);
    // of the ray at the row's column 0, and a column on: the slope of the plane along it, and what
    // the centre rises over it
    const std::array<float, 4>& ray = this->P.EyeRay;
    const std::array<float, 4>& step = this->P.EyeRayStep;
    const float placeY = (row + 0.5f) * this->P.PixelToCell[1];
    const float slope0 = normal[0] * ray[0] + alongY * (ray[1] + placeY * step[1]) - normal[2];
    const float riseY =
      alongY * (cell.Place[1] * this->P.PixelToCell[1] - placeY) * (step[3] + cell.Depth * step[1]);
    const float riseX = normal[0] * (step[2] + cell.Depth * step[0]);
    const float y = (row + 0.5f - cell.Place[1]) / cell.Radius[1];
    for (int x = left; x < right; ++x)
    {
      const float column = x + this->Left + 0.5f;
      const float d = (column - cell.Place[0]) / cell.Radius[0];
      const float along = slant[0] * d + slant[1] * y;
      const float inside = std::max(0.0f, 1.0f - d * d - y * y - extra * along * along);
      this->Kernel[x] = inside * inside;
      const float slope = slope0 + normal[0] * column * this->P.PixelToCell[0] * step[0];
      const float rise = riseX * (cell.Place[0] - column) * this->P.PixelToCell[0] + riseY;
      // negative for all that faces the viewer
      const float depth = rise / std::min(slope, -1e-6f);
      this->Depths[x] = cell.Depth + std::min(std::max(depth, -limit), limit);
    }
  }

  /// What is beyond a clipping plane is no part of the splat, lest it hide what is behind it.
  void Clip(int row, int left, int right)
  {
    const vtkPointSurfaceView& view = this->P.ImageView;
    const std::array<float, 4>& ray = this->P.EyeRay;
    const std::array<float, 4>& step = this->P.EyeRayStep;
    for (int x = left; x < right && view.NumberOfClippingPlanes > 0; ++x)
    {
      const float place[2] = { (x + this->Left + 0.5f) * this->P.PixelToCell[0],
        (row + 0.5f) * this->P.PixelToCell[1] };
      double eye[3] = { 0.0, 0.0, -this->Depths[x] };
      for (int k = 0; k < 2; ++k)
      {
        eye[k] =
          ray[2 + k] + place[k] * step[2 + k] + this->Depths[x] * (ray[k] + place[k] * step[k]);
      }
      eye[0] -= this->P.Shear * eye[1];
      for (int i = 0; i < view.NumberOfClippingPlanes; ++i)
      {
        const std::array<double, 4>& plane = view.ClippingPlanes[i];
        if (plane[0] * eye[0] + plane[1] * eye[1] + plane[2] * eye[2] + plane[3] < 0.0)
        {
          this->Kernel[x] = 0.0f;
        }
      }
    }
  }

  const vtkDirectParameters& P;
  const int Begin, End, Left, Width;
  vtkSurfacePixels& Pixels;
  size_t Offset = 0; // of the band's first pixel
  std::vector<float> Front;
  std::vector<float> Weights;
  std::vector<float> LargestWeights;
  std::vector<float> Kernel;
  std::vector<float> Depths;
};
}

void vtkDirectReconstructionCPU::DrawSplats(
  const vtkDirectParameters& p, bool ids, bool colors, vtkSurfacePixels& pixels)
{
  pixels.Allocate(p.Rectangle, ids, colors);
  auto forSplats = [&](int begin, int end, auto functor)
  {
    for (int level = 0; level <= p.GetCoarsestLevel(); ++level)
    {
      const auto& r = p.Levels[level].Rectangle;
      const Grid grid(p.Levels[level], this->Levels[level]);
      // cells whose splats may reach the band
      const float scale = p.PixelToCell[1] / (1 << level);
      const int first = std::max(r[1], static_cast<int>(begin * scale) - 2);
      const int last = std::min(r[3], static_cast<int>(end * scale) + 3);
      for (int y = first; y < last; ++y)
      {
        for (int x = r[0]; x < r[2]; ++x)
        {
          const Cell& cell = *grid.At(x, y);
          if (cell.Splats)
          {
            functor(cell);
          }
        }
      }
    }
  };
  const int height = p.Rectangle[3] - p.Rectangle[1];
  vtkSMPTools::For(0, (height + BandHeight - 1) / BandHeight, 1,
    [&](vtkIdType firstBand, vtkIdType lastBand)
    {
      for (vtkIdType i = firstBand; i < lastBand; ++i)
      {
        const int begin = p.Rectangle[1] + static_cast<int>(i) * BandHeight;
        const int end = std::min(begin + BandHeight, p.Rectangle[3]);
        Band band(p, begin, end, pixels);
        if (p.Options.DepthTestInSplats)
        {
          forSplats(begin, end, [&](const Cell& cell) { band.FindFront(cell); });
        }
        forSplats(begin, end, [&](const Cell& cell) { band.Accumulate(cell); });
        band.Normalize();
      }
    });
}

//------------------------------------------------------------------------------
namespace
{
/// A layer of the splat that a cell makes, if any, as the shaders have it.
void CopySplat(
  const vtkDirectParameters& p, const Cell& cell, vtkSurfaceTarget::Layer layer, float* out)
{
  if (!cell.Splats)
  {
    std::fill_n(out, 4, 0.0f);
    return;
  }
  switch (layer)
  {
    case vtkSurfaceTarget::Shape:
      std::copy_n(cell.Normal, 3, out);
      out[3] = cell.Radius[0] * p.PixelToCell[0];
      return;
    case vtkSurfaceTarget::Interval:
      for (int k = 0; k < 3; ++k)
      {
        out[k] = 0.5f * (cell.Nearest[k] + cell.Farthest[k]);
      }
      out[3] = cell.IsCopy ? -1.0f : 0.0f;
      return;
    default:
      std::copy_n(cell.Color, 4, out);
  }
}
}

size_t vtkDirectReconstructionCPU::UploadSplats(vtkOpenGLRenderWindow* window,
  const vtkDirectParameters& p, bool colors, vtkSurfaceTarget& splats)
{
  std::vector<vtkSurfaceTarget::Layer> layers = { vtkSurfaceTarget::Shape,
    vtkSurfaceTarget::Interval };
  if (colors)
  {
    layers.push_back(vtkSurfaceTarget::Color);
  }
  splats.Allocate(window, p.SplatsSize[0], p.SplatsSize[1], layers);
  size_t bytes = 0;
  for (int level = 0; level <= p.GetCoarsestLevel(); ++level)
  {
    const auto& r = p.Levels[level].Rectangle;
    const auto& offset = p.Levels[level].Offset;
    const std::array<int, 4> place = { r[0] + offset[0], r[1] + offset[1], r[2] + offset[0],
      r[3] + offset[1] };
    const Cells& cells = this->Levels[level];
    std::vector<float> values(4 * cells.size());
    for (vtkSurfaceTarget::Layer layer : layers)
    {
      for (size_t i = 0; i < cells.size(); ++i)
      {
        CopySplat(p, cells[i], layer, &values[4 * i]);
      }
      bytes += splats.Upload(window, layer, place, values.data(), place[2] - place[0]);
    }
  }
  return bytes;
}
