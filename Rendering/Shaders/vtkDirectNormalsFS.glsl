// SPDX-License-Identifier: BSD-3-Clause
// Splats: a plane fitted to the points of the cells around one gives its normal (Kawata and Kanai, section 3.3).
uniform ivec2 begin; // cells outside of [begin, end) are empty
uniform ivec2 end;
uniform ivec2 splatOffset; // of this level in the image of splats
uniform float size;        // cells of level 0 along a cell
uniform float splatRadius; // in cells
uniform int enoughNeighbors;
uniform float neighborDepth; // how far behind a cell, in cells of level 0, these may be
uniform bool adaptive;
uniform bool coarsest;
uniform bool parallel;
uniform bool weighted;  // points count the less the farther away they are
uniform int reach;      // cells to each side whose points count
uniform float fitRadius;
uniform vec2 fitDepths; // how far from the mean, and then from the first plane, points count
uniform float steepStep; // least step in depth, in cells, of a slope that the fit starts from
uniform float evenSteps; // two steps are at most so many times the smaller one
#ifdef HAS_COPIES
uniform samplerBuffer copies; // see vtkDuplicatePoints
#endif

vec4 getShape(ivec2 cell)
{
  bool inside = all(greaterThanEqual(cell, begin)) && all(lessThan(cell, end));
  return inside ? texelFetch(inShape, cell, 0) : vec4(0.0);
}

// Fits a plane z = a x + b y + c to the points around a cell that lie within a distance of the plane
// that is there, along z, all in cells and about the mean. Returns false, and leaves the plane,
// where they lie on a line, seen from the eye.
bool fitPlane(ivec2 cell, vec3 mean, float scale, float distance, inout vec3 plane)
{
  float sum = 0.0;
  vec3 first = vec3(0.0);  // x, y, z
  vec3 second = vec3(0.0); // xx, xy, yy
  vec2 mixed = vec2(0.0);  // xz, yz
  for (int j = -reach; j <= reach; ++j)
  {
    for (int i = -reach; i <= reach; ++i)
    {
      ivec2 neighbor = cell + ivec2(i, j);
      vec4 shape = getShape(neighbor);
      if (shape.w <= 0.0)
      {
        continue;
      }
      for (int k = 0; k < 2; ++k)
      {
        vec3 point = k == 0 ? shape.xyz : texelFetch(inInterval, neighbor, 0).xyz;
        vec3 d = scale * (point - mean);
        float near = max(0.0, 1.0 - dot(d.xy, d.xy) / (fitRadius * fitRadius));
        float weight = weighted ? near * near : 1.0;
        weight = abs(d.z - dot(plane, vec3(d.xy, 1.0))) <= distance ? weight : 0.0;
        sum += weight;
        first += weight * d;
        second += weight * vec3(d.x * d.x, d.x * d.y, d.y * d.y);
        mixed += weight * d.xy * d.z;
      }
    }
  }
  if (sum <= 0.0)
  {
    return false;
  }
  second -= vec3(first.x * first.x, first.x * first.y, first.y * first.y) / sum;
  mixed -= first.xy * first.z / sum;
  float determinant = second.x * second.z - second.y * second.y;
  float trace = second.x + second.z;
  if (determinant <= 1e-3 * trace * trace)
  {
    return false;
  }
  plane.xy = vec2(mixed.x * second.z - mixed.y * second.y,
    mixed.y * second.x - mixed.x * second.y) / determinant;
  plane.z = (first.z - dot(plane.xy, first.xy)) / sum;
  return true;
}

// The slope along an axis of a surface that is seen at a grazing angle, and goes on to both sides of a
// cell; else 0. At the edge of a surface one step is much larger than the other.
float getSteepSlope(ivec2 cell, int axis, float scale)
{
  ivec2 side = ivec2(1 - axis, axis);
  vec4 before = getShape(cell - side);
  vec4 after = getShape(cell + side);
  float middle = getShape(cell).z;
  vec2 steps = scale * vec2(middle - before.z, after.z - middle);
  float least = min(abs(steps.x), abs(steps.y));
  float rise = steps.x + steps.y;
  float run = scale * (after[axis] - before[axis]);
  bool goesOn = before.w > 0.0 && after.w > 0.0 && steps.x * steps.y > 0.0 && abs(rise) <= evenSteps * least;
  return goesOn && least >= steepStep && run > 0.0 ? rise / run : 0.0;
}

vec3 fitNormal(ivec2 cell, vec3 mean)
{
  float scale = 1.0 / (size * getEyeCell(-mean.z));
  vec3 plane = vec3(0.0);
  if (weighted)
  {
    plane.x = getSteepSlope(cell, 0, scale);
    plane.y = getSteepSlope(cell, 1, scale);
  }
  bool fits = fitPlane(
    cell, mean, scale, weighted ? max(gamma * scale, fitDepths.x) : 3.4e38, plane);
  if (fits && weighted)
  {
    fitPlane(cell, mean, scale, max(gamma * scale, fitDepths.y), plane);
  }
  bool slanted = fits || any(notEqual(plane.xy, vec2(0.0))); // a steep slope is left as it is
  vec3 normal = slanted || parallel ? vec3(-plane.xy, 1.0) : -mean;
  float towards = parallel ? normal.z : -dot(normal, mean);
  return normalize(towards < 0.0 ? -normal : normal);
}

void main()
{
  ivec2 cell = ivec2(gl_FragCoord.xy) - splatOffset;
  vec4 shape = getShape(cell);
  vec4 interval = texelFetch(inInterval, cell, 0);
  vec4 splat = vec4(0.0);
  vec4 place = vec4(0.0);
  if (shape.w > 0.0 && interval.w > 0.0)
  {
    // not counting what is far behind: through a gap in a surface its back shows
    float behind = shape.z - max(gamma, neighborDepth * getEyeCell(-shape.z));
    int neighbors = 0;
    for (int i = 0; i < 9; ++i)
    {
      vec4 neighbor = getShape(cell + ivec2(i % 3 - 1, i / 3 - 1));
      neighbors += neighbor.w > 0.0 && neighbor.z >= behind ? 1 : 0;
    }
    bool enough = !adaptive || neighbors >= enoughNeighbors;
    if (enough || coarsest)
    {
      place.xyz = 0.5 * (shape.xyz + interval.xyz);
      // a point far from all others stays small
      splat = vec4(fitNormal(cell, place.xyz), splatRadius * (enough ? size : 1.0));
#ifdef HAS_COPIES
      int point = int(texelFetch(inId, cell, 0).r) - 1;
      place.w = texelFetch(copies, point >> 2)[point & 3] > 0.0 ? -1.0 : 0.0;
#endif
    }
    else
    {
      place.w = 1.0;
    }
  }
  OUT_SHAPE = splat;
  OUT_INTERVAL = place;
  WRITE_ID(texelFetch(inId, cell, 0).r);
  WRITE_COLOR(texelFetch(inColor, cell, 0));
}
