// SPDX-License-Identifier: BSD-3-Clause
// The one-pixel projections as a surface buffer.
uniform ivec2 begin;
uniform ivec2 end;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 shape = texelFetch(inShape, pixel, 0);
  OUT_SURFACE = shape.w > 0.0 ? vec4(shape.xyz, texelFetch(inInterval, pixel, 0).x) : vec4(0.0);
#ifdef HAS_ID
  OUT_ID = texelFetch(inId, pixel, 0).r;
#endif
#ifdef HAS_COLOR
  OUT_COLOR = texelFetch(inColor, pixel, 0);
#endif
}
