// SPDX-License-Identifier: BSD-3-Clause
// Resolve: a pixel from the samples of a finer surface buffer. Of two surfaces in a pixel the one
// with more samples counts; the normal's length is the share of the samples with any surface.
uniform ivec2 begin; // samples outside of [begin, end) are empty
uniform ivec2 end;
uniform int samples; // along a side of a pixel, up to 4
uniform float depthStep; // what is farther back than this is another surface

void main()
{
  ivec2 first = samples * ivec2(gl_FragCoord.xy);
  int count = samples * samples;
  vec4 surfaces[16];
  float nearest = 3.4e38;
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
    }
  }
  float inFront = 0.0;
  for (int i = 0; i < count; ++i)
  {
    inFront += surfaces[i].w > 0.0 && surfaces[i].w <= nearest + depthStep ? 1.0 : 0.0;
  }
  bool takeFront = 2.0 * inFront >= covered;

  vec4 sum = vec4(0.0);
  vec3 firstNormal = vec3(0.0);
  float weights = 0.0;
#ifdef HAS_ID
  uint id = 0u;
#endif
#ifdef HAS_COLOR
  vec4 color = vec4(0.0);
#endif
  for (int i = 0; i < count; ++i)
  {
    if (surfaces[i].w <= 0.0 || (surfaces[i].w <= nearest + depthStep) != takeFront)
    {
      continue;
    }
    ivec2 place = first + ivec2(i % samples, i / samples);
    if (weights == 0.0)
    {
      firstNormal = surfaces[i].xyz;
#ifdef HAS_ID
      id = texelFetch(inId, place, 0).r;
#endif
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
    surface = vec4(normal * covered / float(count), sum.w / weights);
#ifdef HAS_COLOR
    color /= weights;
#endif
  }
  OUT_SURFACE = surface;
  WRITE_ID(id);
  WRITE_COLOR(color);
}
