// SPDX-License-Identifier: BSD-3-Clause
// The weighted sums of splats become their mean; their id is that of the heaviest one.
void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 sum = texelFetch(inSum, pixel, 0);
  float weight = texelFetch(inWeight, pixel, 0).x;
  float size = length(sum.xyz);
  OUT_SURFACE = weight > 0.0
    ? vec4(size > 0.0 ? sum.xyz / size : vec3(0.0), sum.w / weight)
    : vec4(0.0);
#ifdef OUT_COLOR
  OUT_COLOR = texelFetch(inColor, pixel, 0) / (weight > 0.0 ? weight : 1.0);
#endif
#ifdef OUT_ID
  OUT_ID = texelFetch(heaviestId, pixel, 0).r;
#endif
}
