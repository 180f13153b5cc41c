// SPDX-License-Identifier: BSD-3-Clause
// A cell of a coarser level from four finer ones: their nearest point, and of their points within
// the tolerance of it the farthest.
uniform ivec2 fineBegin; // cells outside of [begin, end) are empty
uniform ivec2 fineEnd;
uniform ivec2 splatOffset; // of the finer level in the image of splats
uniform float size;        // cells of level 0 along a cell

void main()
{
  ivec2 coarse = ivec2(gl_FragCoord.xy);
  vec4 shapes[4];
  int front = -1;
  for (int i = 0; i < 4; ++i)
  {
    ivec2 fine = 2 * coarse + ivec2(i & 1, i >> 1);
    bool inside = all(greaterThanEqual(fine, fineBegin)) && all(lessThan(fine, fineEnd));
    shapes[i] = inside ? texelFetch(fineShape, fine, 0) : vec4(0.0);
    if (shapes[i].w > 0.0 && (front < 0 || shapes[i].z > shapes[front].z))
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
    shape = shapes[front];
    interval.xyz = shape.xyz;
    float tolerance = max(gamma, size * getEyeCell(-shape.z));
    float count = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      if (shapes[i].w <= 0.0)
      {
        continue;
      }
      ivec2 fine = 2 * coarse + ivec2(i & 1, i >> 1);
      interval.w = max(interval.w, texelFetch(splatInterval, fine + splatOffset, 0).w);
      vec3 points[2];
      points[0] = shapes[i].xyz;
      points[1] = texelFetch(fineInterval, fine, 0).xyz;
      for (int k = 0; k < 2; ++k)
      {
        if (points[k].z < interval.z && points[k].z >= shape.z - tolerance)
        {
          interval.xyz = points[k];
        }
      }
      if (points[0].z >= shape.z - tolerance)
      {
        count += 1.0;
#ifdef HAS_COLOR
        color += texelFetch(fineColor, fine, 0);
#endif
      }
    }
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
