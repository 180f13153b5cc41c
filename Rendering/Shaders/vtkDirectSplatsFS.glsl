// SPDX-License-Identifier: BSD-3-Clause
// The surface buffer from splats of all levels, with Gaussian weights (Kawata and Kanai, section 3.4).

void main()
{
  vec2 place = gl_FragCoord.xy * pixelToCell;
  float front = getFront(place);
  float sum = 0.0;
  float largest = 0.0;
  vec4 surface = vec4(0.0);
#ifdef HAS_ID
  uint id = 0u;
#endif
#ifdef HAS_COLOR
  vec4 color = vec4(0.0);
#endif
  for (int level = 0; level < levels; ++level)
  {
    ivec4 cells = getCells(place, level);
    for (int y = cells.y; y < cells.w; ++y)
    {
      for (int x = cells.x; x < cells.z; ++x)
      {
        ivec2 texel = ivec2(x, y) + levelOffset[level];
        Splat splat = getSplat(texel, place);
        if (!counts(splat, front))
        {
          continue;
        }
        sum += splat.weight;
        surface += splat.weight * vec4(splat.normal, splat.depth);
#ifdef HAS_COLOR
        color += splat.weight * texelFetch(inColor, texel, 0);
#endif
        if (splat.weight > largest)
        {
          largest = splat.weight;
#ifdef HAS_ID
          id = texelFetch(inId, texel, 0).r;
#endif
        }
      }
    }
  }
  if (sum > 0.0)
  {
    surface = vec4(surface.xyz / max(length(surface.xyz), 1e-20), surface.w / sum);
#ifdef HAS_COLOR
    color /= sum;
#endif
  }
  OUT_SURFACE = surface;
  WRITE_ID(id);
  WRITE_COLOR(color);
}
