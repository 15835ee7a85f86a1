// Roots, trigonometry and Bessel functions on packs agree with the standard library and with closed forms.
#include "bendlab/constraints/pack_math.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/catch.hpp"

namespace bendlab::pack_math_test {

TEMPLATE_TEST_CASE("arc tangent and sine of packs are right to rounding", "[constraints]", float, double) {
  using Real = TestType;
  constexpr int steps = 2000;
  constexpr double ulp = static_cast<double>(std::numeric_limits<Real>::epsilon());
  double arc_error = 0, sine_error = 0;
  for (int i = -steps; i <= steps; ++i) {
    const double angle = std::numbers::pi * i / steps;
    for (const double radius : {1e-6, 1.0, 3e5}) {
      const auto y = static_cast<Real>(radius * std::sin(angle)),
                 x = static_cast<Real>(radius * std::cos(angle));
      const double expected = std::atan2(static_cast<double>(y), static_cast<double>(x));
      const double actual = static_cast<double>(arc_tangent<Real>(broadcast(y), broadcast(x))[0]);
      arc_error = std::max(arc_error, std::abs(actual - expected) / std::max(std::abs(expected), 1e-30));
    }
    const auto half = static_cast<Real>(angle / 2);
    const double expected = std::sin(static_cast<double>(half));
    sine_error =
        std::max(sine_error, std::abs(static_cast<double>(sine<Real>(broadcast(half))[0]) - expected) /
                                 std::max(std::abs(expected), 1e-30));
  }
  // A dozen roundings of half a unit. Most of them are roundings of terms much smaller than the first.
  CHECK(arc_error <= 3 * ulp);
  CHECK(sine_error <= 3 * ulp);
  CHECK(arc_tangent<Real>(broadcast(Real(0)), broadcast(Real(0)))[0] == 0);
}

TEMPLATE_TEST_CASE("inverse square roots of packs are right to rounding", "[constraints]", float, double) {
  using Real = TestType;
  using Limits = std::numeric_limits<Real>;
  const auto inverse = [](Real x) { return inverse_square_root(broadcast(x))[0]; };
  long double error = 0;
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {  // from 1 to 4, because other numbers differ by a power of 4
    const Real x = 1 + Real(3) * static_cast<Real>(i) / steps;
    const long double expected = 1 / std::sqrt(static_cast<long double>(x));
    error = std::max(error, std::abs(static_cast<long double>(inverse(x)) / expected - 1));
    CHECK(inverse(x * Real(0x1p40)) == inverse(x) * Real(0x1p-20));
    CHECK(inverse(x * Real(0x1p-40)) == inverse(x) * Real(0x1p20));
  }
  // The last step rounds twice a number near 1/2, whose error counts as it is, and then the result.
  CHECK(error <= 2 * static_cast<long double>(Limits::epsilon()));
  CHECK(std::isfinite(inverse(Limits::min())));
  CHECK(std::isfinite(inverse(Limits::max())));
}

TEMPLATE_TEST_CASE("Bessel functions of packs are right to rounding", "[constraints]", float, double) {
  using Real = TestType;
  constexpr double ulp = static_cast<double>(std::numeric_limits<Real>::epsilon());
  const auto check = [](double argument, long double first, long double second) {
    const Pack<Real> z = broadcast(static_cast<Real>(argument));
    // A dozen roundings of terms that are as large as the value at 0.
    CHECK(std::abs(static_cast<double>(bessel_1<Real>(z)[0]) - static_cast<double>(first)) <= 2 * ulp / 3);
    CHECK(std::abs(static_cast<double>(bessel_2<Real>(z)[0]) - static_cast<double>(second)) <= 2 * ulp / 15);
  };
  // From z = 0.3 on: closed forms in long double, whose differences have an error of 10⁻¹⁷. Below: the first
  // four terms of the series.
  for (int i = 0; i <= 2000; ++i) {
    const auto argument =
        static_cast<double>(static_cast<Real>(0.3 + (std::numbers::pi * std::numbers::pi - 0.3) * i / 2001));
    const long double z = argument, y = std::sqrt(z), sinc = std::sin(y) / y,
                      first = (sinc - std::cos(y)) / z;
    check(argument, first, (3 * first - sinc) / z);
  }
  for (const double power : {0.0, 1e-12, 1e-6, 1e-3}) {
    const auto argument = static_cast<double>(static_cast<Real>(power));
    const long double z = argument;
    check(argument, 1 / 3.0L - z / 30 + z * z / 840 - z * z * z / 45360,
          1 / 15.0L - z / 210 + z * z / 7560 - z * z * z / 498960);
  }
}

}  // namespace bendlab::pack_math_test
