// SPDX-License-Identifier: BSD-3-Clause
/**
 * First roots judged by Sturm's theorem in a hundred digits, of random polynomials and of hard
 * ones.
 */
#ifndef PolynomialRootsOracle_h
#define PolynomialRootsOracle_h

#include "vtkPolynomialRoots.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace PolynomialRootsTest
{
using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<100>,
  boost::multiprecision::et_off>;

/// Counts the roots of a polynomial in an interval by Sturm's theorem.
class Sturm
{
public:
  template <typename Real, std::size_t Size>
  explicit Sturm(const std::array<Real, Size>& coefficients)
  {
    Chain first(coefficients.begin(), coefficients.end());
    Number largest = 0;
    for (const Number& c : first)
    {
      largest = std::max<Number>(largest, abs(c));
    }
    this->Add(first, largest);
    if (this->Chains.empty() || this->Chains[0].size() < 2)
    {
      return;
    }
    Chain derivative;
    for (std::size_t i = 1; i < this->Chains[0].size(); ++i)
    {
      derivative.push_back(this->Chains[0][i] * static_cast<int>(i));
    }
    this->Chains.push_back(derivative);
    while (this->Chains.back().size() > 1)
    {
      Chain rest = this->Chains[this->Chains.size() - 2];
      const Chain& by = this->Chains.back();
      Number size = 0; // of what is subtracted: the rest is rounding where it is far smaller
      while (rest.size() >= by.size())
      {
        const Number factor = rest.back() / by.back();
        const std::size_t shift = rest.size() - by.size();
        for (std::size_t i = 0; i < by.size(); ++i)
        {
          size = std::max<Number>(size, abs(rest[i + shift]));
          rest[i + shift] -= factor * by[i];
          size = std::max<Number>(size, abs(factor * by[i]));
        }
        rest.pop_back();
      }
      for (Number& c : rest)
      {
        c = -c;
      }
      if (!this->Add(rest, size))
      {
        break;
      }
    }
  }

  /// Different roots in (begin, end].
  int Count(const Number& begin, const Number& end) const
  {
    return this->CountChanges(begin) - this->CountChanges(end);
  }

  /// Halves (begin, end], which has a root, until its first one is known.
  Number GetFirstRoot(Number begin, Number end) const
  {
    for (int i = 0; i < 120; ++i)
    {
      const Number middle = (begin + end) / 2;
      (this->Count(begin, middle) > 0 ? end : begin) = middle;
    }
    return end;
  }

  /// The distance from t to the root nearest to it, one of which is no farther away than `most`.
  Number GetDistance(const Number& t, Number most) const
  {
    Number least = 0;
    for (int i = 0; i < 60; ++i)
    {
      const Number middle = (least + most) / 2;
      (this->Count(t - middle, t + middle) > 0 ? most : least) = middle;
    }
    return most;
  }

private:
  using Chain = std::vector<Number>;

  bool Add(Chain chain, const Number& size)
  {
    while (!chain.empty() && abs(chain.back()) <= size * 1e-70)
    {
      chain.pop_back();
    }
    if (chain.empty())
    {
      return false;
    }
    this->Chains.push_back(chain);
    return true;
  }

  int CountChanges(const Number& t) const
  {
    int changes = 0;
    int last = 0;
    for (const Chain& chain : this->Chains)
    {
      Number value = 0;
      for (auto c = chain.rbegin(); c != chain.rend(); ++c)
      {
        value = value * t + *c;
      }
      const int sign = value > 0 ? 1 : value < 0 ? -1 : 0;
      changes += sign * last < 0 ? 1 : 0;
      last = sign == 0 ? last : sign;
    }
    return changes;
  }

  std::vector<Chain> Chains;
};

struct Tally
{
  int Solved = 0;
  int Missed = 0;          // nearer to a later root, or none, where there is a first one
  int MissedSeparated = 0; // of these, the next root is more than 1e-4 away
  int Invented = 0;        // a root where there is none, nor nearly
  int Faulty = 0;          // not a number, or not in [0, 1]
  double LargestError = 0.0;
  double Nanoseconds = 0.0;
};

template <int Degree>
using Polynomials = std::vector<vtkPolynomialRoots::Polynomial<Degree, double>>;

/// Roots that are farther apart than this are to be told apart.
constexpr double Separation = 1e-4;

/// A solver of one polynomial as one of many: its answers are roots, or -1 where there is none.
template <typename Solver>
auto OneByOne(const Solver& solve)
{
  return [solve](const auto& polynomials, auto& answers)
  {
    for (std::size_t i = 0; i < polynomials.size(); ++i)
    {
      auto root = answers[i];
      answers[i] = solve(polynomials[i], root) ? root : -1;
    }
  };
}

/// What a solver says of polynomials, the time that it takes, and what the oracle says to that.
/// Roots nearer to each other than `resolution` count as one; a root farther away than `tolerance`
/// is none.
template <int Degree, typename Real, typename Solver>
Tally Judge(
  const Polynomials<Degree>& polynomials, double resolution, double tolerance, const Solver& solve)
{
  std::vector<vtkPolynomialRoots::Polynomial<Degree, Real>> inputs;
  for (const auto& p : polynomials)
  {
    inputs.emplace_back();
    std::copy(p.begin(), p.end(), inputs.back().begin());
  }
  std::vector<Real> answers(inputs.size());
  const std::clock_t start = std::clock(); // of the processor: others may be at work
  solve(inputs, answers);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  Tally tally;
  tally.Nanoseconds = 1e9 * seconds / inputs.size();

  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    const Sturm sturm(inputs[i]);
    const double answer = answers[i];
    ++tally.Solved;
    if (!(answer == -1.0 || (answer >= 0.0 && answer <= 1.0)))
    {
      ++tally.Faulty;
      continue;
    }
    // a root at an end may fall to either side of it
    const double edge = 1e-12 + 10 * std::numeric_limits<Real>::epsilon();
    const double before = answer < 0.0 ? 1.0 - edge : answer - 0.5 * resolution;
    if (before > edge && sturm.Count(edge, before) > 0)
    {
      const Number first = sturm.GetFirstRoot(edge, before);
      if (answer < 0.0 || sturm.Count(first, first + 2 * (answer - first)) > 0)
      {
        ++tally.Missed;
        tally.MissedSeparated += sturm.Count(first, first + Separation) == 0 ? 1 : 0;
        continue;
      }
    }
    if (answer < 0.0)
    {
      continue;
    }
    if (sturm.Count(answer - tolerance, answer + tolerance) == 0)
    {
      const Real value = vtkPolynomialRoots::Evaluate<Degree>(inputs[i], answers[i]);
      const Real noise = vtkPolynomialRoots::GetRoundingError<Degree>(inputs[i], answers[i]);
      tally.Invented += std::abs(value) > 2 * noise ? 1 : 0;
      continue;
    }
    if (i % 16 == 0) // an exact root takes long
    {
      const Number error = sturm.GetDistance(answer, tolerance);
      tally.LargestError = std::max(tally.LargestError, static_cast<double>(error));
    }
  }
  return tally;
}

