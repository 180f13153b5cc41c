// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDepthAntialiasingPass
 * @brief   smooths the stairs along edges in depth
 *
 * Rosenthal and Linsen 2008, section 7: the Laplace filter of the depths finds the pixels on either
 * side of an edge, between a surface and the background or between two layers of surface, and their
 * colours are blended with those around, by the Gaussian kernel of table 1. Depths stay.
 *
 * @sa vtkImageSpacePass vtkSilhouettePass
 */
#ifndef vtkDepthAntialiasingPass_h
#define vtkDepthAntialiasingPass_h

#include "vtkImageSpacePass.h"

class VTKPOINTSURFACE_EXPORT vtkDepthAntialiasingPass : public vtkImageSpacePass
{
public:
  static vtkDepthAntialiasingPass* New();
  vtkTypeMacro(vtkDepthAntialiasingPass, vtkImageSpacePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What the Laplace filter has to reach between two layers of surface, in world units; the border
   * of the background counts as an edge in any case. 0, the default: ten times the width of a
   * pixel. VTK_DOUBLE_MAX: the border of the background alone.
   */
  vtkSetClampMacro(Threshold, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Threshold, double);
  ///@}

  void ReleaseGraphicsResources(vtkWindow* w) override;

protected:
  vtkDepthAntialiasingPass();
  ~vtkDepthAntialiasingPass() override;

  void Filter(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare) override;

  double Threshold = 0.0;

private:
  vtkDepthAntialiasingPass(const vtkDepthAntialiasingPass&) = delete;
  void operator=(const vtkDepthAntialiasingPass&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
