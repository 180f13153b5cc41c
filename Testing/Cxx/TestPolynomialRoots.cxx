// SPDX-License-Identifier: BSD-3-Clause
// vtkPolynomialRoots against Sturm's theorem in a hundred digits. With an argument, the number of
// random polynomials of each degree; the table is what the benchmark quotes.
#include "PointSurfaceTestUtilities.h"

#include <cstdlib>
#include <iostream>

#if __has_include(<boost/multiprecision/cpp_bin_float.hpp>)

#include "PolynomialRootsOracle.h"

using namespace PolynomialRootsTest;

namespace
{
template <int Degree>
void TestDegree(PointSurfaceTest::Checks& check, int count)
{
  using namespace vtkPolynomialRoots;
  auto bracketed = OneByOne([](const auto& p, auto& root) { return FirstRoot<Degree>(p, root); });
  auto closed =
    OneByOne([](const auto& p, auto& root) { return FirstRootInClosedForm<Degree>(p, root); });
  for (bool hard : { false, true })
  {
    const auto polynomials = Make<Degree>(hard, count);
    const std::string kind = GetName(Degree, hard);
    const Limits limits = GetLimits(hard, false);
    const Limits ofFloats = GetLimits(hard, true);
    const Tally ours =
      Judge<Degree, double>(polynomials, limits.Resolution, limits.Tolerance, bracketed);
    Print(kind + "bracketed, double", ours);
    Print(kind + "closed form, double",
      Judge<Degree, double>(polynomials, limits.Resolution, limits.Tolerance, closed));
    const Tally floats =
      Judge<Degree, float>(polynomials, ofFloats.Resolution, ofFloats.Tolerance, bracketed);
    Print(kind + "bracketed, float", floats);
    Print(kind + "closed form, float",
      Judge<Degree, float>(polynomials, ofFloats.Resolution, ofFloats.Tolerance, closed));

    const std::string what =
      "degree " + std::to_string(Degree) + (hard ? ", hard: " : ", random: ");
    check(ours.Faulty == 0 && floats.Faulty == 0, what + "all roots are numbers in [0, 1]");
    check(ours.Invented == 0, what + "no roots where there are none");
    check.AtMost(
      hard ? ours.MissedSeparated : ours.Missed, hard ? 0.0 : 1e-6 * count, what + "missed");
    check.AtMost(ours.LargestError, hard ? 1e-3 : 1e-9, what + "error");
    check.AtMost(
      floats.Missed, (hard ? 1e-3 : 1e-6) * floats.Solved, what + "missed in single precision");
  }
}
} // anonymous namespace

int TestPolynomialRoots(int argc, char* argv[])
{
  const int given = argc > 1 ? std::atoi(argv[1]) : 0; // vtkTesting's own arguments are no numbers
  const int count = given > 0 ? given : 20000;
  PointSurfaceTest::Checks check;
  PrintHead();
  TestDegree<2>(check, count);
  TestDegree<3>(check, count);
  TestDegree<4>(check, count);
  return check.GetResult();
}

#else

int TestPolynomialRoots(int, char*[])
{
  std::cout << "skipped: Boost.Multiprecision is absent" << std::endl;
  return EXIT_SUCCESS;
}

#endif
