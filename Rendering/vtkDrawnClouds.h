// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDrawnClouds
 * @brief   the clouds of a frame as the steps that start from points take them, of one back end
 */
#ifndef vtkDrawnClouds_h
#define vtkDrawnClouds_h

#include "vtkPointProjectionCPU.h"
#include "vtkPointProjectionOpenGL.h"

#include <vector>

struct vtkDrawnClouds
{
  std::vector<vtkPointProjectionOpenGL::Cloud> OpenGL;
  std::vector<vtkPointProjectionCPU::Cloud> CPU;
};

#endif
