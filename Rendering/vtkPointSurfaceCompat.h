// SPDX-License-Identifier: BSD-3-Clause
// What differs between the versions of VTK that we build with (9.1 to 9.7). No version check stands
// anywhere else.
#ifndef vtkPointSurfaceCompat_h
#define vtkPointSurfaceCompat_h

#include "vtkVersionMacros.h"

#define VTK_POINT_SURFACE_VERSION_AT_LEAST(major, minor)                                           \
  (VTK_MAJOR_VERSION > (major) || (VTK_MAJOR_VERSION == (major) && VTK_MINOR_VERSION >= (minor)))

// OpenGL's entry points: GLEW until 9.3, glad from 9.4 on.
#if VTK_POINT_SURFACE_VERSION_AT_LEAST(9, 4)
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

// The vertex attribute that carries scalars to be mapped by texture
// (InterpolateScalarsBeforeMapping).
#if VTK_POINT_SURFACE_VERSION_AT_LEAST(9, 3)
#define VTK_POINT_SURFACE_COLOR_TCOORD "colorTCoord"
#else
#define VTK_POINT_SURFACE_COLOR_TCOORD "tcoord"
#endif

#ifndef VTK_FUTURE_CONST
#define VTK_FUTURE_CONST
#endif

#endif