template <int Degree>
Polynomials<Degree> MakeRandom(int count)
{
  std::mt19937_64 random(Degree);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Polynomials<Degree> polynomials(count);
  for (auto& p : polynomials)
  {
    for (double& c : p)
    {
      c = uniform(random);
    }
  }
  return polynomials;
}

/// The product of (t - roots[i]) and of t^2 + 1 for what is left of the degree.
template <int Degree>
vtkPolynomialRoots::Polynomial<Degree, double> Multiply(const std::vector<double>& roots)
{
  std::vector<double> product = { 1.0 };
  auto times = [&](const std::vector<double>& factor)
  {
    std::vector<double> result(product.size() + factor.size() - 1, 0.0);
    for (std::size_t i = 0; i < product.size(); ++i)
    {
      for (std::size_t k = 0; k < factor.size(); ++k)
      {
        result[i + k] += product[i] * factor[k];
      }
    }
    product = result;
  };
  for (double root : roots)
  {
    times({ -root, 1.0 });
  }
  while (product.size() + 1 < Degree + 1)
  {
    times({ 1.0, 0.0, 1.0 });
  }
  vtkPolynomialRoots::Polynomial<Degree, double> p{};
  std::copy(product.begin(), product.end(), p.begin());
  return p;
}

/// Double, triple and nearly multiple roots, leading coefficients that vanish, coefficients of all
/// sizes, rays that graze, a last root at 1.
template <int Degree>
Polynomials<Degree> MakeHard(int count)
{
  std::mt19937_64 random(100 + Degree);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_real_distribution<double> both(-1.0, 1.0);
  Polynomials<Degree> polynomials;
  auto shuffleSign = [&](vtkPolynomialRoots::Polynomial<Degree, double> p)
  {
    const double scale = (unit(random) < 0.5 ? -1.0 : 1.0) * std::pow(10.0, 12.0 * both(random));
    for (double& c : p)
    {
      c *= scale;
    }
    polynomials.push_back(p);
  };
  for (int i = 0; i < count; ++i)
  {
    const double r = unit(random);
    const double gap = std::pow(10.0, -16.0 * unit(random));
    shuffleSign(Multiply<Degree>({ r, r }));
    shuffleSign(Multiply<Degree>({ r, r + gap }));
    if (Degree > 2)
    {
      shuffleSign(Multiply<Degree>({ r, r, r }));
      shuffleSign(Multiply<Degree>({ r, r + gap, r + 2.0 * gap }));
      shuffleSign(Multiply<Degree>({ r, r, unit(random) }));
      shuffleSign(Multiply<Degree>({ r, r + gap, unit(random) }));
    }
    if (Degree > 3)
    {
      shuffleSign(Multiply<Degree>({ r, r, r, r }));
      const double q = unit(random);
      shuffleSign(Multiply<Degree>({ r, r + gap, q, q + gap }));
    }
    vtkPolynomialRoots::Polynomial<Degree, double> p;
    for (double& c : p)
    {
      c = both(random);
    }
    for (int k = Degree; k > 0; --k)
    {
      p[k] *= unit(random) < 0.3 ? 0.0 : std::pow(10.0, -20.0 * unit(random));
      shuffleSign(p);
    }
    for (double& c : p)
    {
      c = (unit(random) < 0.5 ? -1.0 : 1.0) * std::pow(10.0, 12.0 * both(random));
    }
    polynomials.push_back(p);
    // a parabola's top just under or over the ray
    p = {};
    p[0] = r * r + 0.1 * gap * both(random);
    p[1] = -2.0 * r;
    p[2] = 1.0;
    shuffleSign(p);
    // all but constant, its coefficients' product too small for a float
    p = {};
    p[0] = 1e-12 * (1.0 + r);
    p[2] = -1e-30;
    polynomials.push_back(p);
    if (Degree > 2)
    {
      const double early = std::floor(64.0 * r) / 64.0; // exactly 0 at 1
      polynomials.push_back(Multiply<Degree>({ early, 1.0, 1.0 + early }));
    }
  }
  return polynomials;
}

