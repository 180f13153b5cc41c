// SPDX-License-Identifier: BSD-3-Clause
// Average: what turns the nearest of the points that fall in one pixel into the mean of them all; it is
// added by blending. From the sums of the others, see vtkPointSumFS.glsl.
uniform bool centerDepths; // see vtkPullPushCommon.glsl

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 sum = texelFetch(sumSum, pixel, 0);
  bool isShared = sum.w > 0.0;
  float count = sum.w + 1.0;
  vec4 change = texelFetch(sumChange, pixel, 0) / count;
  vec3 nearest = texelFetch(sumSurface, pixel, 0).xyz;
  vec3 normal = nearest + sum.xyz;
  float size = length(normal);
  normal = size < 1e-6 ? nearest : normal / size;
  vec2 depths = centerDepths ? vec2(change.x, max(change.x, 0.0)) : vec2(0.0); // from the nearest one on
  OUT_SHAPE = isShared ? vec4(normal - nearest, change.y) : vec4(0.0);
  OUT_INTERVAL = isShared ? vec4(depths, change.zw) : vec4(0.0);
  WRITE_COLOR(isShared ? texelFetch(sumColor, pixel, 0) / count : vec4(0.0));
}
