// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSilhouettePass
 * @brief   draws lines along the edges of surfaces in depth
 *
 * Rosenthal and Linsen 2008, section 8: lines where the Laplace filter of the depths is large, at
 * the border of the background and between two layers of surface. They lie on the surface in front,
 * one pixel wide, and are widened to both sides.
 *
 * @sa vtkImageSpacePass vtkFeatureLinePass vtkDepthAntialiasingPass
 */
#ifndef vtkSilhouettePass_h
#define vtkSilhouettePass_h

#include "vtkImageSpaceLinePass.h"

class VTKPOINTSURFACE_EXPORT vtkSilhouettePass : public vtkImageSpaceLinePass
{
public:
  static vtkSilhouettePass* New();
  vtkTypeMacro(vtkSilhouettePass, vtkImageSpaceLinePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What the Laplace filter has to reach between two layers of surface, in world units; half and
   * one and a half times this is where lines begin to show and are full. The border of the
   * background is a line in any case. 0, the default: ten times the width of a pixel.
   * VTK_DOUBLE_MAX: the border of the background alone.
   */
  vtkSetClampMacro(Threshold, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Threshold, double);
  ///@}

  void ReleaseGraphicsResources(vtkWindow* w) override;

protected:
  vtkSilhouettePass();
  ~vtkSilhouettePass() override;

  void FindLines(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget& image, vtkSurfaceTarget& lines) override;
  double GetFoundThickness() const override { return 1.0; }

  double Threshold = 0.0;

private:
  vtkSilhouettePass(const vtkSilhouettePass&) = delete;
  void operator=(const vtkSilhouettePass&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
