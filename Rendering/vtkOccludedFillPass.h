// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOccludedFillPass
 * @brief   fills pixels that show a hidden surface through a hole in the one before it
 *
 * Rosenthal and Linsen 2008, section 5: a pixel that is farther back than LayerDistance behind its
 * neighbours takes colour, normal and depth of the nearest of them, unless five in a row of the
 * eight around it are as far back as it is. To be run after vtkBackgroundFillPass, for points of a
 * dense cloud.
 *
 * @sa vtkImageSpacePass vtkBackgroundFillPass vtkImageSpacePointMapper
 */
#ifndef vtkOccludedFillPass_h
#define vtkOccludedFillPass_h

#include "vtkImageSpacePass.h"

class VTKPOINTSURFACE_EXPORT vtkOccludedFillPass : public vtkImageSpacePass
{
public:
  static vtkOccludedFillPass* New();
  vtkTypeMacro(vtkOccludedFillPass, vtkImageSpacePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Iterations at most, 0 to 1000; each takes a pixel off every side of a hole, and they end when
   * there is nothing left to fill. The paper used 1 to 3. Default 8, for
   * points up to two pixels apart and gaps that are wider than four pixels.
   */
  vtkSetClampMacro(MaximumIterations, int, 0, 1000);
  vtkGetMacro(MaximumIterations, int);
  ///@}

  ///@{
  /**
   * Distance between two layers of surface, along the view direction in world units; the paper has
   * 0.0001 times the distance of the far plane. 0, the default: ten times the width of a pixel.
   */
  vtkSetClampMacro(LayerDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LayerDistance, double);
  ///@}

  ///@{
  /**
   * Fill only what has the surface on all sides, within half of MaximumIterations pixels. The
   * paper's masks alone, which this adds to, fill each stair of an outline too, once an iteration.
   * Default on.
   */
  vtkSetMacro(KeepOutlines, bool);
  vtkGetMacro(KeepOutlines, bool);
  vtkBooleanMacro(KeepOutlines, bool);
  ///@}

  /**
   * Iterations of the last frame that filled a pixel; 0 in a frame without holes.
   */
  vtkGetMacro(LastFrameIterations, int);

  void ReleaseGraphicsResources(vtkWindow* w) override;

protected:
  vtkOccludedFillPass();
  ~vtkOccludedFillPass() override;

  void Filter(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare) override;

  double LayerDistance = 0.0;
  int MaximumIterations = 8;
  bool KeepOutlines = true;
  int LastFrameIterations = 0;

private:
  vtkOccludedFillPass(const vtkOccludedFillPass&) = delete;
  void operator=(const vtkOccludedFillPass&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
