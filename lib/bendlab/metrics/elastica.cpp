#include "bendlab/metrics/elastica.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

// The strip is integrated from the free end to the clamp. t = L - s is the length from the free end, and
// φ = π/2 - θ the angle to the vertical, in units where ρ g / C = 1:
//
//   φ' = κ(m),   m' = t sin φ,   m(0) = 0.   φ = π/2 is reached at the clamp, where t = L;   Γ = L^(p+2)
//
// So each angle φ(0) at the free end gives a point of the curve, without a shooting method. Even a nearly
// vertical end (φ(0) = 10⁻³⁰) is accurate, because φ is small there. With the cubic law, the end of a soft
// strip hangs exactly straight (φ = 0) over a length t₀, because a small curvature costs no energy to first
// order. For such strips t₀ is given instead of φ(0).

namespace bendlab {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;

double curvature(BendingLaw law, double moment) {
  return law == BendingLaw::linear ? moment : std::cbrt(moment);
}

// The state at a point of the strip: t, φ, m, and the reach and drop from this point to the free end.
enum Quantity { length, angle, moment, reach, drop };
using State = std::array<double, 5>;

State derivative(BendingLaw law, const State& y, double length_rate) {
  return {length_rate, curvature(law, y[moment]) * length_rate, y[length] * std::sin(y[angle]) * length_rate,
          std::sin(y[angle]) * length_rate, std::cos(y[angle]) * length_rate};
}

// One step of the classical Runge-Kutta method, in any variable v. `length_rate(v, state)` is dt/dv.
template <class LengthRate>
State runge_kutta(BendingLaw law, const State& y, double variable, double step, LengthRate length_rate) {
  const auto slope = [&](double part, const State& from) {
    State at = y;
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += part * step * from[i];
    return derivative(law, at, length_rate(variable + part * step, at));
  };
  const State k1 = slope(0, State{}), k2 = slope(0.5, k1), k3 = slope(0.5, k2), k4 = slope(1, k3);
  State next = y;
  for (std::size_t i = 0; i < next.size(); ++i) next[i] += step / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  return next;
}

// The free end: its angle to the vertical, or the straight length t₀. free_end() computes either of them from
// a number x; a smaller x means a softer strip.
struct FreeEnd {
  double angle = 0, straight = 0;
};
FreeEnd free_end(BendingLaw law, double x) {
  if (law == BendingLaw::linear) return {.angle = std::exp(x)};
  return x > 0 ? FreeEnd{.angle = x} : FreeEnd{.straight = -x};
}
double largest_x(BendingLaw law) {
  return law == BendingLaw::linear ? std::log(quarter_turn) : quarter_turn;
}

// The state where the integration starts. With a straight length t₀, that is a little beyond t₀, where the
// cubic law has the series φ = √(t₀/24) τ² (1 + τ / 5t₀) in τ = t - t₀.
State start(const FreeEnd& end) {
  if (end.straight == 0) return {0, end.angle, 0, 0, 0};
  const double tau = 1e-3 * std::min(1.0, end.straight), next = tau / end.straight;
  const double phi = std::sqrt(end.straight / 24) * tau * tau;
  const double slope = 2 * phi / tau * (1 + 0.3 * next);
  return {end.straight + tau, phi * (1 + 0.2 * next), slope * slope * slope, phi * tau / 3,
          end.straight + tau};
}

// The length of a strip whose free end slopes by the small angle θ.
double short_length(BendingLaw law, double theta) {
  return law == BendingLaw::linear ? std::cbrt(6 * theta) : std::pow(std::cbrt(2.0) * 5 / 3 * theta, 3.0 / 5);
}

HangingStrip integrated(BendingLaw law, const FreeEnd& end) {
  // With the cubic law, the solution is a smooth function of u = ∛τ, but not of t (it contains τ^(5/3)).
  const int power = law == BendingLaw::linear ? 1 : 3;
  const double estimated_length = std::min(1.0, short_length(law, quarter_turn - end.angle));
  constexpr double fineness = 0.01;  // error in Γ: 10⁻⁹ (linear), 10⁻⁷ (cubic); of fourth order
  const double largest_step =
      fineness * (law == BendingLaw::linear ? estimated_length : std::cbrt(estimated_length));
  const auto rate_of_u = [&](double u, const State&) { return power == 1 ? 1 : 3 * u * u; };
  State y = start(end);
  double u = power == 1 ? y[length] : std::cbrt(y[length] - end.straight);
  for (;;) {
    const double step = largest_step / std::sqrt(1 + y[length]);
    const State next = runge_kutta(law, y, u, step, rate_of_u);
    if (next[angle] >= quarter_turn) break;
    y = next;
    u += step;
  }
  // The last step uses φ as its variable. φ is known at the clamp, so the step ends exactly at the clamp
  // (Hénon 1982).
  const auto rate_of_angle = [&](double, const State& at) { return 1 / curvature(law, at[moment]); };
  y = runge_kutta(law, y, y[angle], quarter_turn - y[angle], rate_of_angle);
  const double l = y[length];
  return {.gamma = law == BendingLaw::linear ? l * l * l : l * l * l * l * l,
          .drop = y[drop] / l,
          .reach = y[reach] / l};
}

}  // namespace

HangingStrip hanging_strip(BendingLaw law, double height_over_width) {
  if (std::isnan(height_over_width) || height_over_width < 1e-6 || height_over_width > 500)
    throw std::invalid_argument(
        fmt::format("hanging strip: H/W = {} is outside the range 0.000001 to 500; use a longer or a shorter "
                    "strip",
                    height_over_width));
  const auto at = [&](double x) { return integrated(law, free_end(law, x)); };
  const auto too_soft = [&](double x) {
    const HangingStrip strip = at(x);
    return strip.drop > height_over_width * strip.reach;
  };
  double stiffer = largest_x(law), softer = -1;
  while (!too_soft(softer)) softer *= 2;
  for (int halving = 0; halving < 64; ++halving) {  // until x is exact to the last digit
    const double middle = 0.5 * (softer + stiffer);
    (too_soft(middle) ? softer : stiffer) = middle;
  }
  return at(softer);
}

double amplification(BendingLaw law, double height_over_width) {
  constexpr double step = 1e-3;  // of ln(H/W); the error is of second order
  const double low = std::max(height_over_width * std::exp(-step), 1e-6),
               high = std::min(height_over_width * std::exp(step), 500.0);
  return std::log(hanging_strip(law, high).gamma / hanging_strip(law, low).gamma) / std::log(high / low);
}

}  // namespace bendlab
