// SPDX-License-Identifier: BSD-3-Clause
// Sum: adds a point to its pixel, by blending, if it is not the nearest one; see
// vtkPointAverageFS.glsl. Of the sums, shape.w is the number of points and interval.y
// that of their radii.
uniform bool twoSided; // normals may point to either side

flat in vec4 shape;
flat in vec4 interval;
flat in vec4 color;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 nearest = texelFetch(nearestShape, pixel, 0).xyz;
  float side = twoSided && dot(shape.xyz, nearest) < 0.0 ? -1.0 : 1.0;
  OUT_SHAPE = vec4(side * shape.xyz, 1.0);
  OUT_INTERVAL = vec4(interval.x, shape.w, interval.zw);
#ifdef OUT_COLOR
  OUT_COLOR = color;
#endif
}
