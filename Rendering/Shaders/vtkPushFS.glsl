// SPDX-License-Identifier: BSD-3-Clause
// Push: invalid and occluded pixels of a level from the coarser one (Marroquim et al. 2007, section 3.3).
// More constants, see vtkPullPushCommon.glsl: distanceWeights; depthTest, where only what is near the
// frontmost interval is averaged (not in the paper); hidesBacks, where backs give way to the front
// before them; blendsPixels, where pixels of the finest level that
// stay are averaged with what is at their depth; clips, where there are planes of clipping;
// trimsOutlines, where a point's own pixel shows it only if its disc covers the centre, but for
// outlineSlack pixels.
uniform ivec2 coarseBegin; // pixels outside of [begin, end) are invalid
uniform ivec2 coarseEnd;
uniform float fineSize;    // pixels of level 0 along a side of a fine pixel
uniform float outlineSlack;
uniform int numberOfClippingPlanes;
uniform vec4 clippingPlanes[6]; // in eye coordinates, of unit length

bool isInsideImage(ivec2 coarse)
{
  return all(greaterThanEqual(coarse, coarseBegin)) && all(lessThan(coarse, coarseEnd));
}

// Square of the distance of a point from an ellipse's centre, 1 on its edge: the orthogonal
// projection of a disc, as published. `toCenter` is in pixels of level 0.
float getEllipseDistance(vec4 shape, vec4 interval, vec2 toCenter)
{
  vec2 offset = getEyeOffset(toCenter, interval.x);
  float slope = length(shape.xy);
  if (slope >= 1e-6)
  {
    vec2 minor = shape.xy / slope;
    offset =
      vec2(dot(offset, minor) / max(abs(shape.z), 1e-3), dot(offset, vec2(-minor.y, minor.x)));
  }
  return dot(offset, offset) / (shape.w * shape.w);
}

// The same where the ray through `pixel` (in pixels of level 0) meets the plane of the disc itself,
// and the depth of that point. Far outside where the ray grazes the plane.
float getDiscDistance(vec4 shape, vec4 interval, vec2 pixel, vec2 toCenter, out float depth)
{
  depth = interval.x;
  vec2 ray = getRay(pixel).xy;
  float slope = dot(shape.xyz, vec3(ray, -1.0));
  if (abs(slope) < 1e-3)
  {
    return 4.0;
  }
  // the centre from where the ray is at the centre's depth, so that no large numbers cancel
  vec2 center = unshear(toCenter * (eyeRayStep.zw + interval.x * eyeRayStep.xy));
  float deeper = dot(shape.xy, center) / slope;
  depth += deeper;
  vec3 offset = vec3(deeper * ray - center, deeper) / shape.w;
  return dot(offset, offset);
}

float getDistance(vec4 shape, vec4 interval, vec2 pixel, out float depth)
{
  depth = interval.x;
  return centerDepths ? getDiscDistance(shape, interval, pixel, interval.zw, depth)
                      : getEllipseDistance(shape, interval, interval.zw);
}

// The weight of a disc that covers a pixel; `constant` is the paper's.
float getWeight(float distance, float constant)
{
  return distanceWeights ? max(1.0 - distance, 1e-6) * (1.0 + constant) : constant;
}

// Whether a point's disc covers the centre of its own pixel, but for the slack.
bool coversOwnPixel(vec4 shape, vec4 interval, vec2 pixel)
{
  float depth;
  float size = length(interval.zw);
  float share = max(size - outlineSlack, 0.0);
  return getDistance(shape, interval, pixel, depth) * share * share <= size * size;
}

// Whether all of the fine pixel, at a depth, is beyond a plane of clipping: then a disc hides
// nothing there.
bool isClipped(vec2 pixel, float depth)
{
  vec4 ray = getRay(pixel);
  vec4 position = vec4(ray.zw + depth * ray.xy, -depth, 1.0);
  float diagonal = max(
    length(getEyeOffset(vec2(1.0), depth)), length(getEyeOffset(vec2(1.0, -1.0), depth)));
  float reach = 0.71 * (fineSize - 1.0) * diagonal;
  bool clipped = false;
  for (int i = 0; i < numberOfClippingPlanes; ++i)
  {
    clipped = clipped || dot(clippingPlanes[i], position) < -reach;
  }
  return clipped;
}