inline void PrintHead()
{
  std::cout << "| degree | polynomials | solver | count | missed | of these separated by 1e-4 "
               "| invented | not a number | largest error | ns |\n"
               "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
}

inline void Print(const std::string& what, const Tally& tally)
{
  std::cout << "| " << what << " | " << tally.Solved << " | " << tally.Missed << " | "
            << tally.MissedSeparated << " | " << tally.Invented << " | " << tally.Faulty << " | "
            << std::setprecision(2) << tally.LargestError << " | " << std::setprecision(3)
            << tally.Nanoseconds << " |" << std::endl;
}

/// Which roots are one, and how far from a root an answer may be. A root of higher multiplicity is
/// known to a root of the precision.
struct Limits
{
  double Resolution;
  double Tolerance;
};

inline Limits GetLimits(bool hard, bool inFloats)
{
  if (inFloats)
  {
    return hard ? Limits{ Separation, 2e-2 } : Limits{ 2e-3, 1e-3 };
  }
  return hard ? Limits{ Separation, 1e-3 } : Limits{ 2e-6, 1e-6 };
}

/// Of `count` random ones; of the hard kinds a fiftieth each.
template <int Degree>
Polynomials<Degree> Make(bool hard, int count)
{
  return hard ? MakeHard<Degree>(count / 50) : MakeRandom<Degree>(count);
}

inline std::string GetName(int degree, bool hard)
{
  return std::to_string(degree) + " | " + (hard ? "hard" : "random") + " | ";
}
}

#endif
