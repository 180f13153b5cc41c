// SPDX-License-Identifier: BSD-3-Clause
// Push: invalid and occluded pixels of a level from the coarser one (Marroquim et al. 2007, section 3.3).
uniform ivec2 coarseBegin; // pixels outside of [begin, end) are invalid
uniform ivec2 coarseEnd;
uniform float fineSize;    // pixels of level 0 along a side of a fine pixel
uniform vec4 pixelToEye;   // xy: eye units a pixel where w is 1; zw: w = z * depth + w
uniform bool twoSided;     // normals may point to either side
uniform bool depthTest;    // only what is near the frontmost interval is averaged (not in the paper)

// Whether the ellipse of a coarse pixel, the orthogonal projection of its disc, holds the point
// that is `offset` pixels of level 0 away from the ellipse's centre.
bool isInsideEllipse(vec4 shape, vec4 interval, vec2 offset)
{
  vec2 eye = offset * pixelToEye.xy * (pixelToEye.z * interval.x + pixelToEye.w);
  float slope = length(shape.xy);
  if (slope >= 1e-6)
  {
    vec2 minor = shape.xy / slope;
    eye = vec2(dot(eye, minor) / max(abs(shape.z), 1e-3), dot(eye, vec2(-minor.y, minor.x)));
  }
  return dot(eye, eye) <= shape.w * shape.w;
}

bool isInsideImage(ivec2 coarse)
{
  return all(greaterThanEqual(coarse, coarseBegin)) && all(lessThan(coarse, coarseEnd));
}

void main()
{
  ivec2 fine = ivec2(gl_FragCoord.xy);
  ivec2 parent = fine >> 1;
  vec4 shape = texelFetch(fineShape, fine, 0);
  vec4 interval = texelFetch(fineInterval, fine, 0);
#ifdef HAS_ID
  uint id = texelFetch(fineId, fine, 0).r;
#endif
#ifdef HAS_COLOR
  vec4 color = texelFetch(fineColor, fine, 0);
#endif

  bool keep = false;
  if (shape.w > 0.0)
  {
    vec2 parentInterval = texelFetch(coarseInterval, parent, 0).xy;
    keep = interval.x >= parentInterval.x && interval.x <= parentInterval.y;
  }
  if (!keep)
  {
    ivec2 toNeighbor = 2 * (fine & 1) - 1;
    vec4 shapes[4];
    vec4 intervals[4];
    float weights[4];
    float frontEnd = 3.4e38;
    float front = 3.4e38;
    for (int i = 0; i < 4; ++i)
    {
      ivec2 isNeighbor = ivec2(i & 1, i >> 1);
      ivec2 coarse = parent + toNeighbor * isNeighbor;
      weights[i] = 0.0;
      if (!isInsideImage(coarse))
      {
        continue;
      }
      shapes[i] = texelFetch(coarseShape, coarse, 0);
      intervals[i] = texelFetch(coarseInterval, coarse, 0);
      // the displacement becomes relative to the fine pixel
      vec2 center = (2.0 * vec2(coarse) + 1.0) * fineSize + intervals[i].zw;
      intervals[i].zw = center - (vec2(fine) + 0.5) * fineSize;
      if (shapes[i].w > 0.0 && isInsideEllipse(shapes[i], intervals[i], -intervals[i].zw))
      {
        // biquadratic B-spline subdivision: 9, 3, 3, 1 of 16
        weights[i] = (isNeighbor.x == 0 ? 0.75 : 0.25) * (isNeighbor.y == 0 ? 0.75 : 0.25);
        if (depthTest && intervals[i].x < front)
        {
          front = intervals[i].x;
          // an interval is one radius long; a slanted surface runs through two from pixel to pixel
          frontEnd = 2.0 * intervals[i].y - intervals[i].x;
        }
      }
    }

    vec4 newShape = vec4(0.0);
    vec4 newInterval = vec4(0.0);
    vec3 mainNormal = vec3(0.0);
    float mainWeight = 0.0;
    float sum = 0.0;
#ifdef HAS_ID
    uint newId = 0u;
#endif
#ifdef HAS_COLOR
    vec4 newColor = vec4(0.0);
#endif
    for (int i = 0; i < 4; ++i)
    {
      if (weights[i] == 0.0 || intervals[i].x > frontEnd)
      {
        continue;
      }
      ivec2 coarse = parent + toNeighbor * ivec2(i & 1, i >> 1);
      if (twoSided && dot(shapes[i].xyz, mainNormal) < 0.0)
      {
        shapes[i].xyz = -shapes[i].xyz;
      }
      newShape += weights[i] * shapes[i];
      newInterval += weights[i] * intervals[i];
      sum += weights[i];
#ifdef HAS_COLOR
      newColor += weights[i] * texelFetch(coarseColor, coarse, 0);
#endif
      if (weights[i] > mainWeight)
      {
        mainWeight = weights[i];
        mainNormal = shapes[i].xyz;
#ifdef HAS_ID
        newId = texelFetch(coarseId, coarse, 0).r;
#endif
      }
    }
    // where nothing covers the pixel, an occluded one is seen after all and an invalid one is empty
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
  }

#ifdef OUT_SURFACE
  OUT_SURFACE = shape.w > 0.0 ? vec4(shape.xyz, interval.x) : vec4(0.0);
#else
  OUT_SHAPE = shape;
  OUT_INTERVAL = interval;
#endif
#ifdef HAS_ID
  OUT_ID = id;
#endif
#ifdef HAS_COLOR
  OUT_COLOR = color;
#endif
}
