// Curvature at an edge that two triangles share, as a linear combination of the four corners (Bergou et al.
// 2006): Kx = Σ K_i p_i, where the K_i follow from cotangents in the rest shape. Kx = 0 in every flat state.
// If the triangles keep their shape, |Kx| = 2 |e| sin(θ/2), where e is the edge and θ the fold angle.
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

  /// Size at rest, m: the length of the edge. A projection moves a corner by at most `largest_move` sizes.
  template <class Real>
  static Real rest_size(const std::array<Real, 6>& rest) {
    return rest[5];
  }

  enum class Law {
    norm,    ///< C = |Kx| - |Kx|_rest, ∇_i C = K_i Kx / |Kx|: ½C² is Bergou's energy, moment ∝ sin θ
    energy,  ///< C = ½|Kx|² - ½|Kx|²_rest, ∇_i C = K_i Kx, as libraries ship it: ½C² is quartic
  };
  static constexpr std::array<std::string_view, 2> law_names = {"norm", "energy"};

  template <class Real>
  static ConstraintValue<Real, 4> value(const std::array<Vector3Of<Real>, 4>& p,
                                        const std::array<Real, 6>& rest, Law law) {
    const auto& [k0, k1, k2, k3, norm_at_rest, edge] = rest;
    const Vector3Of<Real> kx = k1 * (p[1] - p[0]) + k2 * (p[2] - p[0]) + k3 * (p[3] - p[0]);  // Σ K_i = 0
    const Real norm = kx.norm();
    if (!(norm > collapsed_ratio<Real> * edge))
      return {.value = law == Law::norm ? -norm_at_rest : -norm_at_rest * norm_at_rest / 2,
              .gradient = {},
              .defined = false};
    if (!(norm * norm < overgrown_square<Real> * edge * edge)) return {.gradient = {}, .defined = false};
    const Vector3Of<Real> by_kx = law == Law::norm ? Vector3Of<Real>(kx / norm) : kx;  // ∂C/∂(Kx)
    const Real value =
        law == Law::norm ? norm - norm_at_rest : (norm * norm - norm_at_rest * norm_at_rest) / 2;
    return {value, {k0 * by_kx, k1 * by_kx, k2 * by_kx, k3 * by_kx}};
  }
};

}  // namespace bendlab
