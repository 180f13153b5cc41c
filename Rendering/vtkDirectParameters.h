// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDirectParameters
 * @brief   what both forms of a direct reconstruction take from a view and the options
 *
 * The image buffer is an image of the viewport, coarser by ImageStep. Its pixels are called cells,
 * to tell them from those of the surface buffer.
 */
#ifndef vtkDirectParameters_h
#define vtkDirectParameters_h

#include "vtkDirectOptions.h"
#include "vtkPointSurfaceView.h"

#include <array>
#include <vector>

struct vtkDirectParameters
{
  /// Of the cells of a level: 0 is the image buffer, each other one merges two by two of the last.
  struct Level
  {
    int Width, Height;
    std::array<int, 4> Rectangle; ///< x, y, x end, y end: cells outside are empty
    std::array<int, 2> Offset;    ///< in the image of splats, which has all levels side by side
  };

  /// Occupied cells, of the 9 around one, that make its splat at its own level.
  static constexpr int EnoughNeighbors = 4;
  /// How far behind it, in cells of level 0, these may be: stray points before a surface stay
  /// small.
  static constexpr float NeighborDepth = 8.0f;
  /// Levels above the image buffer's that the adaptive resolution goes to.
  static constexpr int MaximumLevel = 2;
  /// Half of the width of a splat, in cells, and how much narrower one may get that is slanted.
  static constexpr float SplatRadius = 1.5f;
  static constexpr float LeastWidth = 0.5f;
  /// Of weighted normals, in cells: how far away points have a weight, and how far before or behind
  /// the cell's mean, and then the plane fitted first, those may be that count.
  static constexpr int FitRadius = 3;
  static constexpr float FitDepth = 5.0f;
  static constexpr float RefitDepth = 2.0f;
  /// Where the depth steps by so many cells and more from cell to cell, and the larger of two steps
  /// is at most EvenSteps - 1 times the other, the first fit starts from their slope.
  static constexpr float SteepStep = FitDepth;
  static constexpr float EvenSteps = 3.0f;

  vtkDirectParameters(const vtkPointSurfaceView& view, const vtkDirectOptions& options);

  int GetCoarsestLevel() const { return static_cast<int>(this->Levels.size()) - 1; }

  /// Cells to each side of one whose points its normal is fitted to.
  int GetFitReach() const { return this->Options.WeightedNormals ? FitRadius : 1; }

  vtkDirectOptions Options;
  vtkPointSurfaceView ImageView; ///< the view with the image buffer's size and rectangle
  std::vector<Level> Levels;
  std::array<int, 2> SplatsSize{}; ///< of the image of splats
  double ImageStep = 1.0;          ///< rho: pixels along a cell
  float Gamma = 0.0f;              ///< in eye units

  // Linear functions of a place in cells of level 0: eye xy = origin + depth * direction, and then
  // x less Shear times y.
  std::array<float, 4> EyeRay{};     ///< xy: direction at (0, 0); zw: origin
  std::array<float, 4> EyeRayStep{}; ///< change of these a cell
  float Shear = 0.0f;
  std::array<float, 4> CellToEye{}; ///< xy: eye units a cell where w is 1; zw: w = z depth + w
  std::array<int, 2> Size{};        ///< of the surface buffer
  std::array<int, 4> Rectangle{};   ///< of the surface buffer: x, y, x end, y end
  std::array<float, 2> PixelToCell{};
};

#endif
