// SPDX-License-Identifier: BSD-3-Clause
// Pixels where a surface bends, by the normals to either side (Rosenthal and Linsen 2008, section 8).
uniform ivec2 begin; // nothing is known outside of [begin, end)
uniform ivec2 end;
uniform float threshold; // cosine
uniform vec2 depthStep;  // between two layers of surface, see vtkDepthStep.h

const ivec2 axes[4] = ivec2[4](ivec2(1, 0), ivec2(1, 1), ivec2(0, 1), ivec2(-1, 1));

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float own = texelFetch(inSurface, pixel, 0).w;
  float limit = depthStep.x * own + depthStep.y;
  float cosine = 1.0;
  for (int i = 0; i < 4 && own > 0.0; ++i)
  {
    ivec2 before = pixel - axes[i];
    ivec2 after = pixel + axes[i];
    if (any(lessThan(min(before, after), begin)) || any(greaterThanEqual(max(before, after), end)))
    {
      continue;
    }
    vec4 a = texelFetch(inSurface, before, 0);
    vec4 b = texelFetch(inSurface, after, 0);
    if (a.w > 0.0 && b.w > 0.0 && abs(a.w - own) <= limit && abs(b.w - own) <= limit)
    {
      cosine = min(cosine, dot(a.xyz, b.xyz));
    }
  }
  OUT_SHAPE = vec4(1.0 - smoothstep(threshold, 0.5 * (threshold + 1.0), cosine));
}
