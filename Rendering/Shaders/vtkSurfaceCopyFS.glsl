// SPDX-License-Identifier: BSD-3-Clause
// A surface buffer from one target to another.
uniform ivec2 begin;
uniform ivec2 end;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  OUT_SURFACE = texelFetch(inSurface, pixel, 0);
  WRITE_ID(texelFetch(inId, pixel, 0).r);
  WRITE_COLOR(texelFetch(inColor, pixel, 0));
}
