// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPixelFillCPU
 * @brief   fills single pixels amid a surface, by the processor
 *
 * The same as vtkFillFS.glsl: pixels that are empty, or show the back of a surface through a gap in
 * its front, by the masks of Rosenthal and Linsen 2008 (section 6). The few new pixels of each row
 * are put down apart until all are known, so that none is made from another.
 */
#ifndef vtkPixelFillCPU_h
#define vtkPixelFillCPU_h

#include <cstddef>
#include <vector>

struct vtkPullPushParameters;
struct vtkSurfacePixels;

class vtkPixelFillCPU
{
public:
  /**
   * Fills within the rectangle of `pixels`.
   */
  void Run(const vtkPullPushParameters& parameters, vtkSurfacePixels& pixels);

private:
  struct Filled
  {
    size_t Pixel;
    float Surface[4];
    float Color[4];
    unsigned int Id;
  };

  void FillRow(const vtkPullPushParameters& parameters, const vtkSurfacePixels& pixels, int row);
  bool FillPixel(const vtkPullPushParameters& parameters, const vtkSurfacePixels& pixels,
    int column, int row, Filled& filled) const;

  std::vector<std::vector<Filled>> Rows;
};

#endif
