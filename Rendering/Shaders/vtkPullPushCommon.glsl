// SPDX-License-Identifier: BSD-3-Clause
// What the steps of pull-push have in common: the meaning of a pixel's two layers, and its ray.
//   shape:    xyz normal, w radius in eye units (0: invalid)
//   interval: xy depth, zw displacement from the pixel's centre to the disc's, in pixels of level 0
// As published, depth is the least and the largest depth. With centerDepths it is the depth of the
// disc's centre and half of the depth that the disc's points span around it, so that a disc has a
// place in space.
// Options that are the same for all pixels are constants, put before this text: centerDepths;
// twoSided, where normals may point to either side.
uniform vec4 pixelToEye; // xy: eye units a pixel where w is 1; zw: w = z * depth + w
uniform vec4 eyeRay;     // xy: the ray's direction through the pixel (0, 0); zw: its origin
uniform vec4 eyeRayStep; // change of these a pixel of level 0
uniform float shear;     // in a sheared picture eye x is less than by these by that times y

vec2 getDepthRange(vec4 shape, vec4 interval)
{
  return centerDepths
    ? vec2(interval.x - interval.y, interval.x + interval.y + shape.w)
    : interval.xy;
}

vec2 unshear(vec2 eye)
{
  return vec2(eye.x - shear * eye.y, eye.y);
}

// An offset in pixels of level 0, in eye units at a depth.
vec2 getEyeOffset(vec2 pixels, float depth)
{
  return unshear(pixels * pixelToEye.xy * (pixelToEye.z * depth + pixelToEye.w));
}

// Direction and origin of the ray through a place in pixels of level 0.
vec4 getRay(vec2 pixel)
{
  vec4 ray = eyeRay + vec4(pixel, pixel) * eyeRayStep;
  return vec4(unshear(ray.xy), unshear(ray.zw));
}

bool facesViewer(vec3 normal, vec2 pixel)
{
  return dot(normal, vec3(getRay(pixel).xy, -1.0)) <= 0.0;
}
