// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkAlgebraicSplatOptions
 * @brief   how overlapping splats are blended; see vtkAlgebraicSplatMapper
 */
#ifndef vtkAlgebraicSplatOptions_h
#define vtkAlgebraicSplatOptions_h

struct vtkAlgebraicSplatOptions
{
  double DepthShift = 0.0;
  double WeightFalloff = 0.0;
  bool SeparateSides = false;
};

#endif
