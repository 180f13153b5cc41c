// SPDX-License-Identifier: BSD-3-Clause
// The ray through a pixel meets a splat (Bolla and Narayanan, section 3.1): in the first pass for
// the depth that is visible, in the second for what is blended there, in the third, which selection
// alone has, for the splat of the largest weight (section 3.2).
uniform samplerBuffer splats;
#ifdef OUT_COLOR
uniform samplerBuffer colors;
uniform bool hasColors;
uniform vec4 color; // where it has none
#endif
#ifdef OUT_ID
uniform int firstId; // of the cloud's points, among those of all
#endif
uniform vec4 eyeRay;     // xy: the ray's direction through the pixel (0, 0); zw: its origin
uniform vec4 eyeRayStep; // change of these a pixel
uniform float shear;     // in a sheared picture eye x is less than by these by that times y
uniform vec4 planes[8];  // what limits the ray, in eye coordinates
uniform int numberOfPlanes;
uniform int cull;        // 1 drops what faces away, 2 what faces the viewer
uniform float depthShift;
uniform float weightFalloff;
uniform bool separateSides; // front and back are never blended

flat in vec3 center;
flat in vec3 toU;
flat in vec3 toV;
flat in vec3 toN;
flat in vec2 heights;
flat in float unit;
flat in int firstTexel;
flat in int splat;

const int FirstCoefficient = 4; // texel of a splat
const int Coefficients = (ORDER + 1) * (ORDER + 2) / 2;

int getIndex(int a, int b)
{
  return (a + b) * (a + b + 1) / 2 + b;
}

// The part of the range where value + t * change >= 0.
vec2 limit(vec2 range, float value, float change)
{
  return change > 0.0 ? vec2(max(range.x, -value / change), range.y)
    : change < 0.0    ? vec2(range.x, min(range.y, -value / change))
    : value < 0.0     ? vec2(1.0, 0.0)
                      : range;
}

// The product with value + change * t; the degree of the factor is below 4.
Polynomial multiply(Polynomial p, float value, float change)
{
  return Polynomial(
    value * p.Low + change * vec4(0.0, p.Low.xyz), value * p.High + change * p.Low.w);
}

void main()
{
  // the ray from the depth of the splat's centre on, in units of the disc
  vec4 ray = eyeRay + gl_FragCoord.xyxy * eyeRayStep;
  ray.xz -= shear * ray.yw;
  vec3 direction = vec3(ray.xy, -1.0);
  vec3 position = vec3(ray.zw - center.z * ray.xy, center.z);
  vec3 offset = position - center;
  vec3 start = vec3(dot(toU, offset), dot(toV, offset), dot(toN, offset));
  vec3 step = unit * vec3(dot(toU, direction), dot(toV, direction), dot(toN, direction));

  // where it lies in the disc's cylinder and before all planes
  vec2 range = vec2(-3.0e38, 3.0e38);
  float a = dot(step.xy, step.xy);
  float b = dot(start.xy, step.xy);
  float c = dot(start.xy, start.xy) - 1.0;
  float discriminant = b * b - a * c;
  if (a > 1e-12)
  {
    if (discriminant <= 0.0)
    {
      discard;
    }
    float root = sqrt(discriminant);
    range = vec2(-b - root, -b + root) / a;
  }
  else if (c > 0.0)
  {
    discard;
  }
  range = limit(range, start.z - heights.x, step.z);
  range = limit(range, heights.y - start.z, -step.z);
  for (int i = 0; i < numberOfPlanes; ++i)
  {
    range = limit(range, dot(planes[i].xyz, position) + planes[i].w,
      unit * dot(planes[i].xyz, direction));
  }
  if (!(range.x < range.y))
  {
    discard;
  }
  start += range.x * step;
  step *= range.y - range.x;

  float coefficients[4 * ((Coefficients + 3) / 4)];
  for (int i = 0; i < (Coefficients + 3) / 4; ++i)
  {
    vec4 four = texelFetch(splats, firstTexel + FirstCoefficient + i);
    for (int k = 0; k < 4; ++k)
    {
      coefficients[4 * i + k] = four[k];
    }
  }

  // g(u, v) - n over the range
  Polynomial sum = Polynomial(vec4(0.0), 0.0);
  for (int k = ORDER; k >= 0; --k)
  {
    Polynomial inner = Polynomial(vec4(0.0), 0.0);
    for (int l = ORDER - k; l >= 0; --l)
    {
      inner = multiply(inner, start.y, step.y);
      inner.Low.x += coefficients[getIndex(k, l)];
    }
    sum = multiply(sum, start.x, step.x);
    sum.Low += inner.Low;
    sum.High += inner.High;
  }
  sum.Low.xy -= vec2(start.z, step.z);
  float t;
  if (!firstRoot(sum, t))
  {
    discard;
  }
  vec2 uv = start.xy + t * step.xy;
  vec2 slope = vec2(0.0);
  for (int k = ORDER; k >= 0; --k)
  {
    float value = 0.0;
    float valueSlope = 0.0;
    for (int l = ORDER - k; l >= 0; --l)
    {
      float coefficient = coefficients[getIndex(k, l)];
      value = value * uv.y + coefficient;
      if (l > 0)
      {
        valueSlope = valueSlope * uv.y + float(l) * coefficient;
      }
    }
    if (k > 0)
    {
      slope.x = slope.x * uv.x + float(k) * value;
    }
    slope.y = slope.y * uv.x + valueSlope;
  }
  vec3 normal = normalize(toN - slope.x * toU - slope.y * toV);
  float depth = -center.z + unit * (range.x + t * (range.y - range.x));
  bool front = dot(normal, direction) < 0.0;
  if (cull == (front ? 2 : 1))
  {
    discard;
  }

#ifdef OUT_NEARNESS
  float nearness = 1.0 / ((1.0 + depthShift) * depth);
  OUT_NEARNESS = front || !separateSides ? vec4(nearness, 0.0, 0.0, 0.0) : vec4(0.0, nearness, 0.0, 0.0);
#else
  vec2 visible = texelFetch(inNearness, ivec2(gl_FragCoord.xy), 0).xy;
  bool visibleFront = visible.x >= visible.y;
  if ((separateSides && front != visibleFront) ||
    depth * (visibleFront ? visible.x : visible.y) > 1.0)
  {
    discard;
  }
  float weight = exp(-weightFalloff * dot(uv, uv));
#ifdef OUT_ID
  vec2 halves = texelFetch(splats, firstTexel + 3).xy;
  OUT_ID = uint(firstId) + uint(halves.x) + 65536u * uint(halves.y) + 1u;
  gl_FragDepth = 1.0 - weight;
#else
  OUT_SUM = weight * vec4(normal, depth);
  OUT_WEIGHT = vec4(weight, 0.0, 0.0, 0.0);
#ifdef OUT_COLOR
  OUT_COLOR = weight * (hasColors ? texelFetch(colors, splat) : color);
#endif
#endif
#endif
}
