// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOutlineTrimCPU
 * @brief   takes what a surface covers less than half of away from projected points, by the
 *          processor
 *
 * The same as vtkOutlineTrimFS.glsl: where the points of a pixel lie to one side of its centre and
 * on the other side the surface does not go on, an outline runs between them and the centre. The
 * pixel becomes empty, or shows what is behind. The few pixels of each row that change are put down
 * apart until all are known, so that none is made from another.
 */
#ifndef vtkOutlineTrimCPU_h
#define vtkOutlineTrimCPU_h

#include "vtkSurfaceImage.h"

#include <vector>

struct vtkPullPushParameters;

class vtkOutlineTrimCPU
{
public:
  /**
   * Trims within the rectangle of `projected`.
   */
  void Run(const vtkPullPushParameters& parameters, vtkSurfaceImage& projected);

private:
  struct Trimmed
  {
    int X;
    float Values[vtkSurfaceImage::NumberOfPlanes]; // a radius of 0: empty
    unsigned int Id;
  };

  void TrimRow(const vtkPullPushParameters& parameters, vtkSurfaceImage& projected, int y);
  static bool TrimPixel(const vtkPullPushParameters& parameters, vtkSurfaceImage& projected, int x,
    int y, Trimmed& trimmed);

  std::vector<std::vector<Trimmed>> Rows;
};

#endif
