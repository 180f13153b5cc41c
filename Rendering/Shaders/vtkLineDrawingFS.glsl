// SPDX-License-Identifier: BSD-3-Clause
// Draws found lines in a colour, widened by `reach` pixels to each side (Rosenthal and Linsen 2008,
// section 8).
uniform ivec2 begin; // nothing is known outside of [begin, end)
uniform ivec2 end;
uniform vec3 lineColor;
uniform float reach;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 color = texelFetch(inColor, pixel, 0);
  int far = int(ceil(max(reach, 0.0)));
  float line = 0.0;
  for (int y = -far; y <= far; ++y)
  {
    for (int x = -far; x <= far; ++x)
    {
      ivec2 place = pixel + ivec2(x, y);
      if (all(greaterThanEqual(place, begin)) && all(lessThan(place, end)))
      {
        float share = clamp(reach + 1.0 - length(vec2(x, y)), 0.0, 1.0);
        line = max(line, share * texelFetch(lineShape, place, 0).x);
      }
    }
  }
  OUT_SURFACE = texelFetch(inSurface, pixel, 0);
  OUT_COLOR = mix(color, vec4(lineColor, 1.0), line);
}
