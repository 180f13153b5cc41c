// SPDX-License-Identifier: BSD-3-Clause
// Project: each point goes to at most one pixel (Marroquim et al. 2007, section 3.1). After
// vtkPointAttributes.glsl. What is drawn of the points, a constant before this text: ALL_POINTS;
// ONLY_FARTHEST, of each pixel those within the tolerance behind its nearest one; ONLY_COMPANIONS, those
// behind the nearest one by no more than its radius, or than its plane is within a pixel.
uniform vec2 depthRange;     // eye depths between which the cloud lies
uniform bool subpixelCenters;
uniform bool centerDepths;   // see vtkPullFS.glsl
uniform float depthTolerance;
uniform float largestReach;  // in radii
uniform sampler2D nearestShape;
uniform sampler2D nearestInterval;
uniform usampler2D nearestId;
uniform sampler2D nearestColor;
uniform bool twoSided;       // normals may point to either side

flat out vec4 shape;
flat out vec4 interval;
flat out vec4 color;
flat out uint id;
flat out vec4 nearestSurface;

#ifdef ONLY_COMPANIONS
// Where a point is in eye coordinates that falls on a place of the window, at an eye depth and its w.
vec4 getEyePosition(vec2 window, float depth, float w)
{
  vec2 clip = w * (2.0 * window / targetSize - 1.0) + depth * VCDCMatrix[2].xy - VCDCMatrix[3].xy;
  float y = clip.y / VCDCMatrix[1].y;
  return vec4((clip.x - VCDCMatrix[1].x * y) / VCDCMatrix[0].x, y, -depth, 1.0);
}
#endif

void main()
{
  vec4 position = MCVCMatrix * vertexMC;
  vec3 toViewer = getToViewer(position);
  vec3 normal = getNormal(toViewer);
  bool facesViewer = dot(normal, toViewer) >= 0.0;
  float depth = -position.z;
  float radius = getRadius();
  shape = vec4(normal, radius);
  color = getColor();
  id = pointId + uint(firstId) + 1u;

  gl_PointSize = 1.0;
  gl_Position = VCDCMatrix * position;
  if (!isVisible(position, gl_Position, 0.0, facesViewer))
  {
    interval = vec4(0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
  // The pixel is chosen here, not by the rasteriser with its own rounding.
  vec2 window = 0.5 * targetSize * (gl_Position.xy / gl_Position.w + 1.0);
  vec2 center = floor(window) + 0.5;
#ifndef ALL_POINTS
  ivec2 pixel = clamp(ivec2(center), ivec2(0), ivec2(targetSize) - 1);
  vec4 nearest = texelFetch(nearestInterval, pixel, 0);
#ifdef ONLY_FARTHEST
  bool isWanted = depth <= nearest.x + depthTolerance;
#else
  // The nearest point's slope is seen along its own view: in a large pixel that of others differs.
  vec4 disc = texelFetch(nearestShape, pixel, 0);
  float w = VCDCMatrix[3].w - VCDCMatrix[2].w * nearest.x;
  float along = dot(disc.xyz, getToViewer(getEyePosition(center + nearest.zw, nearest.x, w)));
  float slope = sqrt(max(1.0 - along * along, 0.0)) / max(abs(along), 1.0 / largestReach);
  float pixelSize = 2.0 * w / (targetSize.y * abs(VCDCMatrix[1].y));
  float reach = disc.w * clamp(pixelSize * slope / disc.w, 1.0, largestReach);
  bool isWanted = depth <= nearest.x + reach && texelFetch(nearestId, pixel, 0).r != id;
#endif
  if (!isWanted)
  {
    interval = vec4(0.0);
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    return;
  }
#endif
  gl_Position.xy = (2.0 * center / targetSize - 1.0) * gl_Position.w;
  interval.xy = centerDepths ? vec2(depth, 0.0) : vec2(depth, depth + radius);
  interval.zw = subpixelCenters ? window - center : vec2(0.0);

#ifdef ONLY_COMPANIONS
  // What the point adds to the nearest one: its normal, one to their number, and how its other values differ.
  float side = twoSided && dot(normal, disc.xyz) < 0.0 ? -1.0 : 1.0;
  shape = vec4(side * normal, 1.0);
  interval = vec4(depth - nearest.x, radius - disc.w, interval.zw - nearest.zw);
  color -= texelFetch(nearestColor, pixel, 0);
  nearestSurface = vec4(disc.xyz, nearest.x);
  // the least depth marks pixels that have sums; exactly, so with no division by another w
  gl_Position = vec4(2.0 * center / targetSize - 1.0, -1.0, 1.0);
#else
  // Linear depth over the cloud's own range: the same precision everywhere, whatever the camera's
  // clipping range is.
  float linear = (depth - depthRange.x) / (depthRange.y - depthRange.x);
  gl_Position.z = (2.0 * clamp(linear, 0.0, 1.0) - 1.0) * gl_Position.w;
#endif
}
