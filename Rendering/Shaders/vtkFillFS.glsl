// SPDX-License-Identifier: BSD-3-Clause
// Fill: single pixels that are empty, or show the back of a surface through a gap in its front; by
// the masks of Rosenthal and Linsen 2008, section 6: a pixel stays as it is where five neighbours in
// a row of its ring of eight are not of the surface in front; an empty one perhaps where four are. Runs
// over the pixels that vtkPushFS.glsl has marked by depth.
uniform ivec2 begin; // pixels outside of [begin, end) are empty
uniform ivec2 end;
uniform int openRun;     // empty pixels in a row around one that stays empty
uniform float depthStep; // what is farther back than this is behind

const ivec2 ring[8] = ivec2[8](ivec2(1, 0), ivec2(1, 1), ivec2(0, 1), ivec2(-1, 1), ivec2(-1, 0),
  ivec2(-1, -1), ivec2(0, -1), ivec2(1, -1));

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(inSurface, pixel, 0);
#ifdef HAS_ID
  uint id = texelFetch(inId, pixel, 0).r;
#endif
#ifdef HAS_COLOR
  vec4 color = texelFetch(inColor, pixel, 0);
#endif

  bool isBack = twoSided && !facesViewer(surface.xyz, vec2(pixel) + 0.5);
  vec4 around[8];
  float nearest = 3.4e38;
  vec3 frontNormal = vec3(0.0);
  ivec2 frontPlace = pixel;
  int runLength = 0;
  int longestRun = 0;
  float limit = surface.w > 0.0 ? surface.w - depthStep : 3.4e38;
  for (int i = 0; i < 8; ++i)
  {
    ivec2 place = pixel + ring[i];
    bool inside = all(greaterThanEqual(place, begin)) && all(lessThan(place, end));
    around[i] = inside ? texelFetch(inSurface, place, 0) : vec4(0.0);
    around[i].w = around[i].w >= limit ? 0.0 : around[i].w;
    bool isFront = around[i].w > 0.0 && around[i].w < nearest;
    nearest = isFront ? around[i].w : nearest;
    frontNormal = isFront ? around[i].xyz : frontNormal;
    frontPlace = isFront ? place : frontPlace;
  }
  for (int i = 0; i < 12; ++i) // once around, and on by the longest run that matters
  {
    runLength = around[i & 7].w > 0.0 ? 0 : runLength + 1;
    longestRun = max(longestRun, runLength);
  }
  if (longestRun < (surface.w == 0.0 ? openRun : 5) && (surface.w == 0.0 || isBack))
  {
    vec4 sum = vec4(0.0);
    float weights = 0.0;
#ifdef HAS_COLOR
    color = vec4(0.0);
#endif
    for (int i = 0; i < 8; ++i)
    {
      bool isTaken = around[i].w > 0.0 && around[i].w <= nearest + 2.0 * depthStep;
      float weight = isTaken ? ((i & 1) == 0 ? 2.0 : 1.0) : 0.0;
      float side = dot(around[i].xyz, frontNormal) < 0.0 ? -1.0 : 1.0;
      sum += weight * around[i] * vec4(vec3(side), 1.0);
      weights += weight;
#ifdef HAS_COLOR
      color += isTaken ? weight * texelFetch(inColor, pixel + ring[i], 0) : vec4(0.0);
#endif
    }
    float size = length(sum.xyz);
    surface = vec4(size < 1e-6 ? frontNormal : sum.xyz / size, sum.w / weights);
#ifdef HAS_ID
    id = texelFetch(inId, frontPlace, 0).r;
#endif
#ifdef HAS_COLOR
    color /= weights;
#endif
  }

  OUT_SURFACE = surface;
  WRITE_ID(id);
  WRITE_COLOR(color);
}
