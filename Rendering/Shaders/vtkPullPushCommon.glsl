// SPDX-License-Identifier: BSD-3-Clause
// What pull and push have in common: the meaning of a pixel's two layers.
//   shape:    xyz normal, w radius in eye units (0: invalid)
//   interval: xy depth, zw displacement from the pixel's centre to the disc's, in pixels of level 0
// As published, depth is the least and the largest depth. With centerDepths it is the depth of the
// disc's centre and half of the depth that the disc's points span around it, so that a disc has a
// place in space.
uniform bool centerDepths;
uniform vec4 pixelToEye; // xy: eye units a pixel where w is 1; zw: w = z * depth + w
uniform bool twoSided;   // normals may point to either side

vec2 getDepthRange(vec4 shape, vec4 interval)
{
  return centerDepths
    ? vec2(interval.x - interval.y, interval.x + interval.y + shape.w)
    : interval.xy;
}

// An offset in pixels of level 0, in eye units at a depth.
vec2 getEyeOffset(vec2 pixels, float depth)
{
  return pixels * pixelToEye.xy * (pixelToEye.z * depth + pixelToEye.w);
}
