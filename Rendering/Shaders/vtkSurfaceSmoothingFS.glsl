// SPDX-License-Identifier: BSD-3-Clause
// Smoothing (Rosenthal and Linsen 2008, section 6): the weighted mean of the 3x3 pixels around that
// are of the same surface.
uniform ivec2 begin; // pixels outside of [begin, end) are background
uniform ivec2 end;
uniform vec3 weights;    // of the pixel, a neighbour along a side, one over a corner
uniform vec2 depthStep;  // what is farther off is another surface, see vtkDepthStep.h
uniform bool twoSided;   // normals may point to either side

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 own = texelFetch(inSurface, pixel, 0);
  vec4 sum = vec4(0.0);
  float total = 0.0;
#ifdef HAS_COLOR
  vec4 color = texelFetch(inColor, pixel, 0);
  vec4 colors = vec4(0.0);
#endif
  for (int i = 0; i < 9 && own.w > 0.0; ++i)
  {
    ivec2 offset = ivec2(i % 3, i / 3) - 1;
    ivec2 place = pixel + offset;
    bool inside = all(greaterThanEqual(place, begin)) && all(lessThan(place, end));
    vec4 other = inside ? texelFetch(inSurface, place, 0) : vec4(0.0);
    if (other.w <= 0.0 || abs(other.w - own.w) > depthStep.x * own.w + depthStep.y)
    {
      continue;
    }
    float weight = weights[abs(offset.x) + abs(offset.y)];
    float side = twoSided && dot(other.xyz, own.xyz) < 0.0 ? -1.0 : 1.0;
    // about the pixel's own depth, which keeps the digits
    sum += weight * vec4(side * other.xyz, other.w - own.w);
    total += weight;
#ifdef HAS_COLOR
    colors += weight * texelFetch(inColor, place, 0);
#endif
  }
  if (total > 0.0)
  {
    float size = length(sum.xyz);
    own = vec4(size < 1e-6 * total ? own.xyz : sum.xyz / size, own.w + sum.w / total);
#ifdef HAS_COLOR
    color = colors / total;
#endif
  }

  OUT_SURFACE = own;
  WRITE_ID(texelFetch(inId, pixel, 0).r);
  WRITE_COLOR(color);
}
