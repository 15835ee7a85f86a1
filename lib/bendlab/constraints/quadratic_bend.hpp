// Curvature at an edge that two triangles share, as a fixed linear combination of the four vertices
// (Bergou et al. 2006): Kx = Σ K_i p_i with the cotangents of the rest shape. K annihilates every flat state,
// and |Kx| = 2 |e| sin(θ/2) when the triangles keep their shape.
#pragma once

#include <string_view>

#include "bendlab/constraints/elements.hpp"
#include "bendlab/constraints/value.hpp"

namespace bendlab {

struct QuadraticBend {
  static constexpr std::string_view name = "quadratic";
  static constexpr std::size_t arity = 4;  ///< p0, p1 of the shared edge, then the vertices opposite it
  /// K_0 … K_3, |Kx| of the rest shape in m, rest length of the edge in m.
  static constexpr std::size_t rest_values = 6;

  /// m, see largest_move.
  template <class Real>
  static Real rest_size(const std::array<Real, 6>& rest) {
    return rest[5];
  }

  enum class Law {
    norm,    ///< C = |Kx| - |Kx|_rest: ½C² is Bergou's energy, moment ∝ sin θ
    energy,  ///< C = ½|Kx|² - ½|Kx|²_rest, as libraries ship it: ½C² is quartic
  };
  static constexpr std::array<std::string_view, 2> law_names = {"norm", "energy"};

  template <class Real>
  static ConstraintValue<Real, 4> value(const std::array<Vector3Of<Real>, 4>& p,
                                        const std::array<Real, 6>& rest, Law law) {
    const Vector3Of<Real> bend = rest[1] * (p[1] - p[0]) + rest[2] * (p[2] - p[0]) + rest[3] * (p[3] - p[0]);
    const Real norm = bend.norm();
    if (!(norm > collapsed_ratio<Real> * rest[5]))
      return {
          .value = law == Law::norm ? -rest[4] : -rest[4] * rest[4] / 2, .gradient = {}, .defined = false};
    if (!(norm * norm < overgrown_square<Real> * rest[5] * rest[5]))
      return {.gradient = {}, .defined = false};
    const Vector3Of<Real> direction = law == Law::norm ? Vector3Of<Real>(bend / norm) : bend;
    const Real value = law == Law::norm ? norm - rest[4] : (norm * norm - rest[4] * rest[4]) / 2;
    return {value, {rest[0] * direction, rest[1] * direction, rest[2] * direction, rest[3] * direction}};
  }
};

}  // namespace bendlab
