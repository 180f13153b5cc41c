// SPDX-License-Identifier: BSD-3-Clause
// Resolve: a pixel from the samples of a finer surface buffer. Of two surfaces in a pixel it is the one
// with more samples, or the other one; the normal's length is its share of the samples, or that of both
// surfaces where a part of the pixel is empty: there the other one is left out.
uniform ivec2 begin; // samples outside of [begin, end) are empty
uniform ivec2 end;
const int samples = SAMPLES; // along a side of a pixel, known when this is compiled: software makes loops slow
uniform float depthStep; // what differs by less is one surface
uniform int isLesser; // whether the surface with less samples is made

void main()
{
  ivec2 first = samples * ivec2(gl_FragCoord.xy);
  int count = samples * samples;
  vec4 surfaces[SAMPLES * SAMPLES];
  float nearest = 3.4e38;
  float farthest = 0.0;
  float covered = 0.0;
  for (int i = 0; i < count; ++i)
  {
    ivec2 place = first + ivec2(i % samples, i / samples);
    bool inside = all(greaterThanEqual(place, begin)) && all(lessThan(place, end));
    surfaces[i] = inside ? texelFetch(inSurface, place, 0) : vec4(0.0);
    if (surfaces[i].w > 0.0)
    {
      covered += 1.0;
      nearest = min(nearest, surfaces[i].w);
      farthest = max(farthest, surfaces[i].w);
    }
  }
  float limit = max(nearest + depthStep, 0.5 * (nearest + farthest));
  bool isFull = covered == float(count);
  bool isMade = isLesser == 0 || (isFull && farthest > limit);
  int last = isMade ? count : 0;
  float inFront = 0.0;
  for (int i = 0; i < last; ++i)
  {
    inFront += surfaces[i].w > 0.0 && surfaces[i].w <= limit ? 1.0 : 0.0;
  }
  bool takeFront = 2.0 * inFront >= covered;

  vec4 sum = vec4(0.0);
  vec3 firstNormal = vec3(0.0);
  float weights = 0.0;
  vec2 others = vec2(0.0); // sum of depths and number of the samples of the surface that is not made
#ifdef HAS_ID
  uint id = 0u; // of the surface with more samples
#endif
#ifdef HAS_COLOR
  vec4 color = vec4(0.0);
#endif
  for (int i = 0; i < last; ++i)
  {
    if (surfaces[i].w <= 0.0)
    {
      continue;
    }
    ivec2 place = first + ivec2(i % samples, i / samples);
    bool hasMore = (surfaces[i].w <= limit) == takeFront;
#ifdef HAS_ID
    if (hasMore && id == 0u)
    {
      id = texelFetch(inId, place, 0).r;
    }
#endif
    if (hasMore == (isLesser != 0))
    {
      others += vec2(surfaces[i].w, 1.0);
      continue;
    }
    if (weights == 0.0)
    {
      firstNormal = surfaces[i].xyz;
    }
    float side = dot(surfaces[i].xyz, firstNormal) < 0.0 ? -1.0 : 1.0;
    sum += surfaces[i] * vec4(vec3(side), 1.0);
    weights += 1.0;
#ifdef HAS_COLOR
    color += texelFetch(inColor, place, 0);
#endif
  }

  vec4 surface = vec4(0.0);
  if (weights > 0.0)
  {
    float size = length(sum.xyz);
    vec3 normal = size < 1e-6 ? firstNormal : sum.xyz / size;
    surface = vec4(normal * (isFull ? weights : covered) / float(count), sum.w / weights);
    if (isLesser != 0)
    {
      // it is drawn before the other one, and hidden where that is
      surface.w = max(surface.w, others.x / others.y + depthStep);
    }
#ifdef HAS_COLOR
    color /= weights;
#endif
  }
#ifdef HAS_ID
  id = surface.w > 0.0 ? id : 0u;
#endif
  OUT_SURFACE = surface;
  WRITE_ID(id);
  WRITE_COLOR(color);
}
