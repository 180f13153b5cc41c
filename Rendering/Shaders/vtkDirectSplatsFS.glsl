// SPDX-License-Identifier: BSD-3-Clause
// The surface buffer from splats of all levels, with Gaussian weights (Kawata and Kanai, section
// 3.4). A splat reaches 1.5 cells, so that those of 25 cells can cover a pixel.
uniform int levels;
uniform ivec2 levelOffset[3]; // in the image of splats
uniform ivec2 levelBegin[3];  // cells outside of [begin, end) are empty
uniform ivec2 levelEnd[3];
uniform vec2 pixelToCell;
uniform bool planes;      // splats are discs in their plane, not squares of one depth
uniform float leastWidth; // of a slanted disc
uniform bool depthTest; // only splats near the frontmost one count
uniform int numberOfClippingPlanes;
uniform vec4 clippingPlanes[6]; // in eye coordinates

// Whether a depth at a place is beyond a plane: there a splat would hide what is behind it.
bool isClipped(vec2 place, float depth)
{
  vec4 eye = vec4(
    eyeRay.zw + place * eyeRayStep.zw + depth * (eyeRay.xy + place * eyeRayStep.xy), -depth, 1.0);
  eye.x -= shear * eye.y;
  bool clipped = false;
  for (int i = 0; i < numberOfClippingPlanes; ++i)
  {
    clipped = clipped || dot(clippingPlanes[i], eye) < 0.0;
  }
  return clipped;
}

struct Splat
{
  bool covers;
  float weight;
  float depth;
  float tolerance;
  vec3 normal;
};

Splat getSplat(ivec2 texel, vec2 place)
{
  vec4 shape = texelFetch(inShape, texel, 0);
  Splat splat;
  splat.covers = shape.w > 0.0;
  if (!splat.covers)
  {
    return splat;
  }
  vec3 mean = texelFetch(inInterval, texel, 0).xyz;
  splat.depth = -mean.z;
  splat.normal = shape.xyz;
  vec2 raySlope = eyeRayStep.zw + splat.depth * eyeRayStep.xy; // eye units a cell
  vec2 straight = vec2(mean.x + shear * mean.y, mean.y);
  vec2 center = (straight - eyeRay.zw - splat.depth * eyeRay.xy) / raySlope;
  vec2 away = (place - center) / shape.w;
  float radius = shape.w * getEyeCell(splat.depth);
  splat.tolerance = max(gamma, radius);
  if (!planes)
  {
    splat.covers = max(abs(away.x), abs(away.y)) <= 1.0 && !isClipped(place, splat.depth);
    splat.weight = exp(-4.5 * dot(away, away));
    return splat;
  }
  // a disc in the splat's plane, as an ellipse in the image
  float width = max(abs(shape.z), leastWidth);
  float along = dot(shape.xy / max(1e-20, length(shape.xy)), away);
  float inside = 1.0 - dot(away, away) - (1.0 / (width * width) - 1.0) * along * along;
  splat.covers = inside > 0.0;
  splat.weight = inside * inside;
  // where the ray meets the plane, no farther from the centre than the radius
  vec2 direction = eyeRay.xy + place * eyeRayStep.xy;
  vec3 normal = vec3(shape.x, shape.y - shear * shape.x, shape.z); // of rays before the shear
  float slope = dot(normal, vec3(direction, -1.0)); // negative for all that faces the viewer
  float rise = dot(normal.xy, (center - place) * raySlope);
  splat.depth += clamp(rise / min(slope, -1e-6), -radius, radius);
  splat.covers = splat.covers && !isClipped(place, splat.depth);
  return splat;
}

void main()
{
  vec2 place = gl_FragCoord.xy * pixelToCell;
  float front = 3.4e38;
  for (int level = 0; depthTest && level < levels; ++level)
  {
    ivec2 middle = ivec2(place) >> level;
    ivec2 first = max(middle - 2, levelBegin[level]);
    ivec2 last = min(middle + 3, levelEnd[level]);
    for (int y = first.y; y < last.y; ++y)
    {
      for (int x = first.x; x < last.x; ++x)
      {
        Splat splat = getSplat(ivec2(x, y) + levelOffset[level], place);
        front = splat.covers ? min(front, splat.depth) : front;
      }
    }
  }

  float sum = 0.0;
  float largest = 0.0;
  vec4 surface = vec4(0.0);
#ifdef HAS_ID
  uint id = 0u;
#endif
#ifdef HAS_COLOR
  vec4 color = vec4(0.0);
#endif
  for (int level = 0; level < levels; ++level)
  {
    ivec2 middle = ivec2(place) >> level;
    ivec2 first = max(middle - 2, levelBegin[level]);
    ivec2 last = min(middle + 3, levelEnd[level]);
    for (int y = first.y; y < last.y; ++y)
    {
      for (int x = first.x; x < last.x; ++x)
      {
        ivec2 texel = ivec2(x, y) + levelOffset[level];
        Splat splat = getSplat(texel, place);
        if (!splat.covers || (depthTest && splat.depth > front + splat.tolerance))
        {
          continue;
        }
        sum += splat.weight;
        surface += splat.weight * vec4(splat.normal, splat.depth);
#ifdef HAS_COLOR
        color += splat.weight * texelFetch(inColor, texel, 0);
#endif
        if (splat.weight > largest)
        {
          largest = splat.weight;
#ifdef HAS_ID
          id = texelFetch(inId, texel, 0).r;
#endif
        }
      }
    }
  }
  if (sum > 0.0)
  {
    surface = vec4(surface.xyz / max(length(surface.xyz), 1e-20), surface.w / sum);
#ifdef HAS_COLOR
    color /= sum;
#endif
  }
  OUT_SURFACE = surface;
  WRITE_ID(id);
  WRITE_COLOR(color);
}
