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

#include "vtkPointSurfaceView.h"

#include "vtkType.h"

#include <array>
#include <functional>
#include <vector>

class vtkDrawableSplats;
struct vtkAlgebraicSplatOptions;
struct vtkSurfacePixels;

class vtkAlgebraicSplatTracingCPU
{
public:
  using ColorSource = std::function<std::array<float, 4>(unsigned int)>;

  struct Cloud
  {
    const vtkDrawableSplats* Splats = nullptr;
    vtkPointSurfaceView View; ///< those in its ranges are drawn
    vtkIdType FirstId = 0;    ///< added to the ids of the splats' points
    ColorSource Color;        ///< of a splat's point
  };

  /**
   * Makes the pixels of the view's rectangle from clouds that share its eye and its clipping
   * planes, with ids and colours if asked.
   */
  static void Run(const std::vector<Cloud>& clouds, const vtkPointSurfaceView& view,
    const vtkAlgebraicSplatOptions& options, bool ids, bool colors, vtkSurfacePixels& surface);
};

#endif
