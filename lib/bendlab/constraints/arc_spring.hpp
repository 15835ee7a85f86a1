// A segment that buckles: the bending spring of Choi and Ko 2002, §4.2, between two vertices a and b.
//
//       .-'''-.       The cloth between a and b does not shorten, but bends to a circular arc of length L and
//      /       \      curvature κ: r/L = sinc y, y = κL/2 in [0, π], U = ½ k_b L κ². The arc pushes a and b
//     a----r----b     apart with P = -dU/dr = k_b κ² / (sinc y - cos y). P grows from 12 k_b/L² (straight) to
//                     4π² k_b/L² (closed to a circle).
//
// Nothing resists r > L. At r = L the force jumps: P has any value up to 12 k_b/L², as the load requires.
// Choi and Ko replace the jump by a steep spring c_b, because their implicit integration needs it. change()
// needs no steep spring, because it solves for the multiplier with the jump.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "bendlab/constraints/elements.hpp"
#include "bendlab/constraints/value.hpp"

namespace bendlab {

struct ArcSpring {
  static constexpr std::string_view name = "arc_spring";
  static constexpr std::size_t arity = 2;
  static constexpr std::size_t rest_values = 1;  ///< L, m
  static constexpr bool one_sided = true;

  /// Size at rest, m: the length. A projection moves a corner by at most `largest_move` sizes.
  template <class Real>
  static Real rest_size(const std::array<Real, 1>& rest) {
    return rest[0];
  }

  enum class Law {
    exact,       ///< the arc's push
    polynomial,  ///< P = -(4 k_b/L²) p(r/L), p of degree 4: within 1.6 % of the exact push
  };
  static constexpr std::array<std::string_view, 2> law_names = {"exact", "polynomial"};

  /// The coefficients of -4 p by ascending powers of r/L. p is from Blender's implicit cloth solver
  /// (implicit_blender.c, which leaves out the factor 4/L²).
  static constexpr std::array<double, 5> polynomial = {4 * 9.713, -4 * 23.116, 4 * 39.083, -4 * 34.193,
                                                       4 * 11.541};

  /// r/L and P L²/k_b of a segment at t in [0, 1] between straight (0) and closed (1).
  struct Bent {
    double ratio, push;
  };
  static Bent bent(double t, Law law);

  /// P L²/k_b at r/L in [0, 1].
  static double push(double ratio, Law law) { return bent(bending_of(ratio, law), law).push; }

  /// C = r - L. `defined` is false if r/L is not larger than rounding errors (collapsed_ratio).
  template <class Real>
  static ConstraintValue<Real, 2> value(const std::array<Vector3Of<Real>, 2>& p,
                                        const std::array<Real, 1>& rest, Law) {
    const Vector3Of<Real> d = p[0] - p[1];
    const Real length = d.norm();
    if (!(length > collapsed_ratio<Real> * rest[0]))
      return {.value = -rest[0], .gradient = {}, .defined = false};
    return {length - rest[0], {d / length, -d / length}};
  }

  /// U / k_b at C = r - L, 1/m, and its derivatives by C.
  struct Potential {
    double energy, slope, curvature;
  };
  /// Requires C ≤ 0. At C = 0, where the force jumps, the derivatives are their limits from C < 0.
  static Potential potential(double value, const std::array<double, 1>& rest, Law law);

  /// U / k_b, 1/m, at C = r - L.
  static double energy(double value, const std::array<double, 1>& rest, Law law);

  /// Δλ of the exact solution of λ' = h² P(r') with r' = r + w Δλ, at C = r - L. At r' = L, P may have any
  /// value from 0 to the push at which a straight segment buckles. `w` is Σ w|∇C|² in 1/kg, `alpha` is 1 /
  /// (k_b h²). `multiplier` is λ ≥ 0, which pushes a and b apart. Computes in double for every Real.
  static double change(double value, const std::array<double, 1>& rest, Law law, double w, double alpha,
                       double multiplier);

 private:
  static double sinc(double y) { return y > 0 ? std::sin(y) / y : 1; }
  static double sinc_minus_cosine(double y);
  static double push_rise(double y);
  static double bending_of(double ratio, Law law);

  // The t in [0, 1], to 2⁻⁶⁰, at which `above(t)` changes from true (at 0) to false.
  template <class Above>
  static double bisected(const Above& above) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) (above((low + high) / 2) ? low : high) = (low + high) / 2;
    return (low + high) / 2;
  }
};

/// sinc y - cos y. For small y the difference would lose digits, so the function sums the power series.
inline double ArcSpring::sinc_minus_cosine(double y) {
  if (y > 0.5) return sinc(y) - std::cos(y);
  double term = y * y / 3, sum = 0;  // Σ (-1)ⁿ 2 (n + 1) y²ⁿ⁺² / (2n + 3)!
  for (int n = 1; n <= 8; ++n) sum += term, term *= -y * y * (n + 1) / (n * (2.0 * n + 2) * (2.0 * n + 3));
  return sum;
}

