// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFeatureLinePass
 * @brief   draws lines where a surface bends sharply
 *
 * Rosenthal and Linsen 2008, section 8: lines where the cosine of the angle between the normals of
 * pixels to either side, in any of four directions through the 3x3 pixels around, is small. Pixels
 * of different layers of surface are not compared: that is what vtkSilhouettePass is for.
 *
 * @sa vtkImageSpacePass vtkSilhouettePass vtkDepthAntialiasingPass
 */
#ifndef vtkFeatureLinePass_h
#define vtkFeatureLinePass_h

#include "vtkImageSpaceLinePass.h"

class VTKPOINTSURFACE_EXPORT vtkFeatureLinePass : public vtkImageSpaceLinePass
{
public:
  static vtkFeatureLinePass* New();
  vtkTypeMacro(vtkFeatureLinePass, vtkImageSpaceLinePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Cosine of the angle between normals two pixels apart, under which there is a line, -1 to
   * 0.999; half-way from there to 1 lines begin to show. Default 0.7, 46 degrees: a line where the
   * radius of curvature is under about two and a half pixels.
   */
  vtkSetClampMacro(Threshold, double, -1.0, 0.999);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /**
   * Distance between two layers of surface, along the view direction in world units, over which
   * normals are not compared. 0, the default: ten times the width of a pixel.
   */
  vtkSetClampMacro(LayerDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LayerDistance, double);
  ///@}

  void ReleaseGraphicsResources(vtkWindow* w) override;

protected:
  vtkFeatureLinePass();
  ~vtkFeatureLinePass() override;

  void FindLines(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget& image, vtkSurfaceTarget& lines) override;
  double GetFoundThickness() const override { return 2.0; }

  double Threshold = 0.7;
  double LayerDistance = 0.0;

private:
  vtkFeatureLinePass(const vtkFeatureLinePass&) = delete;
  void operator=(const vtkFeatureLinePass&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
