// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMaskFillPass
 * @brief   what passes that fill pixels by the masks of their neighbours have in common
 *
 * Rosenthal and Linsen 2008, sections 4 and 5.
 *
 * @sa vtkBackgroundFillPass vtkOccludedFillPass
 */
#ifndef vtkMaskFillPass_h
#define vtkMaskFillPass_h

#include "vtkImageSpacePass.h"

#include <memory> // for std::unique_ptr

struct vtkMaskFillOptions;

class VTKPOINTSURFACE_EXPORT vtkMaskFillPass : public vtkImageSpacePass
{
public:
  vtkTypeMacro(vtkMaskFillPass, vtkImageSpacePass);
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
  vtkMaskFillPass();
  ~vtkMaskFillPass() override;

  void Filter(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare) override;

  /**
   * Which pixels are filled: by default those of the background.
   */
  virtual void SetOptions(vtkMaskFillOptions&) const {}

  int MaximumIterations = 8;
  bool KeepOutlines = true;
  int LastFrameIterations = 0;

private:
  vtkMaskFillPass(const vtkMaskFillPass&) = delete;
  void operator=(const vtkMaskFillPass&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
