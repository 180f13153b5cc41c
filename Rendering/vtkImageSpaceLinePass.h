// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkImageSpaceLinePass
 * @brief   draws lines over a picture, along what a subclass finds in its depths or normals
 *
 * The abstract base of the illustrative passes (Rosenthal and Linsen 2008, section 8). Lines are as
 * thick in pixels whatever the size of the picture, with smooth borders; depths stay.
 *
 * @sa vtkImageSpacePass vtkSilhouettePass vtkFeatureLinePass
 */
#ifndef vtkImageSpaceLinePass_h
#define vtkImageSpaceLinePass_h

#include "vtkImageSpacePass.h"

class VTKPOINTSURFACE_EXPORT vtkImageSpaceLinePass : public vtkImageSpacePass
{
public:
  vtkTypeMacro(vtkImageSpaceLinePass, vtkImageSpacePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Colour of the lines, red, green and blue from 0 to 1. Default black.
   */
  vtkSetVector3Macro(Color, double);
  vtkGetVector3Macro(Color, double);
  ///@}

  ///@{
  /**
   * Thickness of the lines in pixels, 1 to 16; default 2.
   */
  vtkSetClampMacro(Thickness, double, 1.0, 16.0);
  vtkGetMacro(Thickness, double);
  ///@}

  void ReleaseGraphicsResources(vtkWindow* w) override;

protected:
  vtkImageSpaceLinePass();
  ~vtkImageSpaceLinePass() override;

  /**
   * Writes to `lines`, with the layer Shape alone, how sure a pixel of `image` is of a line, 0 to
   * 1, in the first component.
   */
  virtual void FindLines(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget& image, vtkSurfaceTarget& lines) = 0;

  /**
   * Pixels across the lines that FindLines() finds, 1 or 2.
   */
  virtual double GetFoundThickness() const = 0;

  void Filter(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare) override;

  double Color[3] = { 0.0, 0.0, 0.0 };
  double Thickness = 2.0;

private:
  vtkImageSpaceLinePass(const vtkImageSpaceLinePass&) = delete;
  void operator=(const vtkImageSpaceLinePass&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
