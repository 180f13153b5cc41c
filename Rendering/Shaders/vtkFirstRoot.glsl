// SPDX-License-Identifier: BSD-3-Clause
// The first root of a polynomial of degree ORDER between 0 and 1; the mirror of
// vtkPolynomialRoots.h, which tells how. No arrays: Mesa 22.3's llvmpipe gets loops over them wrong.

// The coefficients of 1, t, t^2, t^3, and that of t^4.
struct Polynomial
{
  vec4 Low;
  float High;
};

float evaluate(Polynomial p, float t)
{
  return (((p.High * t + p.Low.w) * t + p.Low.z) * t + p.Low.y) * t + p.Low.x;
}

float evaluateSlope(Polynomial p, float t)
{
  return ((4.0 * p.High * t + 3.0 * p.Low.w) * t + 2.0 * p.Low.z) * t + p.Low.y;
}

// What rounding can make of evaluate() where the value is 0.
float getRoundingError(Polynomial p, float t)
{
  return 2.4e-7 * float(ORDER) * evaluate(Polynomial(abs(p.Low), abs(p.High)), t);
}

// Roots of c + b t + a t^2 in [0, 1], the lesser one first.
int rootsOfQuadratic(float c, float b, float a, out vec3 roots)
{
  roots = vec3(0.0);
  float halfB = -0.5 * b;
  float discriminant = halfB * halfB - a * c;
  if (!(discriminant >= 0.0))
  {
    return 0;
  }
  float sum = halfB + (halfB < 0.0 ? -1.0 : 1.0) * sqrt(discriminant);
  vec2 both = vec2(a != 0.0 ? sum / a : -1.0, sum != 0.0 ? c / sum : -1.0);
  both = both.x < both.y ? both : both.yx;
  bool first = both.x >= 0.0 && both.x <= 1.0;
  bool second = both.y >= 0.0 && both.y <= 1.0;
  roots.xy = first ? both : both.yx;
  return (first ? 1 : 0) + (second ? 1 : 0);
}

// Newton's method, with bisection where that leaves the bracket or is slow.
float rootInBracket(Polynomial p, float begin, float end)
{
  float atBegin = evaluate(p, begin);
  float atEnd = evaluate(p, end);
  float t = begin + (end - begin) * (atBegin / (atBegin - atEnd));
  t = t >= begin && t <= end ? t : 0.5 * (begin + end);
  float lastStep = end - begin;
  for (int i = 0; i < 40; ++i)
  {
    float value = evaluate(p, t);
    if (value == 0.0)
    {
      return t;
    }
    if ((value < 0.0) == (atBegin < 0.0))
    {
      begin = t;
    }
    else
    {
      end = t;
    }
    float slope = evaluateSlope(p, t);
    float next = slope != 0.0 ? t - value / slope : begin;
    if (!(next > begin && next < end) || abs(next - t) > 0.5 * lastStep)
    {
      next = 0.5 * (begin + end);
    }
    lastStep = abs(next - t);
    t = next;
    if (lastStep <= 1.2e-7 * abs(t))
    {
      return t;
    }
  }
  return t;
}

// The first roots in [0, 1], at most `limit`, of a polynomial that turns at `turns`.
int rootsBetween(Polynomial p, vec3 turns, int count, int limit, out vec3 roots)
{
  roots = vec3(0.0);
  float begin = 0.0;
  float atBegin = p.Low.x;
  int found = atBegin == 0.0 ? 1 : 0;
  for (int i = 0; i <= count && found < limit; ++i)
  {
    float end = i == count ? 1.0 : i == 0 ? turns.x : i == 1 ? turns.y : turns.z;
    float atEnd = evaluate(p, end);
    bool touches = atEnd == 0.0 || (i < count && abs(atEnd) <= getRoundingError(p, end));
    bool crosses = (atBegin < 0.0 && atEnd > 0.0) || (atBegin > 0.0 && atEnd < 0.0);
    if (touches || crosses)
    {
      float root = touches ? end : rootInBracket(p, begin, end);
      roots = found == 0 ? vec3(root) : found == 1 ? vec3(roots.x, root, root) : vec3(roots.xy, root);
      ++found;
    }
    begin = end;
    atBegin = touches ? 0.0 : atEnd;
  }
  return found;
}

// How often the signs of the Bernstein coefficients change.
int countSignChanges(Polynomial p)
{
#if ORDER == 4
  vec4 b = vec4(4.0 * p.Low.x + p.Low.y, 6.0 * p.Low.x + 3.0 * p.Low.y + p.Low.z,
    4.0 * p.Low.x + 3.0 * p.Low.y + 2.0 * p.Low.z + p.Low.w, dot(p.Low, vec4(1.0)) + p.High);
#else
  vec4 b = vec4(3.0 * p.Low.x + p.Low.y, 3.0 * p.Low.x + 2.0 * p.Low.y + p.Low.z,
    vec2(dot(p.Low, vec4(1.0))));
#endif
  bvec4 negative = lessThan(b, vec4(0.0));
  bvec4 before = bvec4(p.Low.x < 0.0, negative.xyz);
  return int(dot(vec4(notEqual(negative, before)), vec4(1.0)));
}

bool firstRoot(Polynomial p, out float root)
{
#if ORDER == 1
  root = p.Low.y != 0.0 ? -p.Low.x / p.Low.y : -1.0;
  return root >= 0.0 && root <= 1.0;
#else
  vec3 roots;
#if ORDER == 2
  bool found = rootsOfQuadratic(p.Low.x, p.Low.y, p.Low.z, roots) > 0;
#else
  int changes = countSignChanges(p);
  if (changes == 0)
  {
    root = 1.0;
    return false;
  }
  if (changes == 1)
  {
    root = rootInBracket(p, 0.0, 1.0);
    return true;
  }
  vec3 turns;
#if ORDER == 3
  int count = rootsOfQuadratic(p.Low.y, 2.0 * p.Low.z, 3.0 * p.Low.w, turns);
#else
  vec3 turnsOfSlope;
  int countOfSlope =
    rootsOfQuadratic(2.0 * p.Low.z, 6.0 * p.Low.w, 12.0 * p.High, turnsOfSlope);
  Polynomial slope =
    Polynomial(vec4(p.Low.y, 2.0 * p.Low.z, 3.0 * p.Low.w, 4.0 * p.High), 0.0);
  int count = rootsBetween(slope, turnsOfSlope, countOfSlope, 3, turns);
#endif
  bool found = rootsBetween(p, turns, count, 1, roots) > 0;
#endif
  root = roots.x;
  return found;
#endif
}
