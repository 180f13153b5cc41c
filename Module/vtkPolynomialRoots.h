// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPolynomialRoots
 * @brief   the first root of a polynomial of degree 1 to 4 between 0 and 1
 *
 * A ray meets an algebraic splat where a polynomial of the ray's parameter is zero; scaled to the
 * part of the ray that lies over the splat's disc, the hit is the least root in [0, 1]. Polynomials
 * are arrays with the coefficient of t^i at i.
 *
 * Two ways, over the same interface. FirstRoot() brackets: the signs of the Bernstein coefficients
 * tell most intervals without a root and most with exactly one; else the roots of the derivative
 * part the interval where the polynomial turns, down to a quadratic, which is solved in closed
 * form; in a bracket Newton's method falls back to bisection. FirstRootInClosedForm() is the
 * paper's (Bolla and Narayanan, section 3.1): Blinn's method for cubics, Ferrari's for quartics. It
 * misses roots near others, so the first is what the mapper uses; vtkFirstRoot.glsl is its
 * mirror.
 *
 * All functions take any finite coefficients; none returns NaN.
 */
#ifndef vtkPolynomialRoots_h
#define vtkPolynomialRoots_h

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vtkPolynomialRoots
{
template <int Degree, typename Real>
using Polynomial = std::array<Real, Degree + 1>;

/**
 * a b - c d, within two units of its last place (W. Kahan's way).
 */
template <typename Real>
Real DifferenceOfProducts(Real a, Real b, Real c, Real d)
{
  const Real product = c * d;
  return std::fma(a, b, -product) - std::fma(c, d, -product);
}

template <int Degree, typename Real>
Real Evaluate(const Polynomial<Degree, Real>& p, Real t)
{
  Real value = p[Degree];
  for (int i = Degree - 1; i >= 0; --i)
  {
    value = value * t + p[i];
  }
  return value;
}

template <int Degree, typename Real>
Polynomial<Degree - 1, Real> Differentiate(const Polynomial<Degree, Real>& p)
{
  Polynomial<Degree - 1, Real> derivative;
  for (int i = 0; i < Degree; ++i)
  {
    derivative[i] = (i + 1) * p[i + 1];
  }
  return derivative;
}

/**
 * Roots of a polynomial in closed form; there is room for `Degree` of them. Returns how many. They
 * are real and in no order; a leading coefficient of 0 lowers the degree, and of the zero
 * polynomial there are none.
 */
template <typename Real>
int SolveInClosedForm(const Polynomial<1, Real>& p, Real* roots)
{
  roots[0] = -p[0] / p[1];
  return std::isfinite(roots[0]) ? 1 : 0;
}

template <typename Real>
int SolveInClosedForm(const Polynomial<2, Real>& p, Real* roots)
{
  if (p[2] == 0)
  {
    return SolveInClosedForm<Real>(Polynomial<1, Real>{ p[0], p[1] }, roots);
  }
  const Real half = -p[1] / 2;
  const Real discriminant = DifferenceOfProducts(half, half, p[2], p[0]);
  if (!(discriminant >= 0))
  {
    return 0;
  }
  // the root of larger size without cancellation, the other one from their product
  const Real sum = half + std::copysign(std::sqrt(discriminant), half);
  int count = 0;
  for (const Real root : { sum / p[2], p[0] / sum })
  {
    if (std::isfinite(root))
    {
      roots[count++] = root;
    }
  }
  return count;
}

/**
 * What rounding can make of Evaluate() on [0, 1] where the value is 0.
 */
template <int Degree, typename Real>
Real GetRoundingError(const Polynomial<Degree, Real>& p, Real t)
{
  Real sum = std::abs(p[Degree]);
  for (int i = Degree - 1; i >= 0; --i)
  {
    sum = sum * t + std::abs(p[i]);
  }
  return 2 * Degree * std::numeric_limits<Real>::epsilon() * sum;
}

/**
 * Evaluate() as if it were done in twice the precision (compensated Horner scheme; P. Langlois, N.
 * Louvet, How to Ensure a Faithful Polynomial Evaluation, ARITH 2007): tells the sign where
 * GetRoundingError() hides it.
 */
template <int Degree, typename Real>
Real EvaluateCompensated(const Polynomial<Degree, Real>& p, Real t)
{
  Real value = p[Degree];
  Real error = 0;
  for (int i = Degree - 1; i >= 0; --i)
  {
    const Real product = value * t;
    const Real productError = std::fma(value, t, -product);
    value = product + p[i];
    const Real added = value - product;
    error = error * t + (productError + ((product - (value - added)) + (p[i] - added)));
  }
  return value + error;
}

/**
 * The root in [begin, end], over which the polynomial changes its sign by less than rounding.
 */
template <int Degree, typename Real>
Real FaintRootInBracket(const Polynomial<Degree, Real>& p, Real begin, Real end)
{
  const bool isNegative = EvaluateCompensated<Degree>(p, begin) < 0;
  for (int i = 0; i < std::numeric_limits<Real>::digits; ++i)
  {
    const Real middle = begin + (end - begin) / 2;
    ((EvaluateCompensated<Degree>(p, middle) < 0) == isNegative ? begin : end) = middle;
  }
  return end;
}

/**
 * The root in [begin, end], over which the polynomial changes its sign once, by Newton's method
 * with bisection where that leaves the bracket or is slow.
 */
template <int Degree, typename Real>
Real RootInBracket(const Polynomial<Degree, Real>& p, Real begin, Real end)
{
  const Polynomial<Degree - 1, Real> derivative = Differentiate<Degree>(p);
  const Real atBegin = Evaluate<Degree>(p, begin);
  const Real atEnd = Evaluate<Degree>(p, end);
  // where the chord crosses zero; not at an end, for where it is 0 there, a root may come before
  Real t = begin + (end - begin) * (atBegin / (atBegin - atEnd));
  t = t > begin && t < end ? t : begin + (end - begin) / 2;
  Real lastStep = end - begin;
  for (int i = 0; i < std::numeric_limits<Real>::digits + 20; ++i)
  {
    const Real value = Evaluate<Degree>(p, t);
    if (value == 0)
    {
      return t;
    }
    ((value < 0) == (atBegin < 0) ? begin : end) = t;
    Real next = t - value / Evaluate<Degree - 1>(derivative, t);
    if (!(next > begin && next < end) || std::abs(next - t) > lastStep / 2)
    {
      next = begin + (end - begin) / 2;
    }
    lastStep = std::abs(next - t);
    if (lastStep <= std::numeric_limits<Real>::epsilon() * std::abs(next))
    {
      return next;
    }
    t = next;
  }
  return t;
}

/**
 * Calls `visit(begin, end)` for the intervals of [0, 1], from the first on, over which the
 * polynomial is monotone, until it returns true. Returns whether it did.
 */
template <int Degree, typename Real, typename Visitor>
bool VisitMonotoneIntervals(const Polynomial<Degree, Real>& p, const Visitor& visit);

/**
 * Calls `found(root)` for the roots in [0, 1], from the first on, until it returns true. Returns
 * whether it did. Roots that touch zero without crossing it are among them.
 */
template <int Degree, typename Real, typename Visitor>
bool VisitRoots(const Polynomial<Degree, Real>& p, const Visitor& found)
{
  if constexpr (Degree == 2)
  {
    Real roots[2];
    const int count = SolveInClosedForm<Real>(p, roots);
    std::sort(roots, roots + count);
    return std::any_of(
      roots, roots + count, [&](Real root) { return root >= 0 && root <= 1 && found(root); });
  }
  Real atBegin = p[0];
  if (atBegin == 0 && found(Real(0)))
  {
    return true;
  }
  return VisitMonotoneIntervals<Degree>(p,
    [&](Real begin, Real end)
    {
      Real atEnd = Evaluate<Degree>(p, end);
      const bool touches = end < 1 && std::abs(atEnd) <= GetRoundingError<Degree>(p, end);
      if (touches)
      {
        atEnd = EvaluateCompensated<Degree>(p, end);
      }
      const bool crosses = (atBegin < 0 && atEnd > 0) || (atBegin > 0 && atEnd < 0);
      atBegin = atEnd;
      if (crosses)
      {
        return found(touches ? FaintRootInBracket<Degree>(p, begin, end)
                             : RootInBracket<Degree>(p, begin, end));
      }
      return (touches || atEnd == 0) && found(end);
    });
}

template <int Degree, typename Real, typename Visitor>
bool VisitMonotoneIntervals(const Polynomial<Degree, Real>& p, const Visitor& visit)
{
  Real begin = 0;
  if constexpr (Degree > 1)
  {
    if (VisitRoots<Degree - 1>(Differentiate<Degree>(p),
          [&](Real turn)
          {
            const Real from = begin;
            begin = turn;
            return turn > from && visit(from, turn);
          }))
    {
      return true;
    }
  }
  return begin < 1 && visit(begin, Real(1));
}

/**
 * How often the signs of the Bernstein coefficients over [0, 1] change: no less than the number of
 * roots between 0 and 1, and exactly one root there if it is 1.
 */
template <int Degree, typename Real>
int CountSignChanges(const Polynomial<Degree, Real>& p)
{
  static constexpr int shares[4][5][5] = { { { 1 }, { 1, 1 } }, { { 2 }, { 2, 1 }, { 2, 2, 2 } },
    { { 3 }, { 3, 1 }, { 3, 2, 1 }, { 3, 3, 3, 3 } },
    { { 12 }, { 12, 3 }, { 12, 6, 2 }, { 12, 9, 6, 3 }, { 12, 12, 12, 12, 12 } } };
  int changes = 0;
  bool wasNegative = p[0] < 0;
  for (int i = 1; i <= Degree; ++i)
  {
    Real b = 0;
    for (int k = 0; k <= i; ++k)
    {
      b += shares[Degree - 1][i][k] * p[k];
    }
    changes += (b < 0) != wasNegative ? 1 : 0;
    wasNegative = b < 0;
  }
  return changes;
}

/**
 * The first root in [0, 1], by brackets. Returns false where there is none.
 */
template <int Degree, typename Real>
bool FirstRoot(const Polynomial<Degree, Real>& p, Real& root)
{
  if (p[0] == 0)
  {
    root = 0;
    return true;
  }
  const int changes = Degree > 2 ? CountSignChanges<Degree>(p) : Degree;
  if (changes == 0)
  {
    root = 1;
    return Evaluate<Degree>(p, Real(1)) == 0;
  }
  if (Degree > 2 && changes == 1)
  {
    root = RootInBracket<Degree>(p, Real(0), Real(1));
    return true;
  }
  return VisitRoots<Degree>(p,
    [&](Real t)
    {
      root = t;
      return true;
    });
}

//------------------------------------------------------------------------------
/**
 * After: J. F. Blinn, How to Solve a Cubic Equation, Part 5: Back to Numerics, 2007.
 */
template <typename Real>
int SolveInClosedForm(const Polynomial<3, Real>& p, Real* roots)
{
  if (p[3] == 0)
  {
    return SolveInClosedForm<Real>(Polynomial<2, Real>{ p[0], p[1], p[2] }, roots);
  }
  const Real a = p[3], b = p[2] / 3, c = p[1] / 3, d = p[0];
  const Real d1 = a * c - b * b;
  const Real d2 = a * d - b * c;
  const Real d3 = b * d - c * c;
  const Real discriminant = 4 * d1 * d3 - d2 * d2;
  int count = 0;
  auto add = [&](Real x, Real w)
  {
    const Real root = x / w;
    if (std::isfinite(root))
    {
      roots[count++] = root;
    }
  };
  if (discriminant <= 0)
  {
    const bool byA = b * b * b * d >= a * c * c * c;
    const Real at = byA ? a : d;
    const Real ct = byA ? d1 : d3;
    const Real dt = byA ? -2 * b * d1 + a * d2 : -d * d2 + 2 * c * d3;
    const Real t0 = -std::copysign(std::abs(at) * std::sqrt(-discriminant), dt);
    const Real t1 = -dt + t0;
    const Real r = std::cbrt(t1 / 2);
    const Real s = t1 == t0 ? -r : -ct / r;
    const Real x = ct <= 0 ? r + s : -dt / (r * r + s * s + ct);
    byA ? add(x - b, a) : add(-d, x + c);
    return count;
  }
  const Real root3 = std::sqrt(Real(3));
  const Real root = std::sqrt(discriminant);
  auto solveDepressed = [&](Real leading, Real ct, Real dt, Real& first, Real& third)
  {
    const Real angle = std::abs(std::atan2(leading * root, -dt)) / 3;
    const Real size = 2 * std::sqrt(-ct);
    first = size * std::cos(angle);
    third = size * (-std::cos(angle) - root3 * std::sin(angle)) / 2;
  };
  Real first, third;
  solveDepressed(a, d1, -2 * b * d1 + a * d2, first, third);
  const Real xl = (first + third > 2 * b ? first : third) - b;
  const Real wl = a;
  solveDepressed(d, d3, -d * d2 + 2 * c * d3, first, third);
  const Real xs = -d;
  const Real ws = (first + third < 2 * c ? first : third) + c;
  const Real e = wl * ws;
  const Real f = -xl * ws - wl * xs;
  const Real g = xl * xs;
  add(xl, wl);
  add(c * f - b * g, -b * f + c * e);
  add(xs, ws);
  return count;
}

/**
 * After: D. Herbison-Evans, Solving Quartics and Cubics for Graphics, Graphics Gems V, 1995
 * (Ferrari's method), with Blinn's for the resolvent cubic.
 */
template <typename Real>
int SolveInClosedForm(const Polynomial<4, Real>& p, Real* roots)
{
  if (p[4] == 0)
  {
    return SolveInClosedForm<Real>(Polynomial<3, Real>{ p[0], p[1], p[2], p[3] }, roots);
  }
  const Real a = p[3] / p[4], b = p[2] / p[4], c = p[1] / p[4], d = p[0] / p[4];
  const Polynomial<3, Real> resolvent = { (4 * b - a * a) * d - c * c, a * c - 4 * d, -b, Real(1) };
  Real candidates[3] = {};
  const int found = SolveInClosedForm<Real>(resolvent, candidates);
  if (found == 0)
  {
    return 0;
  }
  const Real y = *std::max_element(candidates, candidates + found);
  const Real e2 = std::max(a * a / 4 - b + y, Real(0));
  const Real f2 = std::max(y * y / 4 - d, Real(0));
  const Real e = std::sqrt(e2);
  const Real f = std::copysign(std::sqrt(f2), a * y / 2 - c);
  const int count =
    SolveInClosedForm<Real>(Polynomial<2, Real>{ y / 2 - f, a / 2 - e, Real(1) }, roots);
  return count +
    SolveInClosedForm<Real>(Polynomial<2, Real>{ y / 2 + f, a / 2 + e, Real(1) }, roots + count);
}

/**
 * The first root in [0, 1], in closed form. Returns false where it finds none.
 */
template <int Degree, typename Real>
bool FirstRootInClosedForm(const Polynomial<Degree, Real>& p, Real& root)
{
  Real roots[4];
  const int count = SolveInClosedForm<Real>(p, roots);
  bool found = false;
  for (int i = 0; i < count; ++i)
  {
    if (roots[i] >= 0 && roots[i] <= 1 && (!found || roots[i] < root))
    {
      root = roots[i];
      found = true;
    }
  }
  return found;
}
}

#endif
