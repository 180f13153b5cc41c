// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBackgroundFillPass
 * @brief   fills pixels of the background that are holes in a surface
 *
 * Rosenthal and Linsen 2008, section 4: a pixel of the background takes colour, normal and depth of
 * its nearest neighbour, unless five neighbours in a row of the eight around it are background.
 * Over vtkPolyDataMapper with points of one pixel this closes the surface of a dense cloud.
 *
 * @sa vtkImageSpacePass vtkOccludedFillPass vtkImageSpacePointMapper
 */
#ifndef vtkBackgroundFillPass_h
#define vtkBackgroundFillPass_h

#include "vtkImageSpacePass.h"

class VTKPOINTSURFACE_EXPORT vtkBackgroundFillPass : public vtkImageSpacePass
{
public:
  static vtkBackgroundFillPass* New();
  vtkTypeMacro(vtkBackgroundFillPass, vtkImageSpacePass);
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
  vtkBackgroundFillPass();
  ~vtkBackgroundFillPass() override;

  void Filter(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare) override;

  int MaximumIterations = 8;
  bool KeepOutlines = true;
  int LastFrameIterations = 0;

private:
  vtkBackgroundFillPass(const vtkBackgroundFillPass&) = delete;
  void operator=(const vtkBackgroundFillPass&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
