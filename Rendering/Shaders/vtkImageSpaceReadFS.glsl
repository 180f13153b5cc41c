// SPDX-License-Identifier: BSD-3-Clause
// What a delegate has drawn as a surface buffer with colours.
uniform sampler2D colors;
uniform sampler2D normals; // w: 0 where none has been written
uniform sampler2D depths;  // window depths, 1 where nothing has been drawn

float getDistance(ivec2 pixel)
{
  return toSurfaceDistance(
    texelFetch(depths, clamp(pixel, ivec2(0), textureSize(depths, 0) - 1), 0).r);
}

vec3 getPosition(ivec2 pixel, float distance)
{
  vec2 place = 2.0 * (vec2(pixel) + 0.5) / vec2(textureSize(depths, 0)) - 1.0;
  return toPosition(place, distance);
}

// Along the surface, to the neighbour that is nearer in depth.
vec3 getTangent(ivec2 pixel, ivec2 side, float distance)
{
  float before = getDistance(pixel - side);
  float after = getDistance(pixel + side);
  bool takeAfter = before <= 0.0 || (after > 0.0 && abs(after - distance) < abs(before - distance));
  vec3 own = getPosition(pixel, distance);
  if (takeAfter)
  {
    return after > 0.0 ? getPosition(pixel + side, after) - own : vec3(vec2(side), 0.0);
  }
  return own - getPosition(pixel - side, before);
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float distance = getDistance(pixel);
  vec4 normal = texelFetch(normals, pixel, 0);
  vec3 direction = normal.xyz;
  if (distance > 0.0 && (normal.w <= 0.0 || dot(direction, direction) == 0.0))
  {
    vec3 along = getTangent(pixel, ivec2(1, 0), distance);
    vec3 up = getTangent(pixel, ivec2(0, 1), distance);
    direction = cross(along, up);
  }
  OUT_SURFACE = distance > 0.0 ? vec4(normalize(direction), distance) : vec4(0.0);
  OUT_COLOR = texelFetch(colors, pixel, 0);
}
