// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceSmoothingPass
 * @brief   smooths the surfaces of a picture, but not their outlines
 *
 * Rosenthal and Linsen 2008, section 6: colours, as they are lit, and normals and depths become
 * weighted means of those of 3x3 pixels; the background does not take part. Over
 * vtkOccludedFillPass this is the order of the paper, which lights points before it smooths them.
 *
 * @sa vtkImageSpacePass vtkOccludedFillPass vtkImageSpacePointMapper
 */
#ifndef vtkSurfaceSmoothingPass_h
#define vtkSurfaceSmoothingPass_h

#include "vtkImageSpacePass.h"

class VTKPOINTSURFACE_EXPORT vtkSurfaceSmoothingPass : public vtkImageSpacePass
{
public:
  static vtkSurfaceSmoothingPass* New();
  vtkTypeMacro(vtkSurfaceSmoothingPass, vtkImageSpacePass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How often it is done, 0 to 100; default 1, as in the paper.
   */
  vtkSetClampMacro(Iterations, int, 0, 100);
  vtkGetMacro(Iterations, int);
  ///@}

  /**
   * The kernels of table 1: weights of the pixel, of a neighbour along a side, and over a corner.
   */
  enum KernelType
  {
    Box,               ///< 1, 1, 1
    Gaussian,          ///< 4, 2, 1
    AlleviatedGaussian ///< 16, 2, 1
  };

  ///@{
  /**
   * The kernel; see KernelType. Default AlleviatedGaussian, which the paper prefers.
   */
  vtkSetClampMacro(Kernel, int, Box, AlleviatedGaussian);
  vtkGetMacro(Kernel, int);
  ///@}

  ///@{
  /**
   * Distance between two layers of surface, along the view direction in world units, over which
   * pixels are not mixed. 0, the default: ten times the width of a pixel. VTK_DOUBLE_MAX: all are
   * mixed, as in the paper.
   */
  vtkSetClampMacro(LayerDistance, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(LayerDistance, double);
  ///@}

  void ReleaseGraphicsResources(vtkWindow* w) override;

protected:
  vtkSurfaceSmoothingPass();
  ~vtkSurfaceSmoothingPass() override;

  void Filter(
    vtkOpenGLRenderWindow* window, vtkSurfaceTarget*& image, vtkSurfaceTarget*& spare) override;

  int Iterations = 1;
  int Kernel = AlleviatedGaussian;
  double LayerDistance = 0.0;

private:
  vtkSurfaceSmoothingPass(const vtkSurfaceSmoothingPass&) = delete;
  void operator=(const vtkSurfaceSmoothingPass&) = delete;

  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
