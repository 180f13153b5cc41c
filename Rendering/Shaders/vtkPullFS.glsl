// SPDX-License-Identifier: BSD-3-Clause
// Pull: a pixel of a coarser level from the four below it (Marroquim et al. 2007, section 3.2).
uniform ivec2 fineBegin;  // pixels outside of [begin, end) are invalid
uniform ivec2 fineEnd;
uniform float fineSize;   // pixels of level 0 along a side of a fine pixel
uniform float unionShare; // 0: mean of the radii (the paper); 1: the discs' union

void main()
{
  ivec2 coarse = ivec2(gl_FragCoord.xy);
  vec4 shapes[4];
  vec4 intervals[4];
  vec2 ranges[4];
  int front = -1;
  vec3 frontNormal = vec3(0.0);
  vec2 frontRange = vec2(3.4e38, -3.4e38);
  for (int i = 0; i < 4; ++i)
  {
    ivec2 fine = 2 * coarse + ivec2(i & 1, i >> 1);
    bool inside = all(greaterThanEqual(fine, fineBegin)) && all(lessThan(fine, fineEnd));
    shapes[i] = inside ? texelFetch(fineShape, fine, 0) : vec4(0.0);
    intervals[i] = inside ? texelFetch(fineInterval, fine, 0) : vec4(0.0);
    ranges[i] = getDepthRange(shapes[i], intervals[i]);
    // the displacement becomes relative to the coarse pixel's centre
    intervals[i].zw += fineSize * (vec2(i & 1, i >> 1) - 0.5);
    bool isFront = shapes[i].w > 0.0 && ranges[i].x < frontRange.x;
    front = isFront ? i : front;
    frontNormal = isFront ? shapes[i].xyz : frontNormal;
    frontRange = isFront ? ranges[i] : frontRange;
  }

  vec4 shape = vec4(0.0);
  vec4 interval = vec4(0.0);
#ifdef HAS_ID
  uint id = 0u;
#endif
#ifdef HAS_COLOR
  vec4 color = vec4(0.0);
#endif
  if (front >= 0)
  {
    float count = 0.0;
    vec2 range = frontRange;
    for (int i = 0; i < 4; ++i)
    {
      // the preliminary depth test: only what overlaps the frontmost interval is averaged
      bool isAveraged = shapes[i].w > 0.0 && ranges[i].x <= frontRange.y;
      float share = isAveraged ? 1.0 : 0.0;
      shapes[i].w *= share;
      float side = twoSided && dot(shapes[i].xyz, frontNormal) < 0.0 ? -share : share;
      shape += shapes[i] * vec4(vec3(side), 1.0);
      interval += share * intervals[i];
      range.y = isAveraged ? max(range.y, ranges[i].y) : range.y;
#ifdef HAS_COLOR
      color += share * texelFetch(fineColor, 2 * coarse + ivec2(i & 1, i >> 1), 0);
#endif
      count += share;
    }
    float size = length(shape.xyz);
    shape.xyz = size < 1e-6 ? frontNormal : shape.xyz / size;
    shape.w /= count;
    interval /= count;
    interval.xy = centerDepths ? vec2(interval.x, 0.0) : range;
    float unionRadius = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      if (shapes[i].w > 0.0)
      {
        if (centerDepths)
        {
          interval.y = max(interval.y, abs(intervals[i].x - interval.x) + intervals[i].y);
        }
        vec2 offset = getEyeOffset(intervals[i].zw - interval.zw, interval.x);
        unionRadius = max(unionRadius, shapes[i].w + 0.5 * length(offset));
      }
    }
    shape.w = mix(shape.w, unionRadius, unionShare);
#ifdef HAS_ID
    id = texelFetch(fineId, 2 * coarse + ivec2(front & 1, front >> 1), 0).r;
#endif
#ifdef HAS_COLOR
    color /= count;
#endif
  }

  OUT_SHAPE = shape;
  OUT_INTERVAL = interval;
  WRITE_ID(id);
  WRITE_COLOR(color);
}
