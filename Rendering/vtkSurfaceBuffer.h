// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceBuffer
 * @brief   a finished surface buffer, the view that it is of, and the splats that it was drawn
 * from, where a mapper keeps them
 */
#ifndef vtkSurfaceBuffer_h
#define vtkSurfaceBuffer_h

#include "vtkPointSurfaceView.h"
#include "vtkSurfaceTarget.h"

struct vtkSurfaceBuffer
{
  vtkPointSurfaceView View;
  vtkSurfaceTarget Target;
  vtkSurfaceTarget Splats;
  bool Valid = false;
  bool HasCoverage = false; ///< the normals' length is the share of the pixel that is covered
  unsigned long LastUse = 0;
};

#endif
