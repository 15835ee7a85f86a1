// Three measures of an angle by which a sheet turns. All three agree for small angles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace bendlab {

enum class Turn {
  tangent,  ///< tan φ; grows without bound as a fold closes
  sine,     ///< sin φ
  angle,    ///< φ
};
inline constexpr std::array<std::string_view, 3> turn_names = {"tan", "sin", "theta"};

/// Beyond this angle, in rad (80 degrees), `tangent` goes on along a straight line, so that a step that
/// overshoots meets no pole. Beyond a right angle, `sine` stays 1.
template <class Real>
inline constexpr Real steepest_turn = Real(1.4);

/// The measure of an angle, and its derivative.
template <class Real>
struct TurnValue {
  Real value, slope;
};

template <class Real>
TurnValue<Real> turn_of(Turn measure, Real angle) {
  switch (measure) {
    case Turn::tangent: {
      const Real within = std::clamp(angle, -steepest_turn<Real>, steepest_turn<Real>);
      const Real tangent = std::tan(within), slope = 1 + tangent * tangent;
      return {tangent + (angle - within) * slope, slope};
    }
    case Turn::sine: {
      constexpr Real right = std::numbers::pi_v<Real> / 2;
      if (std::abs(angle) >= right) return {std::copysign(Real(1), angle), 0};
      return {std::sin(angle), std::cos(angle)};
    }
    case Turn::angle:
      break;
  }
  return {angle, 1};
}

}  // namespace bendlab
