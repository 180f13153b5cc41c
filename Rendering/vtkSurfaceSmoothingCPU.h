// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSmoothingCPU
 * @brief   the step that smooths a surface buffer with a kernel of 3x3, by the processor
 *
 * The same as vtkSurfaceSmoothingOpenGL.
 */
#ifndef vtkSurfaceSmoothingCPU_h
#define vtkSurfaceSmoothingCPU_h

struct vtkSurfacePixels;
struct vtkSurfaceSmoothingOptions;

namespace vtkSurfaceSmoothingCPU
{
/**
 * Makes `smoothed` from `surface`.
 */
void Run(const vtkSurfaceSmoothingOptions& options, const vtkSurfacePixels& surface,
  vtkSurfacePixels& smoothed);
}

#endif
