// SPDX-License-Identifier: BSD-3-Clause
// One-pixel projections to a surface whose gaps the points' discs fill; see vtkDiscFillOptions.h.
uniform ivec2 begin; // pixels outside of [begin, end) are background
uniform ivec2 end;
uniform int reach; // pixels to each side; 0: nothing is filled
uniform float layerDistance;
uniform float radiusShare;
uniform float lowPassVariance;
uniform float nearLimit;
uniform vec4 eyeRay;     // xy: the ray's direction through the pixel (0, 0); zw: its origin
uniform vec4 eyeRayStep; // change of these a pixel
uniform float shear;     // in a sheared picture eye x is less than by these by that times y
uniform int numberOfClippingPlanes;
uniform vec4 clippingPlanes[6];

const float infinite = 3.4e38;

vec2 unshear(vec2 eye)
{
  return vec2(eye.x - shear * eye.y, eye.y);
}

float getDepth(ivec2 place)
{
  bool inside = all(greaterThanEqual(place, begin)) && all(lessThan(place, end));
  return inside ? texelFetch(inInterval, place, 0).x : 0.0;
}

bool isClipped(vec3 position)
{
  bool clipped = false;
  for (int i = 0; i < numberOfClippingPlanes; ++i)
  {
    clipped = clipped || dot(clippingPlanes[i], vec4(position, 1.0)) < 0.0;
  }
  return clipped;
}

// How far out a pixel lies in the disc of the point of another: 1 is its edge.
float getDistance(ivec2 pixel, ivec2 place)
{
  vec4 shape = texelFetch(inShape, place, 0);
  vec4 interval = texelFetch(inInterval, place, 0);
  vec2 center = vec2(place) + 0.5 + interval.zw;
  vec4 ray = eyeRay + vec4(center, center) * eyeRayStep;
  vec2 direction = unshear(ray.xy);
  vec2 pixelSize = eyeRayStep.zw + interval.x * eyeRayStep.xy;
  vec2 offset = unshear((vec2(pixel) + 0.5 - center) * pixelSize);

  // The disc seen along the ray, across the view; in heights of a pixel, as single precision does not
  // hold fourth powers of any length.
  float heights = 1.0 / pixelSize.y;
  float radius = heights * radiusShare * shape.w;
  vec2 size = heights * pixelSize;
  vec2 away = heights * offset;
  vec2 normal = shape.xy + direction * shape.z;
  vec3 moment = radius * radius *
    vec3(1.0 + direction.x * direction.x - normal.x * normal.x,
      1.0 + direction.y * direction.y - normal.y * normal.y,
      direction.x * direction.y - normal.x * normal.y);
  moment.xy += lowPassVariance * size * size;
  float q = (moment.y * away.x * away.x - 2.0 * moment.z * away.x * away.y +
    moment.x * away.y * away.y) / (moment.x * moment.y - moment.z * moment.z);

  if (numberOfClippingPlanes > 0 && q <= 1.0)
  {
    float slope = dot(shape.xyz, vec3(direction, -1.0));
    float depth = -dot(shape.xy, offset) / (slope < 0.0 ? min(slope, -0.1) : max(slope, 0.1));
    vec3 position = vec3(unshear(ray.zw) + interval.x * direction + offset + depth * direction,
      -interval.x - depth);
    q = isClipped(position) ? infinite : q;
  }
  return q;
}

// The distance from another pixel's disc, infinite where its point is missing or beyond a depth.
float getDistanceWithin(ivec2 pixel, ivec2 place, float limit)
{
  float depth = getDepth(place);
  if (depth > 0.0 && depth <= limit && place != pixel)
  {
    return getDistance(pixel, place);
  }
  return infinite;
}

// The pixel whose point fills this one, or this one itself where it stays as it is.
ivec2 findSource(ivec2 pixel, float own)
{
  float limit = own > 0.0 ? own - layerDistance : infinite;
  float front = infinite; // depth of the nearest disc around the pixel
  int near = 0;
  for (int y = -reach; y <= reach; ++y)
  {
    for (int x = -reach; x <= reach; ++x)
    {
      ivec2 place = pixel + ivec2(x, y);
      float q = getDistanceWithin(pixel, place, limit);
      near += q <= nearLimit ? 1 : 0;
      front = q <= 1.0 ? min(front, getDepth(place)) : front;
    }
  }
  ivec2 source = pixel;
  if (front == infinite || near < 2)
  {
    return source;
  }
  limit = min(limit, front + layerDistance);
  float least = infinite;
  for (int y = -reach; y <= reach; ++y)
  {
    for (int x = -reach; x <= reach; ++x)
    {
      ivec2 place = pixel + ivec2(x, y);
      float q = getDistanceWithin(pixel, place, limit);
      source = q < least ? place : source;
      least = min(q, least);
    }
  }
  return source;
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 source = findSource(pixel, getDepth(pixel));
  float depth = getDepth(source);
  OUT_SURFACE = depth > 0.0 ? vec4(texelFetch(inShape, source, 0).xyz, depth) : vec4(0.0);
  WRITE_ID(texelFetch(inId, source, 0).r);
  WRITE_COLOR(texelFetch(inColor, source, 0));
}
