// SPDX-License-Identifier: BSD-3-Clause
// The cells of the image buffer from the projected points (Kawata and Kanai, section 3.2).

vec3 getPosition(vec4 interval)
{
  vec2 place = gl_FragCoord.xy + interval.zw;
  vec4 ray = eyeRay + vec4(place, place) * eyeRayStep;
  vec2 position = ray.zw + interval.x * ray.xy;
  return vec3(position.x - shear * position.y, position.y, -interval.x);
}

void main()
{
  ivec2 cell = ivec2(gl_FragCoord.xy);
  bool occupied = texelFetch(nearestShape, cell, 0).w > 0.0;
  vec3 near = occupied ? getPosition(texelFetch(nearestInterval, cell, 0)) : vec3(0.0);
  vec3 far = occupied ? getPosition(texelFetch(farthestInterval, cell, 0)) : vec3(0.0);
  OUT_SHAPE = vec4(near, occupied ? 1.0 : 0.0);
  OUT_INTERVAL = vec4(far, occupied ? 1.0 : 0.0);
  WRITE_ID(texelFetch(nearestId, cell, 0).r);
  WRITE_COLOR(0.5 * (texelFetch(nearestColor, cell, 0) + texelFetch(farthestColor, cell, 0)));
}
