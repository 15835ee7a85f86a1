// The fold angle at an edge that two triangles share.
//
//          p2
//         /  \        θ = atan2((n1 × n2)·e, n1·n2) in (-π, π]; 0 if flat. The sign shows the side.
//       p0 -- p1      n1 and n2 are the unit normals, e is the direction from p0 to p1.
//         \  /
//          p3
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>

#include "bendlab/constraints/elements.hpp"
#include "bendlab/constraints/turn.hpp"
#include "bendlab/constraints/value.hpp"

namespace bendlab {

struct HingeAngle {
  static constexpr std::string_view name = "hinge";
  static constexpr std::size_t arity = 4;  ///< p0, p1 of the shared edge, then the vertices opposite it
  /// Rest angle θ0, inverse rest length of the edge in 1/m, sin(θ0/2), cos(θ0/2).
  static constexpr std::size_t rest_values = 4;

  /// Size at rest, m: the length of the edge. A projection moves a corner by at most `largest_move` sizes.
  template <class Real>
  static Real rest_size(const std::array<Real, 4>& rest) {
    return 1 / rest[1];
  }

  enum class Law {
    angle,      ///< C = θ - θ0, wrapped into (-π, π] (Müller et al. 2007, §3.3, with a sign)
    half_sine,  ///< ½C² = V, dV/dθ = sin(θ/2) - sin(θ0/2) (the elastic force of Bridson et al. 2003, §4)
    tangent,    ///< C = 2 tan(θ/2) - 2 tan(θ0/2), by turn.hpp
    sine,       ///< C = 2 sin(θ/2) - 2 sin(θ0/2)
  };
  static constexpr std::array<std::string_view, 4> law_names = {"angle", "half_sine", "tan", "sin"};

  template <class Real>
  static ConstraintValue<Real, 4> value(const std::array<Vector3Of<Real>, 4>& p,
                                        const std::array<Real, 4>& rest, Law law);

  /// dC/dθ in the rest shape.
  static double slope_at_rest(const std::array<double, 4>& rest, Law law) {
    switch (law) {
      case Law::angle:
        return 1;
      case Law::half_sine:
        return std::sqrt(rest[3] / 2);
      case Law::tangent:
        return turn_of(Turn::tangent, rest[0] / 2).slope;
      case Law::sine:
        return turn_of(Turn::sine, rest[0] / 2).slope;
    }
    throw std::logic_error("slope_at_rest: unknown law");
  }

  /// Only for the law `angle`.
  template <class Real>
  static std::array<Real, 4> moved_rest(const std::array<Vector3Of<Real>, 4>& p, std::array<Real, 4> rest,
                                        Law law, Real share) {
    const ConstraintValue<Real, 4> c = value(p, rest, law);
    if (!c.defined) return rest;
    rest[0] += (1 - share) * c.value;
    rest[2] = std::sin(rest[0] / 2), rest[3] = std::cos(rest[0] / 2);
    return rest;
  }
};

/// θ and ∇θ (Bridson et al. 2003, the modes u_i with the sign reversed: ∇θ = -u_i). `defined` is false if the
/// edge or a triangle's height is not larger than rounding errors of the edge's rest length. A collapsed
/// triangle is opened by its strain constraint.
template <class Real>
ConstraintValue<Real, 4> hinge_angle(const std::array<Vector3Of<Real>, 4>& p, Real per_rest_edge) {
  const Vector3Of<Real> e = (p[1] - p[0]) * per_rest_edge;
  const Vector3Of<Real> a = (p[2] - p[0]) * per_rest_edge, b = (p[2] - p[1]) * per_rest_edge,
                        c = (p[3] - p[1]) * per_rest_edge, d = (p[3] - p[0]) * per_rest_edge;
  const Vector3Of<Real> n1 = a.cross(b), n2 = c.cross(d);
  const Real length = e.norm(), s1 = n1.squaredNorm(), s2 = n2.squaredNorm();
  const Real least = collapsed_ratio<Real>;
  if (!(length > least && s1 > least * least && s2 > least * least &&
        s1 * s2 < overgrown_square<Real> * overgrown_square<Real>))
    return {.gradient = {}, .defined = false};
  const Vector3Of<Real> u1 = n1 / s1 * per_rest_edge, u2 = n2 / s2 * per_rest_edge;
  return {std::atan2(n1.cross(n2).dot(e) / length, n1.dot(n2)),
          {-b.dot(e) / length * u1 - c.dot(e) / length * u2, a.dot(e) / length * u1 + d.dot(e) / length * u2,
           -length * u1, -length * u2}};
}

template <class Real>
ConstraintValue<Real, 4> HingeAngle::value(const std::array<Vector3Of<Real>, 4>& p,
                                           const std::array<Real, 4>& rest, Law law) {
  ConstraintValue<Real, 4> c = hinge_angle(p, rest[1]);
  if (!c.defined) return c;
  if (law == Law::tangent || law == Law::sine) {
    const Turn measure = law == Law::tangent ? Turn::tangent : Turn::sine;
    const TurnValue<Real> now = turn_of(measure, c.value / 2);
    c.value = 2 * (now.value - turn_of(measure, rest[0] / 2).value);
    for (Vector3Of<Real>& gradient : c.gradient) gradient *= now.slope;
    return c;
  }
  constexpr Real pi = std::numbers::pi_v<Real>;
  Real change = c.value - rest[0];
  if (law == Law::angle) {
    if (change > pi) change -= 2 * pi;
    if (change < -pi) change += 2 * pi;
    c.value = change;
    return c;
  }
  // With δ = (θ - θ0)/2: V = 2 sin(θ0/2) (sin δ - δ) + 4 cos(θ0/2) sin²(δ/2).
  const Real delta = change / 2, sine = std::sin(delta / 2), cosine = std::cos(delta / 2);
  Real slope;
  const Real twice_energy = 4 * rest[2] * (2 * sine * cosine - delta) + 8 * rest[3] * sine * sine;
  if (std::abs(delta) < std::sqrt(std::numeric_limits<Real>::epsilon()) || twice_energy <= 0) {
    c.value = delta * std::sqrt(2 * rest[3]);
    slope = std::sqrt(rest[3] / 2);
  } else {
    c.value = std::copysign(std::sqrt(twice_energy), delta);
    slope = 2 * (rest[3] * cosine - rest[2] * sine) * sine / c.value;
  }
  for (Vector3Of<Real>& gradient : c.gradient) gradient *= slope;
  return c;
}

}  // namespace bendlab
