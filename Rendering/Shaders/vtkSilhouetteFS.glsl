// SPDX-License-Identifier: BSD-3-Clause
// Pixels in front of an edge in depth, by the Laplace filter (Rosenthal and Linsen 2008, section 8).
uniform ivec2 begin; // nothing is known outside of [begin, end)
uniform ivec2 end;
uniform vec2 threshold; // see vtkDepthStep.h

const ivec2 sides[4] = ivec2[4](ivec2(1, 0), ivec2(0, 1), ivec2(-1, 0), ivec2(0, -1));

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float own = texelFetch(inSurface, pixel, 0).w;
  float behind = 0.0;
  bool border = false;
  for (int i = 0; i < 4; ++i)
  {
    ivec2 place = pixel + sides[i];
    bool inside = all(greaterThanEqual(place, begin)) && all(lessThan(place, end));
    float other = inside ? texelFetch(inSurface, place, 0).w : own;
    border = border || other <= 0.0;
    behind += other - own;
  }
  float limit = threshold.x * own + threshold.y;
  float line = border ? 1.0 : smoothstep(0.5 * limit, 1.5 * limit, behind);
  OUT_SHAPE = vec4(own > 0.0 ? line : 0.0);
}
