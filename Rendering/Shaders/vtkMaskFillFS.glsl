// SPDX-License-Identifier: BSD-3-Clause
// Fill by masks (Rosenthal and Linsen 2008, sections 4 and 5), see vtkMaskFillOptions.h. With
// COUNTING only the pixels that are filled pass, and nothing is written.
uniform ivec2 begin; // pixels outside of [begin, end) are background
uniform ivec2 end;
uniform bool occluded;   // fill surfaces that are hidden, else the background
uniform vec2 depthStep; // between two layers of surface, see vtkDepthStep.h
uniform int reach; // over 0: the surface must be seen within so many pixels

const ivec2 ring[8] = ivec2[8](ivec2(1, 0), ivec2(1, 1), ivec2(0, 1), ivec2(-1, 1), ivec2(-1, 0),
  ivec2(-1, -1), ivec2(0, -1), ivec2(1, -1));
const float infinite = 3.4e38;

float getDepth(ivec2 place)
{
  bool inside = all(greaterThanEqual(place, begin)) && all(lessThan(place, end));
  return inside ? texelFetch(inSurface, place, 0).w : 0.0;
}

// Whether the bits of `length` neighbouring directions are set.
bool hasRun(int directions, int length)
{
  int twice = directions | directions << 8; // around the ring's end
  int runs = twice;
  for (int i = 1; i < length; ++i)
  {
    runs &= twice >> i;
  }
  return (runs & 255) != 0;
}

// Directions, of those in `beyond`, in which there is no surface in front within reach.
int findOpenDirections(ivec2 pixel, float limit, int beyond)
{
  int open = beyond;
  for (int i = 0; i < 8; ++i)
  {
    for (int far = 2; far <= reach && (open & 1 << i) != 0; ++far)
    {
      float depth = getDepth(pixel + far * ring[i]);
      open &= depth > 0.0 && depth <= limit ? ~(1 << i) : ~0;
    }
  }
  return open;
}

// The pixel to fill this one from, or this one itself where it stays as it is.
ivec2 findSource(ivec2 pixel, vec4 surface)
{
  if (occluded != (surface.w > 0.0))
  {
    return pixel;
  }
  float limit = occluded ? surface.w - (depthStep.x * surface.w + depthStep.y) : infinite;
  int beyond = 0;
  float nearest = infinite;
  ivec2 source = pixel;
  for (int i = 0; i < 8; ++i)
  {
    ivec2 place = pixel + ring[i];
    float depth = getDepth(place);
    bool inFront = depth > 0.0 && depth <= limit;
    beyond |= inFront ? 0 : 1 << i;
    if (inFront && depth < nearest)
    {
      nearest = depth;
      source = place;
    }
  }
  if (hasRun(beyond, 5) || (reach > 0 && hasRun(findOpenDirections(pixel, limit, beyond), 3)))
  {
    return pixel;
  }
  return source;
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(inSurface, pixel, 0);
  ivec2 source = findSource(pixel, surface);
#ifdef COUNTING
  if (source == pixel)
  {
    discard;
  }
#else
  OUT_SURFACE = texelFetch(inSurface, source, 0);
  WRITE_ID(texelFetch(inId, source, 0).r);
  WRITE_COLOR(texelFetch(inColor, source, 0));
#endif
}
