
// SPDX-License-Identifier: BSD-3-Clause
// Smoothing of lit colours (Rosenthal and Linsen 2008, sections 3 and 6): psShade() is VTK's main().
uniform vec3 psWeights;    // of the pixel, a neighbour along a side, one over a corner
uniform float psDepthStep; // what is farther off than this is another surface

// Whether the pixel at psOffset is drawn; gl_FragData is its colour then.
bool psIsDrawn()
{
  psGone = false;
  psShade();
  return !psGone;
}

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy) - psOrigin;
  float depth = texelFetch(psSurface, pixel, 0).w;
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int i = 0; i < 9 && depth > 0.0; ++i)
  {
    psOffset = ivec2(i % 3, i / 3) - 1;
    ivec2 place = pixel + psOffset;
    bool inside = all(greaterThanEqual(place, psBegin)) && all(lessThan(place, psEnd));
    float other = inside ? texelFetch(psSurface, place, 0).w : 0.0;
    bool counts = other > 0.0 && abs(other - depth) <= psDepthStep && psOffset != ivec2(0);
    if (counts && psIsDrawn())
    {
      float weight = psWeights[abs(psOffset.x) + abs(psOffset.y)];
      sum += weight * gl_FragData[0].rgb;
      total += weight;
    }
  }
  psOffset = ivec2(0);
  if (!psIsDrawn())
  {
    discard;
  }
  // alpha has the share that the surface covers of this pixel, to which neighbours add nothing
  gl_FragData[0].rgb = (sum + psWeights[0] * gl_FragData[0].rgb) / (total + psWeights[0]);
}
