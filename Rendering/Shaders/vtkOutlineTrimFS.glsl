// SPDX-License-Identifier: BSD-3-Clause
// Trim: where the points of a pixel lie to one side of its centre and on the other side the surface
// does not go on, an outline runs between them and the centre. The pixel becomes empty, or shows what
// is behind. After vtkPullPushCommon.glsl.
uniform ivec2 begin; // pixels outside of [begin, end) are empty
uniform ivec2 end;
uniform ivec2 size;  // of the whole image
uniform float largestOffset; // of the points from the centre, in pixels

// How a surface goes on from one pixel to another.
const int GoesOn = 0;
const int Nothing = 1;
const int Behind = 2;

// The centre of a pixel's disc in eye coordinates.
vec3 getPosition(ivec2 pixel, vec4 interval)
{
  vec4 ray = getRay(vec2(pixel) + 0.5 + interval.zw);
  return vec3(ray.zw + interval.x * ray.xy, -interval.x);
}

int getNeighbor(ivec2 pixel, vec4 shape, vec4 interval, ivec2 offset)
{
  ivec2 place = pixel + offset;
  if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, size)))
  {
    return GoesOn; // for all that is known
  }
  bool inside = all(greaterThanEqual(place, begin)) && all(lessThan(place, end));
  if (!inside || !(texelFetch(inShape, place, 0).w > 0.0))
  {
    return Nothing;
  }
  vec4 otherInterval = texelFetch(inInterval, place, 0);
  vec3 toOther = getPosition(place, otherInterval) - getPosition(pixel, interval);
  bool isFarther = otherInterval.x > interval.x + shape.w;
  return isFarther && abs(dot(shape.xyz, toOther)) > shape.w ? Behind : GoesOn;
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 shape = texelFetch(inShape, pixel, 0);
  vec4 interval = texelFetch(inInterval, pixel, 0);
  ivec2 source = pixel; // what the pixel shows
  int other = GoesOn;
  float largest = largestOffset;
  for (int axis = 0; axis < 2 && shape.w > 0.0; ++axis)
  {
    float center = interval[2 + axis];
    ivec2 away = ivec2(0);
    away[axis] = center > 0.0 ? -1 : 1;
    // of what is no wider than two pixels nothing would be left
    if (!(abs(center) > largest) || getNeighbor(pixel, shape, interval, -away) != GoesOn ||
      getNeighbor(pixel, shape, interval, -2 * away) != GoesOn)
    {
      continue;
    }
    // an outline, not a gap of one pixel: the surface ends beside it too
    int opposite = getNeighbor(pixel, shape, interval, away);
    if (opposite != GoesOn &&
      (getNeighbor(pixel, shape, interval, away + away.yx) != GoesOn ||
        getNeighbor(pixel, shape, interval, away - away.yx) != GoesOn))
    {
      largest = abs(center);
      other = opposite;
      source = pixel + away;
    }
  }
  bool isEmpty = other == Nothing;
  OUT_SHAPE = isEmpty ? vec4(0.0) : texelFetch(inShape, source, 0);
  // what is behind as it is beside the pixel: its disc need not reach over here
  OUT_INTERVAL = isEmpty ? vec4(0.0) : texelFetch(inInterval, source, 0);
  WRITE_ID(isEmpty ? 0u : texelFetch(inId, source, 0).r);
  WRITE_COLOR(isEmpty ? vec4(0.0) : texelFetch(inColor, source, 0));
}
