// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMaskFillOptions
 * @brief   what a fill by the masks of Rosenthal and Linsen 2008 is to fill
 *
 * The eight masks (figure 4) are the runs of five neighbours in a row of a pixel's ring of eight.
 * A pixel stays as it is where all of a run lies beyond the surface in front; else it takes the
 * values of the nearest of the others.
 */
#ifndef vtkMaskFillOptions_h
#define vtkMaskFillOptions_h

#include "vtkDepthStep.h"

struct vtkMaskFillOptions
{
  /// Fill pixels of a surface that another one, nearer by DepthStep, hides (section 5); else those
  /// of the background (section 4).
  bool Occluded = false;
  vtkDepthStep DepthStep; ///< of no effect unless Occluded
  int MaximumIterations = 1;
  /// Over 0: the surface in front must also be seen within so many pixels of the pixel, in some of
  /// any three neighbouring directions of the eight, so that outlines do not grow. The masks alone
  /// fill every stair of an outline.
  int Reach = 0;
};

#endif
