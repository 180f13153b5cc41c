// SPDX-License-Identifier: BSD-3-Clause
// Anti-aliasing of edges in depth (Rosenthal and Linsen 2008, section 7).
uniform ivec2 begin; // nothing is known outside of [begin, end)
uniform ivec2 end;
uniform vec2 threshold; // of the Laplace filter, see vtkDepthStep.h

bool isInside(ivec2 place)
{
  return all(greaterThanEqual(place, begin)) && all(lessThan(place, end));
}

bool isEdge(ivec2 pixel, float own)
{
  const ivec2 sides[4] = ivec2[4](ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1));
  float laplace = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    ivec2 place = pixel + sides[i];
    float other = isInside(place) ? texelFetch(inSurface, place, 0).w : own;
    if ((other > 0.0) != (own > 0.0))
    {
      return true;
    }
    laplace += own - other;
  }
  return abs(laplace) > threshold.x * own + threshold.y;
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(inSurface, pixel, 0);
  vec4 color = texelFetch(inColor, pixel, 0);
  if (isEdge(pixel, surface.w))
  {
    vec4 sum = vec4(0.0);
    float total = 0.0;
    for (int i = 0; i < 9; ++i)
    {
      ivec2 offset = ivec2(i % 3, i / 3) - 1;
      if (isInside(pixel + offset))
      {
        float weight = float(4 >> (abs(offset.x) + abs(offset.y)));
        sum += weight * texelFetch(inColor, pixel + offset, 0);
        total += weight;
      }
    }
    color = sum / total;
  }
  OUT_SURFACE = surface;
  OUT_COLOR = color;
}
