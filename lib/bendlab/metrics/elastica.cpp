#include "bendlab/metrics/elastica.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

// Integrated from the free end, t = L - s, with φ = π/2 - θ, the angle to the vertical:
//
//   φ' = κ(m),   m' = t sin φ,   m(0) = 0,   until φ = π/2, the clamp, at t = L;   Γ = L^(p+2)
//
// in units where ρ g / C = 1. So each angle φ(0) at the free end gives a point of the curve without a
// shooting method, and a nearly vertical end (φ(0) = 10⁻³⁰) keeps its digits. With the cubic law the end of a
// soft strip hangs exactly straight (φ = 0) up to a length t₀, because a small curvature costs no energy to
// first order. Then t₀ replaces φ(0) as the given value.

namespace bendlab {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;

double curvature(BendingLaw law, double moment) {
  return law == BendingLaw::linear ? moment : std::cbrt(moment);
}

// t, φ, m, and the reach and drop of the part between here and the free end.
enum Quantity { length, angle, moment, reach, drop };
using State = std::array<double, 5>;

State derivative(BendingLaw law, const State& y, double length_rate) {
  return {length_rate, curvature(law, y[moment]) * length_rate, y[length] * std::sin(y[angle]) * length_rate,
          std::sin(y[angle]) * length_rate, std::cos(y[angle]) * length_rate};
}

// One step of the classical Runge-Kutta method over `step` of a variable. `length_rate(variable, state)` is
// dt / d variable.
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

// The free end: its angle to the vertical, or the length that hangs straight. Both follow from one number x:
// the smaller x, the softer the strip.
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

// The state where the integration starts. Beyond a straight length t₀ the cubic law has the series
// φ = √(t₀/24) τ² (1 + τ / 5t₀) in τ = t - t₀.
State start(const FreeEnd& end) {
  if (end.straight == 0) return {0, end.angle, 0, 0, 0};
  const double tau = 1e-3 * std::min(1.0, end.straight), next = tau / end.straight;
  const double phi = std::sqrt(end.straight / 24) * tau * tau;
  const double slope = 2 * phi / tau * (1 + 0.3 * next);
  return {end.straight + tau, phi * (1 + 0.2 * next), slope * slope * slope, phi * tau / 3,
          end.straight + tau};
}

// The length of a strip whose free end has the small deflection θ.
double short_length(BendingLaw law, double theta) {
  return law == BendingLaw::linear ? std::cbrt(6 * theta) : std::pow(std::cbrt(2.0) * 5 / 3 * theta, 3.0 / 5);
}

HangingStrip integrated(BendingLaw law, const FreeEnd& end) {
  // The cubic law's solution is smooth in u = ∛τ; in t it behaves like τ^(5/3).
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
  // The variable of the last step is φ. Its value at the clamp is known, so the step ends exactly there
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
        fmt::format("hanging strip: H/W = {} is outside 0.000001 to 500; take a longer or a shorter strip",
                    height_over_width));
  const auto at = [&](double x) { return integrated(law, free_end(law, x)); };
  const auto too_soft = [&](double x) {
    const HangingStrip strip = at(x);
    return strip.drop > height_over_width * strip.reach;
  };
  double stiffer = largest_x(law), softer = -1;
  while (!too_soft(softer)) softer *= 2;
  for (int halving = 0; halving < 64; ++halving) {  // to the last digit of x
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
