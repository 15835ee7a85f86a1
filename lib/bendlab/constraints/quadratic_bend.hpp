// Curvature as a linear combination of N vertices, Kx = Σ K_i p_i with Σ K_i = 0, where the K_i follow from
// cotangents in the rest shape. Kx = 0 in every flat state.
//
//   QuadraticBend, N = 4    at an edge that two triangles share (Bergou et al. 2006). If the triangles keep
//                           their shape, |Kx| = 2 |e| sin(θ/2), where e is the edge and θ the fold angle
//   LaplacianBend, N = 13   at a vertex, from its ring (Wardetzky et al. 2007)
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>

#include "bendlab/constraints/elements.hpp"
#include "bendlab/constraints/value.hpp"

namespace bendlab {

template <std::size_t N>
struct VertexSum {
  static constexpr std::string_view name = N == 4 ? "quadratic" : "laplacian";
  /// N = 4: p0, p1 of the shared edge, then the vertices opposite it. N = 13: the ring, then the vertex. If
  /// the ring has fewer than 12 vertices, the list starts with copies of the vertex, whose K_i are 0. Kernels
  /// write corners in this order, so the last copy decides.
  static constexpr std::size_t arity = N;
  /// K_0 … K_N-1, |Kx| of the rest shape in m, a length of the rest shape in m.
  static constexpr std::size_t rest_values = N + 2;

  /// Size at rest, m. A projection moves a corner by at most `largest_move` sizes.
  template <class Real>
  static Real rest_size(const std::array<Real, N + 2>& rest) {
    return rest[N + 1];
  }

  /// d|Kx|/dθ in the rest shape, m. |Kx| is 2 |e| sin(θ/2), so the slope is |e| cos(θ/2).
  static double slope_at_rest(const std::array<double, N + 2>& rest) requires(N == 4) {
    const double edge = rest[5], sine = rest[4] / (2 * edge);
    return edge * std::sqrt(std::max(0.0, 1 - sine * sine));
  }

  using IsSumOfVertices = void;

  enum class Law {
    norm,    ///< C = |Kx| - |Kx|_rest, ∇_i C = K_i Kx / |Kx|: ½C² is Bergou's energy, moment ∝ sin θ
    energy,  ///< C = ½|Kx|² - ½|Kx|²_rest, ∇_i C = K_i Kx, as libraries ship it: ½C² is quartic
  };
  /// LaplacianBend has only the law `norm`.
  static constexpr auto law_names = [] {
    constexpr std::array<std::string_view, 2> all = {"norm", "energy"};
    if constexpr (N == 4)
      return all;
    else
      return std::array{all[0]};
  }();

  /// With a flat rest shape ½ |Kx|² is the sum of the squares of three linear functions. C = |Kx| has no
  /// second derivative at 0, that is in flat parts of a sheet.
  static constexpr std::size_t components = 3;
  static constexpr bool linear_components = true;
  static bool is_sum_of_squares(const std::array<double, N + 2>& rest, Law law) {
    return law == Law::norm && rest[N] <= 1e-9 * rest[N + 1];
  }
  static ConstraintValue<double, N> component(const std::array<Vector3Of<double>, N>& p,
                                              const std::array<double, N + 2>& rest, Law, std::size_t axis) {
    ConstraintValue<double, N> c;
    for (std::size_t i = 0; i < N; ++i) {
      c.value += rest[i] * p[i](static_cast<Eigen::Index>(axis));
      c.gradient[i] = rest[i] * Vector3Of<double>::Unit(static_cast<Eigen::Index>(axis));
    }
    return c;
  }

  template <class Real>
  static ConstraintValue<Real, N> value(const std::array<Vector3Of<Real>, N>& p,
                                        const std::array<Real, N + 2>& rest, Law law) {
    const Real norm_at_rest = rest[N], size = rest[N + 1];
    Vector3Of<Real> kx = rest[1] * (p[1] - p[0]);  // Σ K_i = 0
    for (std::size_t i = 2; i < N; ++i) kx += rest[i] * (p[i] - p[0]);
    const Real norm = kx.norm();
    if (!(norm > collapsed_ratio<Real> * size))
      return {.value = law == Law::norm ? -norm_at_rest : -norm_at_rest * norm_at_rest / 2,
              .gradient = {},
              .defined = false};
    if (!(norm * norm < overgrown_square<Real> * size * size)) return {.gradient = {}, .defined = false};
    const Vector3Of<Real> by_kx = law == Law::norm ? Vector3Of<Real>(kx / norm) : kx;  // ∂C/∂(Kx)
    ConstraintValue<Real, N> c;
    c.value = law == Law::norm ? norm - norm_at_rest : (norm * norm - norm_at_rest * norm_at_rest) / 2;
    for (std::size_t i = 0; i < N; ++i) c.gradient[i] = rest[i] * by_kx;
    return c;
  }
};

using QuadraticBend = VertexSum<4>;
using LaplacianBend = VertexSum<13>;

}  // namespace bendlab
