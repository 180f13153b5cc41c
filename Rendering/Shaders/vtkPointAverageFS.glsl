// SPDX-License-Identifier: BSD-3-Clause
// Average: of the points that fall in one pixel, from their sums (vtkPointSumFS.glsl) and the nearest.
uniform bool centerDepths; // see vtkPullPushCommon.glsl

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 shape = texelFetch(nearestShape, pixel, 0);
  vec4 interval = texelFetch(nearestInterval, pixel, 0);
  vec4 shapeSum = texelFetch(sumShape, pixel, 0);
  float count = shapeSum.w;
  if (count > 1.0)
  {
    vec4 mean = texelFetch(sumInterval, pixel, 0) / count;
    float size = length(shapeSum.xyz);
    shape = vec4(size < 1e-6 ? shape.xyz : shapeSum.xyz / size, mean.y);
    interval.zw = mean.zw;
    if (centerDepths)
    {
      interval.xy = vec2(mean.x, max(mean.x - interval.x, 0.0)); // from the nearest one on
    }
  }
  OUT_SHAPE = shape;
  OUT_INTERVAL = interval;
#ifdef HAS_ID
  OUT_ID = texelFetch(nearestId, pixel, 0).r;
#endif
#ifdef HAS_COLOR
  OUT_COLOR = texelFetch(sumColor, pixel, 0) / max(count, 1.0);
#endif
}
