// SPDX-License-Identifier: BSD-3-Clause
// Sum: adds a point to its pixel, by blending, if it is not the nearest one; see
// vtkPointProjectionVS.glsl and vtkPointAverageFS.glsl.
flat in vec4 shape;
flat in vec4 interval;
flat in vec4 color;
flat in vec4 nearestSurface;

void main()
{
  OUT_SUM = shape;
  OUT_CHANGE = interval;
  OUT_SURFACE = nearestSurface;
  WRITE_COLOR(color);
}
