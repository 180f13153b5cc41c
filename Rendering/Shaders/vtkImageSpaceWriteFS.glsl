// SPDX-License-Identifier: BSD-3-Clause
// A filtered image to where the delegate would have drawn. OUTPUTS says what is taken besides colour
// and depth: 0 nothing, 1 the normal, 2 the position and the normal.
uniform sampler2D inSurface;
uniform sampler2D inColor;
uniform sampler2D depths; // window depths that the distances came from
uniform ivec2 origin;     // of the viewport

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy) - origin;
  vec4 surface = texelFetch(inSurface, pixel, 0);
  float depth = texelFetch(depths, pixel, 0).r;
  float before = toSurfaceDistance(depth);
  gl_FragData[0] = texelFetch(inColor, pixel, 0);
#if OUTPUTS == 1
  gl_FragData[1] = vec4(surface.xyz, surface.w > 0.0 ? 1.0 : 0.0);
#elif OUTPUTS == 2
  vec2 place = 2.0 * (vec2(pixel) + 0.5) / vec2(textureSize(inSurface, 0)) - 1.0;
  gl_FragData[1] = surface.w > 0.0 ? vec4(toPosition(place, surface.w), 1.0) : vec4(0.0);
  gl_FragData[2] = vec4(surface.xyz, surface.w > 0.0 ? 1.0 : 0.0);
#endif
  // what no filter has changed keeps its depth to the last bit
  gl_FragDepth = surface.w == before ? depth : surface.w > 0.0 ? toWindowDepth(surface.w) : 1.0;
}
