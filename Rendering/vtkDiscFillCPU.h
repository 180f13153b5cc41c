// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDiscFillCPU
 * @brief   the step from projected points to a surface whose gaps their discs fill, by the
 * processor
 *
 * The same as vtkDiscFillOpenGL.
 */
#ifndef vtkDiscFillCPU_h
#define vtkDiscFillCPU_h

class vtkSurfaceImage;
struct vtkDiscFillOptions;
struct vtkSurfacePixels;

class vtkDiscFillCPU
{
public:
  /**
   * Makes `surface` of `projected`, whose displacements are those of SubpixelCenters.
   */
  static void Run(
    const vtkDiscFillOptions& options, vtkSurfaceImage& projected, vtkSurfacePixels& surface);
};

#endif
