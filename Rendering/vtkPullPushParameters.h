// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPullPushParameters
 * @brief   what both forms of a pull-push reconstruction take from a view and the options
 */
#ifndef vtkPullPushParameters_h
#define vtkPullPushParameters_h

#include "vtkPullPushOptions.h"

#include <array>
#include <vector>

struct vtkPointSurfaceView;

struct vtkPullPushParameters
{
  struct Level
  {
    int Width, Height;            ///< of the whole image
    std::array<int, 4> Rectangle; ///< x, y, x end, y end: pixels outside are invalid
  };

  vtkPullPushParameters(const vtkPointSurfaceView& view, const vtkPullPushOptions& options);

  int GetCoarsestLevel() const { return static_cast<int>(this->Levels.size()) - 1; }

  /// Whether pixels have several points, which tell slopes and outlines: 1 where radii are 0.9
  /// pixels at most, falling to 0 at 1.4. Few points tell neither; rough surfaces become specks by
  /// them.
  static double GetShareOfDense(const vtkPointSurfaceView& view);

  /// Whether there is anything for vtkOutlineTrimCPU or vtkPullPushReconstructionOpenGL::Trim().
  bool TrimsProjected() const { return this->LargestOffset < 0.5f; }

  /// Whether in the push backs give way to the front before them.
  bool HidesBacks() const { return this->TwoSided && this->Options.DepthTestInPush; }

  vtkPullPushOptions Options;
  std::vector<Level> Levels;         ///< 0 is the finest; as many as the largest disc needs
  std::array<float, 4> PixelToEye{}; ///< xy: eye units a pixel where w is 1; zw: w = z depth + w
  // See vtkEyeRays, of level 0. What PixelToEye gives is to be sheared too.
  std::array<float, 4> EyeRay{};
  std::array<float, 4> EyeRayStep{};
  float Shear = 0.0f;
  float UnionShare = 0.0f; ///< 0: mean of the radii (the paper); 1: the discs' union
  /// Pixels that a disc may miss the centre of its point's own pixel by, where outlines are
  /// trimmed: small discs, and those that are seen edge-on, cover few centres.
  float OutlineSlack = 0.0f;
  /// Pixels that the points of a pixel may lie to one side of its centre by if an outline is on the
  /// other side: of what covers half of a pixel they lie a quarter aside. Half of one, or more: all
  /// may; where a pixel has few points, these do not tell.
  float LargestOffset = 0.5f;
  bool BlendsPixels = false; ///< of the finest level, that stay, with the coarser ones
  float DepthStep = 0.0f;    ///< in eye units: what is farther back than this is behind
  int OpenRun = 5;           ///< empty pixels in a row around one that stays empty
  bool TwoSided = false;     ///< normals may point to either side
  /// Planes of clipping in eye coordinates, with normals of unit length.
  std::array<std::array<float, 4>, 6> ClippingPlanes{};
  int NumberOfClippingPlanes = 0;
};

#endif
