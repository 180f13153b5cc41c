// SPDX-License-Identifier: BSD-3-Clause
// Average: of the points that fall in one pixel, from the nearest and the sums of the others
// (vtkPointSumFS.glsl).
uniform bool centerDepths; // see vtkPullPushCommon.glsl

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 shape = texelFetch(nearestShape, pixel, 0);
  vec4 interval = texelFetch(nearestInterval, pixel, 0);
  vec4 shapeSum = texelFetch(sumShape, pixel, 0);
  float count = shapeSum.w + 1.0;
  if (count > 1.0)
  {
    vec4 nearest = vec4(interval.x, shape.w, interval.zw);
    vec4 mean = (nearest + texelFetch(sumInterval, pixel, 0)) / count;
    vec3 normal = shape.xyz + shapeSum.xyz;
    float size = length(normal);
    shape = vec4(size < 1e-6 ? shape.xyz : normal / size, mean.y);
    interval.zw = mean.zw;
    if (centerDepths)
    {
      interval.xy = vec2(mean.x, max(mean.x - interval.x, 0.0)); // from the nearest one on
    }
  }
  OUT_SHAPE = shape;
  OUT_INTERVAL = interval;
  WRITE_ID(texelFetch(nearestId, pixel, 0).r);
  WRITE_COLOR((texelFetch(nearestColor, pixel, 0) + texelFetch(sumColor, pixel, 0)) / count);
}
