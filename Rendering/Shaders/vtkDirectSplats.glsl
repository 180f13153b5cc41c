// SPDX-License-Identifier: BSD-3-Clause
// What splats show at a place of the picture, in cells of level 0 (Kawata and Kanai, section 3.4). A
// splat reaches 1.5 cells, so that those of 25 cells can cover a place.
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
  bool isCopy; // counts beside others, and covers nothing by itself
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
  vec4 interval = texelFetch(inInterval, texel, 0);
  vec3 mean = interval.xyz;
  splat.isCopy = interval.w < 0.0;
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

// The cells of a level whose splats may cover a place: the first ones, and those past the last.
ivec4 getCells(vec2 place, int level)
{
  ivec2 middle = ivec2(place) >> level;
  return ivec4(max(middle - 2, levelBegin[level]), min(middle + 3, levelEnd[level]));
}

// Depth of the frontmost splat, or a large number where splats behind it count too.
float getFront(vec2 place)
{
  float front = 3.4e38;
  for (int level = 0; depthTest && level < levels; ++level)
  {
    ivec4 cells = getCells(place, level);
    for (int y = cells.y; y < cells.w; ++y)
    {
      for (int x = cells.x; x < cells.z; ++x)
      {
        Splat splat = getSplat(ivec2(x, y) + levelOffset[level], place);
        front = splat.covers && !splat.isCopy ? min(front, splat.depth) : front;
      }
    }
  }
  return front;
}

bool counts(Splat splat, float front)
{
  bool near = splat.covers && (!depthTest || splat.depth <= front + splat.tolerance);
  return near && (!splat.isCopy || splat.depth >= front - splat.tolerance);
}
