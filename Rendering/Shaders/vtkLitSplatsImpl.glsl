// SPDX-License-Identifier: BSD-3-Clause
// Splats of lit colours (Kawata and Kanai, sections 3.3 and 3.4): psShade() is VTK's main(). It lights
// each splat that covers the pixel, then the pixel takes their mean and goes on as it is.

void main()
{
  if (texelFetch(psSurface, ivec2(gl_FragCoord.xy) - psOrigin, 0).w <= 0.0)
  {
    discard;
  }
  vec2 place = (gl_FragCoord.xy - vec2(psOrigin)) * pixelToCell;
  float front = getFront(place);
  psLightsSplat = true;
  for (int level = 0; level < levels; ++level)
  {
    ivec4 cells = getCells(place, level);
    for (int y = cells.y; y < cells.w; ++y)
    {
      for (int x = cells.x; x < cells.z; ++x)
      {
        psSplat = ivec2(x, y) + levelOffset[level];
        Splat splat = getSplat(psSplat, place);
        psGone = false;
        if (counts(splat, front))
        {
          psShade();
          psLit += psGone ? vec4(0.0) : splat.weight * gl_FragData[0];
          psWeight += psGone ? 0.0 : splat.weight;
        }
      }
    }
  }
  psLightsSplat = false;
  psGone = false;
  psShade();
  if (psGone)
  {
    discard;
  }
}
