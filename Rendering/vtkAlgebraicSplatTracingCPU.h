// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAlgebraicSplatTracingCPU
 * @brief   the step from splats to a surface buffer, by the processor
 *
 * The same as vtkAlgebraicSplatTracingOpenGL, by tiles of the image: a splat is traced once for
 * each pixel of its bounds, the hits of a tile are kept until its visible depths are known.
 */
#ifndef vtkAlgebraicSplatTracingCPU_h
#define vtkAlgebraicSplatTracingCPU_h

#include <array>
#include <functional>

class vtkDrawableSplats;
struct vtkAlgebraicSplatOptions;
struct vtkPointSurfaceView;
struct vtkSurfacePixels;

class vtkAlgebraicSplatTracingCPU
{
public:
  using ColorSource = std::function<std::array<float, 4>(unsigned int)>;

  /**
   * Makes the pixels of the view's rectangle from the splats in its ranges, with ids if asked, and
   * colours if `color` tells that of a splat's point.
   */
  static void Run(const vtkDrawableSplats& splats, const vtkPointSurfaceView& view,
    const vtkAlgebraicSplatOptions& options, bool ids, const ColorSource& color,
    vtkSurfacePixels& surface);
};

#endif