// Depth of the surface at a pixel's own centre.
float getSurfaceDepth(vec4 shape, vec4 interval, vec2 pixel)
{
  float depth = interval.x;
  if (centerDepths &&
    getDiscDistance(shape, interval, pixel, interval.zw, depth) > 1.5)
  {
    return interval.x;
  }
  return depth;
}

// Whether a disc is the back of a surface and behind its front, of which normal and depth are given.
// What points nearly opposite to the front is rather of the same side, with a normal that was turned.
bool isBackOf(vec4 front, vec3 normal, float depth, vec2 pixel)
{
  return depth >= front.w && dot(normal, front.xyz) > -0.6 && !facesViewer(normal, pixel);
}

void main()
{
  ivec2 fine = ivec2(gl_FragCoord.xy);
  vec2 fineCenter = (vec2(fine) + 0.5) * fineSize;
  ivec2 parent = fine >> 1;
  vec4 shape = texelFetch(fineShape, fine, 0);
  vec4 interval = texelFetch(fineInterval, fine, 0);
#ifdef HAS_ID
  uint id = texelFetch(fineId, fine, 0).r;
#endif
#ifdef HAS_COLOR
  vec4 color = texelFetch(fineColor, fine, 0);
#endif

  // The back of a surface seen through a gap in its front: let the front reach twice as far.
  bool isBack = twoSided && shape.w > 0.0 && !facesViewer(shape.xyz, fineCenter);
#ifdef OUT_SURFACE
  bool covered = shape.w > 0.0 && (!trimsOutlines || coversOwnPixel(shape, interval, fineCenter));
  bool blends = blendsPixels && !isBack; // a back stays alone, for the fill to find
#else
  bool covered = shape.w > 0.0;
  bool blends = false;
#endif
  vec2 ownRange = getDepthRange(shape, interval);
  vec4 parentShape = texelFetch(coarseShape, parent, 0); // which is inside of the image
  vec4 parentInterval = texelFetch(coarseInterval, parent, 0);
  vec2 parentRange = getDepthRange(parentShape, parentInterval);
  bool keep = covered && ownRange.x >= parentRange.x && ownRange.x <= parentRange.y;
  bool mayBeHidden = hidesBacks && !blendsPixels && isBack;
  if (!keep || blends || mayBeHidden)
  {
    ivec2 toNeighbor = 2 * (fine & 1) - 1;
    vec4 shapes[4];
    vec4 intervals[4];
    float weights[4];
    float nearness[4]; // to the centre; the id is that of the nearest one
    float front = 3.4e38;
    float frontEnd = 3.4e38;
    vec4 facing = vec4(0.0, 0.0, 0.0, 3.4e38); // the nearest that faces the viewer: normal, depth
    for (int i = 0; i < 4; ++i)
    {
      ivec2 isNeighbor = ivec2(i & 1, i >> 1);
      ivec2 coarse = parent + toNeighbor * isNeighbor;
      weights[i] = 0.0;
      nearness[i] = 0.0;
      shapes[i] = parentShape;
      intervals[i] = parentInterval;
      if (i > 0)
      {
        shapes[i] = isInsideImage(coarse) ? texelFetch(coarseShape, coarse, 0) : vec4(0.0);
        intervals[i] = isInsideImage(coarse) ? texelFetch(coarseInterval, coarse, 0) : vec4(0.0);
      }
      // the displacement becomes relative to the fine pixel
      intervals[i].zw += (2.0 * vec2(coarse) + 1.0) * fineSize - fineCenter;
      float depth;
      float distance = getDistance(shapes[i], intervals[i], fineCenter, depth);
      if (shapes[i].w > 0.0 &&
        distance <= (isBack && facesViewer(shapes[i].xyz, fineCenter) ? 4.0 : 1.0) &&
        !(clips && isClipped(fineCenter, depth)))
      {
        // biquadratic B-spline subdivision: 9, 3, 3, 1 of 16
        float constant = (isNeighbor.x == 0 ? 0.75 : 0.25) * (isNeighbor.y == 0 ? 0.75 : 0.25);
        weights[i] = getWeight(distance, constant);
        nearness[i] = distanceWeights ? max(1.0 - distance, 1e-6) : constant;
        vec2 range = getDepthRange(shapes[i], intervals[i]);
        if (depthTest && range.x < front)
        {
          // an interval is one radius long; a slanted surface runs through two from pixel to pixel
          front = range.x;
          frontEnd = 2.0 * range.y - range.x;
        }
        if (hidesBacks && intervals[i].x < facing.w && facesViewer(shapes[i].xyz, fineCenter))
        {
          facing = vec4(shapes[i].xyz, intervals[i].x);
        }
      }
    }

    keep = keep && !(mayBeHidden && isBackOf(facing, shape.xyz, interval.x, fineCenter));
    // a pixel that stays is averaged with what is at its depth
    bool alone = keep && !blends;
    float ownDepth;
    float sum = keep && blends ? getWeight(getDistance(shape, interval, fineCenter, ownDepth), 1.0) : 0.0;
    float ownEnd = 2.0 * ownRange.y - ownRange.x;
    vec4 newShape = keep ? sum * shape : vec4(0.0);
    vec4 newInterval = keep ? sum * interval : vec4(0.0);
    vec3 mainNormal = keep ? shape.xyz : vec3(0.0);
    float mainNearness = 0.0;
#ifdef HAS_ID
    uint newId = keep ? id : 0u;
#endif
#ifdef HAS_COLOR
    vec4 newColor = keep ? sum * color : vec4(0.0);
#endif
    for (int i = 0; i < 4; ++i)
    {
      vec2 range = getDepthRange(shapes[i], intervals[i]);
      bool isDropped = keep ? range.x > ownEnd || range.y < ownRange.x : range.x > frontEnd;
      bool isHidden = hidesBacks && isBackOf(facing, shapes[i].xyz, intervals[i].x, fineCenter);
      float weight = alone || isDropped || isHidden ? 0.0 : weights[i];
      ivec2 coarse = parent + toNeighbor * ivec2(i & 1, i >> 1);
      bool turns = twoSided && dot(shapes[i].xyz, mainNormal) < 0.0;
      shapes[i].xyz = turns ? -shapes[i].xyz : shapes[i].xyz;
      newShape += weight * shapes[i];
      newInterval += weight * intervals[i];
      sum += weight;
#ifdef HAS_COLOR
      newColor += weight * texelFetch(coarseColor, coarse, 0);
#endif
      if (!keep && weight > 0.0 && nearness[i] > mainNearness)
      {
        mainNearness = nearness[i];
        mainNormal = shapes[i].xyz;
#ifdef HAS_ID
        newId = texelFetch(coarseId, coarse, 0).r;
#endif
      }
    }
    // where nothing else covers the pixel, an occluded one is seen after all
    if (sum > 0.0)
    {
      float size = length(newShape.xyz);
      shape.xyz = size < 1e-6 ? mainNormal : newShape.xyz / size;
      shape.w = newShape.w / sum;
      interval = newInterval / sum;
#ifdef HAS_ID
      id = newId;
#endif
#ifdef HAS_COLOR
      color = newColor / sum;
#endif
    }
    else if (!covered)
    {
      shape = vec4(0.0);
#ifdef HAS_ID
      id = 0u;
#endif
#ifdef HAS_COLOR
      color = vec4(0.0);
#endif
    }
  }

#ifdef OUT_SURFACE
  vec4 surface = shape.w > 0.0
    ? vec4(shape.xyz, getSurfaceDepth(shape, interval, fineCenter))
    : vec4(0.0);
  OUT_SURFACE = surface;
#ifdef MARKS_UNFILLED
  bool staysBack = twoSided && !facesViewer(surface.xyz, fineCenter);
  gl_FragDepth = surface.w == 0.0 || staysBack ? 0.0 : 1.0; // 0: see vtkFillFS.glsl
#endif
#else
  OUT_SHAPE = shape;
  OUT_INTERVAL = interval;
#endif
  WRITE_ID(id);
  WRITE_COLOR(color);
}
