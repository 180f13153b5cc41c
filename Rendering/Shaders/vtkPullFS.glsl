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
  for (int i = 0; i < 4; ++i)
  {
    ivec2 fine = 2 * coarse + ivec2(i & 1, i >> 1);
    bool inside = all(greaterThanEqual(fine, fineBegin)) && all(lessThan(fine, fineEnd));
    shapes[i] = inside ? texelFetch(fineShape, fine, 0) : vec4(0.0);
    intervals[i] = inside ? texelFetch(fineInterval, fine, 0) : vec4(0.0);
    ranges[i] = getDepthRange(shapes[i], intervals[i]);
    // the displacement becomes relative to the coarse pixel's centre
    intervals[i].zw += fineSize * (vec2(i & 1, i >> 1) - 0.5);
    if (shapes[i].w > 0.0 && (front < 0 || ranges[i].x < ranges[front].x))
    {
      front = i;
    }
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
    vec2 range = ranges[front];
    float frontEnd = ranges[front].y;
    for (int i = 0; i < 4; ++i)
    {
      // the preliminary depth test: only what overlaps the frontmost interval is averaged
      if (shapes[i].w <= 0.0 || ranges[i].x > frontEnd)
      {
        shapes[i].w = 0.0;
        continue;
      }
      float side = twoSided && dot(shapes[i].xyz, shapes[front].xyz) < 0.0 ? -1.0 : 1.0;
      shape += shapes[i] * vec4(vec3(side), 1.0);
      interval += intervals[i];
      range.y = max(range.y, ranges[i].y);
#ifdef HAS_COLOR
      color += texelFetch(fineColor, 2 * coarse + ivec2(i & 1, i >> 1), 0);
#endif
      count += 1.0;
    }
    float size = length(shape.xyz);
    shape.xyz = size < 1e-6 ? shapes[front].xyz : shape.xyz / size;
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