/// d(P L²/k_b)/dy · (sinc y - cos y)² / 4 = y (3 (sinc y - cos y) - y sin y). For small y by power series.
inline double ArcSpring::push_rise(double y) {
  if (y > 0.5) return y * (3 * sinc_minus_cosine(y) - y * std::sin(y));
  double term = y * y * y * y / 15, sum = 0;  // Σ (-1)ⁿ⁺¹ 4 n (n + 1) y²ⁿ⁺² / (2n + 3)!, n ≥ 1
  for (int n = 1; n <= 8; ++n) sum += term, term *= -y * y * (n + 2) / (n * (2.0 * n + 4) * (2.0 * n + 5));
  return y * sum;
}

inline ArcSpring::Bent ArcSpring::bent(double t, Law law) {
  if (law == Law::exact) {
    const double y = std::numbers::pi * t;
    return {sinc(y), y > 0 ? 4 * y * y / sinc_minus_cosine(y) : 12};
  }
  double push = 0;
  for (std::size_t n = polynomial.size(); n-- > 0;) push = push * (1 - t) + polynomial[n];
  return {1 - t, push};
}

/// The t at which bent() has the given ratio, by Newton's method. A bisection replaces steps out of the
/// bracket.
inline double ArcSpring::bending_of(double ratio, Law law) {
  if (!(ratio < 1)) return 0;
  if (law == Law::polynomial || ratio <= 0) return std::min(1 - ratio, 1.0);
  double low = 0, high = std::numbers::pi;
  double y = std::min(high, std::sqrt(6 * (1 - ratio) * (1 + 0.3 * (1 - ratio))));
  constexpr int most = 60;
  constexpr double rounded = 2.3e-16;  // of a ratio
  for (int i = 0; i < most; ++i) {
    const double above = sinc(y) - ratio;
    if (std::abs(above) <= rounded) break;
    (above > 0 ? low : high) = y;
    const double next = y + above * y / sinc_minus_cosine(y);
    y = next > low && next < high ? next : (low + high) / 2;
  }
  return y / std::numbers::pi;
}

inline ArcSpring::Potential ArcSpring::potential(double value, const std::array<double, 1>& rest, Law law) {
  const double length = rest[0], ratio = std::min(1.0, 1 + value / length), squared = length * length;
  if (law == Law::exact) {
    const double y = std::numbers::pi * bending_of(ratio, law);
    if (!(y > 0)) return {0, -12 / squared, 7.2 / (squared * length)};
    const double below = sinc_minus_cosine(y);
    return {2 * y * y / length, -4 * y * y / below / squared,
            4 * push_rise(y) / (below * below) * y / below / (squared * length)};
  }
  double energy = 0, push = 0, rise = 0;  // integral of the push from ratio to 1; push and slope at ratio
  for (std::size_t n = polynomial.size(); n-- > 0;) {
    rise = rise * ratio + push;
    push = push * ratio + polynomial[n];
    energy += polynomial[n] / static_cast<double>(n + 1) * (1 - std::pow(ratio, n + 1));
  }
  return {energy / length, -push / squared, -rise / (squared * length)};
}

inline double ArcSpring::energy(double value, const std::array<double, 1>& rest, Law law) {
  return value < 0 ? potential(value, rest, law).energy : 0;
}

inline double ArcSpring::change(double value, const std::array<double, 1>& rest, Law law, double w,
                                double alpha, double multiplier) {
  const double straight = multiplier - value / w;  // λ' if r' = L
  if (straight < 0) return -multiplier;            // the spring would pull: λ' = 0
  // From here on, lengths are in units of L and pushes in units of k_b/L². to_push λ is such a push.
  const double length = rest[0], to_push = alpha * length * length, yielding = to_push * length / w;
  if (to_push * straight <= bent(0, law).push) return -value / w;  // r' = L: the push stays below its limit
  // The segment buckles. With r' = r + w Δλ, push(r') = to_push λ' = to_push straight - yielding (1 - r').
  const Bent end = bent(bisected([&](double t) {
                          const Bent at = bent(t, law);
                          return to_push * straight - yielding * (1 - at.ratio) > at.push;
                        }),
                        law);
  // For accuracy, Δλ is computed from λ' for a large `yielding` and from r' otherwise. The push changes by 7
  // to 118 per unit of r'.
  return yielding > 40 ? end.push / to_push - multiplier : ((end.ratio - 1) * length - value) / w;
}

}  // namespace bendlab
