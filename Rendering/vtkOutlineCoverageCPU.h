// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOutlineCoverageCPU
 * @brief   the step that makes the outline of a surface buffer blend with what lies behind
 *
 * The same as vtkOutlineCoverageOpenGL, by the processor.
 */
#ifndef vtkOutlineCoverageCPU_h
#define vtkOutlineCoverageCPU_h

#include <array>

struct vtkSurfacePixels;

namespace vtkOutlineCoverageCPU
{
/**
 * Gives the normals of `pixels`, a part of a viewport of `size`, the length of their coverage.
 */
void Run(const std::array<int, 2>& size, vtkSurfacePixels& pixels);
}

#endif
