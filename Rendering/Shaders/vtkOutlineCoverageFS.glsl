// SPDX-License-Identifier: BSD-3-Clause
// Coverage of the pixels along the outline, see vtkOutlineCoverageOpenGL.h.
uniform ivec2 begin; // pixels of the target outside of [begin, end) are background
uniform ivec2 end;

void main()
{
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(inSurface, pixel, 0);
  ivec2 size = textureSize(inSurface, 0);
  float covered = 0.0;
  bool isOutline = false;
  for (int i = 0; i < 9; ++i)
  {
    ivec2 offset = ivec2(i % 3, i / 3) - 1;
    ivec2 place = pixel + offset;
    bool exists = all(greaterThanEqual(place, ivec2(0))) && all(lessThan(place, size));
    bool inside = all(greaterThanEqual(place, begin)) && all(lessThan(place, end));
    bool isBackground = exists && !(inside && texelFetch(inSurface, place, 0).w > 0.0);
    int steps = abs(offset.x) + abs(offset.y);
    covered += isBackground ? 0.0 : float(4 >> steps) / 16.0;
    isOutline = isOutline || (isBackground && steps == 1);
  }
  vec3 normal = surface.w > 0.0 ? normalize(surface.xyz) : vec3(0.0);
  OUT_SURFACE = vec4(isOutline ? covered * normal : normal, surface.w);
  WRITE_ID(texelFetch(inId, pixel, 0).r);
  WRITE_COLOR(texelFetch(inColor, pixel, 0));
}
