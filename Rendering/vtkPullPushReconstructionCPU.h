// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPullPushReconstructionCPU
 * @brief   the step from one-pixel projections to a surface buffer, by the processor
 *
 * The same as vtkPullPushReconstructionOpenGL, pixel for pixel (see vtkPullFS.glsl,
 * vtkPushFS.glsl and vtkFillFS.glsl), threaded over rows by vtkSMPTools. Empty blocks of pixels are
 * passed over, in push also those with nothing to overwrite. The result does not depend on the
 * number of threads.
 */
#ifndef vtkPullPushReconstructionCPU_h
#define vtkPullPushReconstructionCPU_h

#include "vtkPixelFillCPU.h"
#include "vtkSurfaceImage.h"

#include <memory>
#include <vector>

struct vtkPullPushParameters;
struct vtkSurfacePixels;

class vtkPullPushReconstructionCPU
{
public:
  /**
   * Fills `surface` from `projected`: what the rectangle of level 0 holds, with ids and colours
   * where `projected` has them.
   */
  void Run(
    const vtkPullPushParameters& parameters, vtkSurfaceImage& projected, vtkSurfacePixels& surface);

private:
  void Pull(const vtkPullPushParameters& parameters, vtkSurfaceImage& fine, vtkSurfaceImage& coarse,
    int level);
  void Push(const vtkPullPushParameters& parameters, vtkSurfaceImage& fine, vtkSurfaceImage& coarse,
    int level);
  void Finish(const vtkPullPushParameters& parameters, vtkSurfaceImage& projected,
    vtkSurfaceImage& coarse, vtkSurfacePixels& surface);

  vtkPixelFillCPU Fill;
  std::vector<std::unique_ptr<vtkSurfaceImage>> Coarse; // levels 1 and up, by level - 1
};

#endif
