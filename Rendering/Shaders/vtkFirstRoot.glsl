// SPDX-License-Identifier: BSD-3-Clause
// The first root of a polynomial of degree ORDER between 0 and 1; the mirror of
// vtkPolynomialRoots.h, which tells how. No arrays: Mesa 22.3's llvmpipe gets loops over them wrong.
// vtkFirstRootShader.h tells what Real, ROUNDING and PRECISION are: the text is compiled for floats,
// and before that for doubles where the context has them.

// The coefficients of 1, t, t^2, t^3, and that of t^4.
struct Polynomial
{
  Real4 Low;
  Real High;
};

Real evaluate(Polynomial p, Real t)
{
  return (((p.High * t + p.Low.w) * t + p.Low.z) * t + p.Low.y) * t + p.Low.x;
}

Real evaluateSlope(Polynomial p, Real t)
{
  return ((4.0 * p.High * t + 3.0 * p.Low.w) * t + 2.0 * p.Low.z) * t + p.Low.y;
}

// What rounding can make of evaluate() where the value is 0.
Real getRoundingError(Polynomial p, Real t)
{
  return ROUNDING * Real(ORDER) * evaluate(Polynomial(abs(p.Low), abs(p.High)), t);
}

// Roots of c + b t + a t^2 in [0, 1], the lesser one first.
int rootsOfQuadratic(Real c, Real b, Real a, out Real3 roots)
{
  roots = Real3(0.0);
  if (abs(c) > abs(b) + abs(a)) // too far from 0, and a c may be too small for a float
  {
    return 0;
  }
  Real halfB = -0.5 * b;
  Real discriminant = halfB * halfB - a * c;
#ifdef USES_DOUBLES
  if (abs(discriminant) < 1e-3 * halfB * halfB)
  {
    discriminant = Real(double(halfB) * double(halfB) - double(a) * double(c)); // exact products
  }
#endif
  if (!(discriminant >= 0.0))
  {
    return 0;
  }
  Real sum = halfB + (halfB < 0.0 ? -1.0 : 1.0) * sqrt(discriminant);
  Real2 both = Real2(a != 0.0 ? sum / a : -1.0, sum != 0.0 ? c / sum : -1.0);
  both = both.x < both.y ? both : both.yx;
  bool first = both.x >= 0.0 && both.x <= 1.0;
  bool second = both.y >= 0.0 && both.y <= 1.0;
  roots.xy = first ? both : both.yx;
  return (first ? 1 : 0) + (second ? 1 : 0);
}

// Newton's method, with bisection where that leaves the bracket or is slow.
Real rootInBracket(Polynomial p, Real begin, Real end)
{
  Real atBegin = evaluate(p, begin);
  Real atEnd = evaluate(p, end);
  Real t = begin + (end - begin) * (atBegin / (atBegin - atEnd));
  t = t > begin && t < end ? t : 0.5 * (begin + end); // where 0 at an end, a root may come before
  Real lastStep = end - begin;
  for (int i = 0; i < 40; ++i)
  {
    Real value = evaluate(p, t);
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
    Real slope = evaluateSlope(p, t);
    Real next = slope != 0.0 ? t - value / slope : begin;
    if (!(next > begin && next < end) || abs(next - t) > 0.5 * lastStep)
    {
      next = 0.5 * (begin + end);
    }
    lastStep = abs(next - t);
    t = next;
    if (lastStep <= PRECISION * abs(t))
    {
      return t;
    }
  }
  return t;
}

// The first roots in [0, 1], at most `limit`, of a polynomial that turns at `turns`.
int rootsBetween(Polynomial p, Real3 turns, int count, int limit, out Real3 roots)
{
  roots = Real3(0.0);
  Real begin = 0.0;
  Real atBegin = p.Low.x;
  int found = atBegin == 0.0 ? 1 : 0;
  for (int i = 0; i <= count && found < limit; ++i)
  {
    Real end = i == count ? 1.0 : i == 0 ? turns.x : i == 1 ? turns.y : turns.z;
    Real atEnd = evaluate(p, end);
    bool touches = atEnd == 0.0 || (i < count && abs(atEnd) <= getRoundingError(p, end));
    bool crosses = (atBegin < 0.0 && atEnd > 0.0) || (atBegin > 0.0 && atEnd < 0.0);
    if (touches || crosses)
    {
      Real root = crosses ? rootInBracket(p, begin, end) : end;
      roots = found == 0 ? Real3(root) : found == 1 ? Real3(roots.x, root, root) : Real3(roots.xy, root);
      ++found;
    }
    begin = end;
    atBegin = touches ? 0.0 : atEnd;
  }
  return found;
}

// All but the first of the Bernstein coefficients, which that of 1 is, times whole numbers.
Real4 getBernstein(Polynomial p)
{
#if ORDER == 4
  return Real4(4.0 * p.Low.x + p.Low.y, 6.0 * p.Low.x + 3.0 * p.Low.y + p.Low.z,
    4.0 * p.Low.x + 3.0 * p.Low.y + 2.0 * p.Low.z + p.Low.w, dot(p.Low, Real4(1.0)) + p.High);
#else
  return Real4(3.0 * p.Low.x + p.Low.y, 3.0 * p.Low.x + 2.0 * p.Low.y + p.Low.z,
    Real2(dot(p.Low, Real4(1.0))));
#endif
}

// How often the signs of the Bernstein coefficients change; several times where one is within
// rounding and doubles can tell.
int countSignChanges(Polynomial p)
{
  Real4 b = getBernstein(p);
#ifdef USES_DOUBLES
  Real4 sizes = getBernstein(Polynomial(abs(p.Low), abs(p.High)));
  if (any(lessThan(abs(b), ROUNDING * sizes)))
  {
    return ORDER;
  }
#endif
  bvec4 negative = lessThan(b, Real4(0.0));
  bvec4 before = bvec4(p.Low.x < 0.0, negative.xyz);
  return int(dot(vec4(notEqual(negative, before)), vec4(1.0)));
}

bool firstRoot(Polynomial p, out Real root)
{
#if ORDER == 1
  root = p.Low.y != 0.0 ? -p.Low.x / p.Low.y : -1.0;
  return root >= 0.0 && root <= 1.0;
#elif ORDER == 2
  Real3 roots;
  bool found = rootsOfQuadratic(p.Low.x, p.Low.y, p.Low.z, roots) > 0;
  root = roots.x;
  return found;
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
#ifdef USES_DOUBLES
  double precise;
  bool found = firstRoot(PolynomialOfDoubles(dvec4(p.Low), double(p.High)), precise);
  root = Real(precise);
  return found;
#else
  Real3 turns;
#if ORDER == 3
  int count = rootsOfQuadratic(p.Low.y, 2.0 * p.Low.z, 3.0 * p.Low.w, turns);
#else
  Real3 turnsOfSlope;
  int countOfSlope =
    rootsOfQuadratic(2.0 * p.Low.z, 6.0 * p.Low.w, 12.0 * p.High, turnsOfSlope);
  Polynomial slope =
    Polynomial(Real4(p.Low.y, 2.0 * p.Low.z, 3.0 * p.Low.w, 4.0 * p.High), 0.0);
  int count = rootsBetween(slope, turnsOfSlope, countOfSlope, 3, turns);
#endif
  Real3 roots;
  bool found = rootsBetween(p, turns, count, 1, roots) > 0;
  root = roots.x;
  return found;
#endif
#endif
}
