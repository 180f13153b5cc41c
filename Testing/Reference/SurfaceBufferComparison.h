// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   SurfaceBufferComparison
 * @brief   a mapper's surface buffer beside the reference's reconstruction of the same projection
 *
 * The images are those of vtkPullPushMapper::ReadProjectedBuffer() and ReadSurfaceBuffer(); of the
 * first, the extent may be larger by a rim. For an
 * image that lacks an array std::runtime_error is thrown, which names it.
 *
 * @sa PullPushReference
 */
#ifndef SurfaceBufferComparison_h
#define SurfaceBufferComparison_h

#include "PullPushReference.h"

#include <ostream>
#include <string>

class vtkImageData;

class SurfaceBufferComparison
{
public:
  /**
   * The reconstruction of a projected buffer: point arrays "Normals" (3 components), "Radius" (0:
   * no point), "Depth", "Displacement" (2), "Colors" (4, optional) and "PointIds", field data
   * "Projection" (16, row-major) and "Levels" (1).
   */
  static PullPushReference Reconstruct(vtkImageData* projected);

  /**
   * Compares the reference with a surface buffer: point arrays "Normals" (3 components), "Depth"
   * (0: no surface), "PointIds" and "Colors" (4), the last only if `projected` has colours.
   */
  SurfaceBufferComparison(vtkImageData* projected, vtkImageData* surface);

  int Covered = 0;               ///< pixels with a surface in the reference or in the buffer
  int NearDecision = 0;          ///< of these, those that a close decision made
  int NearDecisionDiffering = 0; ///< of those, those that differ in validity or source
  int Differing = 0;             ///< of the others, those that differ in validity or source
  double WorstNormal = 0; ///< largest difference of a component, among those that do not differ
  double WorstDepth = 0;  ///< largest difference relative to the reference's depth
  double WorstColor = 0;  ///< largest difference of a component

  /**
   * Whether the two agree as the project promises: a surface at all, at most 0.1% of the covered
   * pixels differing, and the rest within 1e-4.
   */
  bool Agrees() const;

  void Print(std::ostream& os) const;

private:
  void ComparePixel(const PullPushReference::Pixel& expected, vtkImageData* surface, int pixelId,
    bool compareColors);
};

#endif
