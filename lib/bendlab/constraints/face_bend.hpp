// The curvature of a triangle, from how far the sheet turns at each of its three edges.
//
//            o1                v0 v1 v2   the triangle; edge i lies opposite v_i
//           /  \               o0 o1 o2   the vertices beyond its edges
//         v2 -- v0             t_i        unit, in the triangle, from edge i towards v_i
//        /  \  /  \            h_i        height of the triangle above edge i
//      o0 -- v1 -- o2          θ_i        fold angle at edge i, positive if o_i lies on the normal's side
//
//   curvature  K = Σ c_i u_i t_i t_iᵀ (symmetric, 2 by 2, in the rest triangle), c_i constant, u_i a turn
//   energy     ½ D A ((1 - ν) |K|² + ν (tr K)²) = ½ D |U (u - u_rest)|²
//
// A is the rest area, and U a constant upper triangular matrix. Each edge may have a director, which turns
// away from the mean of the two normals. The value of a director is d, in m; b d is its angle.
//
//   tangent, sine, angle   u_i = h_i f(φ_i), φ_i = a_i θ_i + b_i d_i, f by turn.hpp; without directors: sine
//   height                 u_i = a_i times the height of o_i above the triangle's plane; without directors
//
// a_i is ½ at an edge inside the sheet, where the director may split the fold in any ratio, 1 at an edge to a
// clamped triangle, whose normal is the director, and 0 at the border of the sheet.
#pragma once

#include <Eigen/Geometry>
#include <string_view>

#include "bendlab/constraints/elements.hpp"
#include "bendlab/constraints/turn.hpp"
#include "bendlab/constraints/value.hpp"

namespace bendlab {

/// How a fold enters the curvature of a triangle without directors.
enum class FoldLaw { sine, height };
inline constexpr std::array<std::string_view, 2> fold_law_names = {"sin", "height"};

template <std::size_t director_count>
struct FaceBend {
  static_assert(director_count == 0 || director_count == 3);
  static constexpr std::string_view name = director_count > 0 ? "mid_edge" : "face";
  static constexpr std::size_t directors = director_count;  ///< its last corners are directors
  /// o0, o1, o2, then v0, v1, v2, then the directors. At the border of the sheet o_i is v_i. Kernels write
  /// the corners in this order, so what a kernel writes for v_i replaces what it wrote for o_i.
  static constexpr std::size_t arity = 6 + director_count;
  static constexpr std::size_t components = 3;  ///< of U (u - u_rest)
  static constexpr bool linear_components = false;
  /// a_0 to a_2; u_rest in m; U_00, U_01, U_02, U_11, U_12, U_22 in 1/m; a length of the triangle, m; b, 1/m.
  static constexpr std::size_t rest_values = 13 + director_count;
  static constexpr double padding = 0;  ///< rest values of lanes without a constraint

  template <class Real>
  static Real rest_size(const std::array<Real, rest_values>& rest) {
    return rest[12];
  }

  using Law = std::conditional_t<(director_count > 0), Turn, FoldLaw>;
  static constexpr auto law_names = [] {
    if constexpr (director_count > 0)
      return turn_names;
    else
      return fold_law_names;
  }();
  static constexpr bool is_height(Law law) {
    if constexpr (director_count > 0)
      return false;
    else
      return law == FoldLaw::height;
  }
  /// The measure of the turn, for a law that is not a height.
  static constexpr Turn measure(Law law) {
    if constexpr (director_count > 0)
      return law;
    else
      return Turn::sine;
  }

  template <class Real>
  using Points = std::array<Vector3Of<Real>, arity>;
  template <class Real>
  using Rest = std::array<Real, rest_values>;

  /// The turn u at an edge. v_i has the gradient `tilt` and o_i has the gradient `lift`. The ends of the edge
  /// have the opposite of both: the second end has the shares `foot` of the tilt and `foot_beyond` of the
  /// lift.
  template <class Real>
  struct EdgeTurn {
    Real value = 0, foot = 0, foot_beyond = 0, by_director = 0;
    Vector3Of<Real> tilt, lift = Vector3Of<Real>::Zero();
    bool defined = true;
  };
  template <class Real>
  static EdgeTurn<Real> edge_turn(const Points<Real>& p, const Rest<Real>& rest, Law law, std::size_t i,
                                  const Vector3Of<Real>& normal, Real twice_area);

  /// Adds `factor` times the gradient of u_i.
  template <class Real>
  static void add_gradient(std::array<Vector3Of<Real>, arity>& gradient, const EdgeTurn<Real>& turn,
                           std::size_t i, Real factor);

  /// C_k = Σ U_ki (u_i - u_rest,i): a part of the energy, ½ D C_k², with a gradient also where C_k is 0.
  template <class Real>
  static ConstraintValue<Real, arity> component(const Points<Real>& p, const Rest<Real>& rest, Law law,
                                                std::size_t k) {
    std::array<Real, components> weights{};
    weights[k] = 1;
    return weighted_components(p, rest, law, weights);
  }
  /// Σ C_k times weight k.
  template <class Real>
  static ConstraintValue<Real, arity> weighted_components(const Points<Real>& p, const Rest<Real>& rest,
                                                          Law law, const std::array<Real, 3>& weights);

  /// C = |U (u - u_rest)|, so that ½ D C² is the whole energy. The gradient of an element at rest is 0.
  template <class Real>
  static ConstraintValue<Real, arity> value(const Points<Real>& p, const Rest<Real>& rest, Law law);

  template <class Real>
  static Rest<Real> moved_rest(const Points<Real>& p, Rest<Real> rest, Law law, Real share) {
    const Turns<Real> now = all_turns<Real>(p, rest, law);
    for (std::size_t i = 0; now.defined && i < 3; ++i) rest[3 + i] += (1 - share) * now.beyond_rest[i];
    return rest;
  }

  /// The three turns at these positions, m.
  static std::array<double, 3> turns(const Points<double>& p, const Rest<double>& rest, Law law);

 private:
  template <class Real>
  struct Turns {
    std::array<EdgeTurn<Real>, 3> edge;
    std::array<Real, 3> beyond_rest;  // u - u_rest
    bool defined = false;
  };
  template <class Real>
  static Turns<Real> all_turns(const Points<Real>& p, const Rest<Real>& rest, Law law);
};

/// With directors at its edges (Grinspun et al. 2006, "Computing discrete shape operators").
using MidEdgeBend = FaceBend<3>;
/// Without directors.
using FoldBend = FaceBend<0>;

namespace detail {

/// Place of U_ki in the rest values of FaceBend, k <= i.
constexpr std::size_t upper(std::size_t k, std::size_t i) {
  return k == 0 ? 6 + i : 7 + k + i;  // U_11 at 9, U_12 at 10, U_22 at 11
}

}  // namespace detail

template <std::size_t N>
template <class Real>
typename FaceBend<N>::template EdgeTurn<Real> FaceBend<N>::edge_turn(const Points<Real>& p,
                                                                     const Rest<Real>& rest, Law law,
                                                                     std::size_t i,
                                                                     const Vector3Of<Real>& normal,
                                                                     Real twice_area) {
  const Vector3Of<Real>&start = p[3 + (i + 1) % 3], &end = p[3 + (i + 2) % 3], &top = p[3 + i];
  EdgeTurn<Real> turn;
  const Vector3Of<Real> e = end - start;
  const Real squared = e.squaredNorm(), length = std::sqrt(squared), least = collapsed_ratio<Real> * rest[12];
  if (!(length > least)) return {.tilt = {}, .defined = false};
  const Vector3Of<Real> inwards = normal.cross(e) / length;
  const Real height = twice_area / length, share = rest[i];
  turn.foot = (top - start).dot(e) / squared;
  Real angle = 0, sine = 0, cosine = 1, height_beyond = 1;
  Vector3Of<Real> normal_beyond = normal;
  if (share > 0) {
    const Vector3Of<Real> offset = p[i] - start, beyond = offset.cross(e);
    const Real twice_area_beyond = beyond.norm();
    const Real most = overgrown_square<Real> * rest[12] * rest[12];
    if (!(twice_area_beyond > least * rest[12] && offset.squaredNorm() < most))
      return {.tilt = {}, .defined = false};
    normal_beyond = beyond / twice_area_beyond;
    height_beyond = twice_area_beyond / length;
    sine = normal_beyond.dot(inwards), cosine = normal_beyond.dot(normal);
    angle = std::atan2(sine, cosine);
    turn.foot_beyond = offset.dot(e) / squared;
  }
  if (is_height(law)) {
    turn.value = share * height_beyond * sine;
    turn.tilt = share * height_beyond * cosine / height * normal;
    turn.lift = share * normal;
    return turn;
  }
  Real whole = share * angle;
  if constexpr (N > 0) whole += rest[13 + i] * p[6 + i].x();
  const TurnValue<Real> f = turn_of(measure(law), whole);
  turn.value = height * f.value;
  turn.tilt = f.value * inwards + share * f.slope * normal;
  turn.lift = share * height * f.slope / height_beyond * normal_beyond;
  if constexpr (N > 0) turn.by_director = height * f.slope * rest[13 + i];
  return turn;
}

template <std::size_t N>
template <class Real>
typename FaceBend<N>::template Turns<Real> FaceBend<N>::all_turns(const Points<Real>& p,
                                                                  const Rest<Real>& rest, Law law) {
  Turns<Real> turns;
  const Vector3Of<Real> e1 = p[4] - p[3], e2 = p[5] - p[3], n = e1.cross(e2);
  const Real twice_area = n.norm(), least = collapsed_ratio<Real> * rest[12],
             most = overgrown_square<Real> * rest[12] * rest[12];
  if (!(twice_area > least * rest[12] && e1.squaredNorm() < most && e2.squaredNorm() < most)) return turns;
  for (std::size_t i = 0; i < 3; ++i) {
    turns.edge[i] = edge_turn<Real>(p, rest, law, i, n / twice_area, twice_area);
    if (!turns.edge[i].defined) return turns;
    turns.beyond_rest[i] = turns.edge[i].value - rest[3 + i];
  }
  turns.defined = true;
  return turns;
}

template <std::size_t N>
template <class Real>
void FaceBend<N>::add_gradient(std::array<Vector3Of<Real>, arity>& gradient, const EdgeTurn<Real>& turn,
                               std::size_t i, Real factor) {
  const Vector3Of<Real> tilt = factor * turn.tilt, lift = factor * turn.lift;
  gradient[i] += lift, gradient[3 + i] += tilt;
  gradient[3 + (i + 1) % 3] -= (1 - turn.foot) * tilt + (1 - turn.foot_beyond) * lift;
  gradient[3 + (i + 2) % 3] -= turn.foot * tilt + turn.foot_beyond * lift;
  if constexpr (N > 0) gradient[6 + i].x() += factor * turn.by_director;
}

template <std::size_t N>
template <class Real>
ConstraintValue<Real, FaceBend<N>::arity> FaceBend<N>::weighted_components(
    const Points<Real>& p, const Rest<Real>& rest, Law law, const std::array<Real, 3>& weights) {
  const Turns<Real> turns = all_turns<Real>(p, rest, law);
  ConstraintValue<Real, arity> c;
  for (Vector3Of<Real>& gradient : c.gradient) gradient.setZero();
  c.defined = turns.defined;
  for (std::size_t i = 0; turns.defined && i < 3; ++i) {
    Real factor = 0;
    for (std::size_t k = 0; k <= i; ++k) factor += weights[k] * rest[detail::upper(k, i)];
    c.value += factor * turns.beyond_rest[i];
    add_gradient<Real>(c.gradient, turns.edge[i], i, factor);
  }
  return c;
}

template <std::size_t N>
template <class Real>
ConstraintValue<Real, FaceBend<N>::arity> FaceBend<N>::value(const Points<Real>& p, const Rest<Real>& rest,
                                                             Law law) {
  const Turns<Real> turns = all_turns<Real>(p, rest, law);
  ConstraintValue<Real, arity> c;
  for (Vector3Of<Real>& gradient : c.gradient) gradient.setZero();
  c.defined = turns.defined;
  if (!turns.defined) return c;
  std::array<Real, 3> part{}, by_turn{};  // U (u - u_rest); the derivatives of C by u
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = k; i < 3; ++i) part[k] += rest[detail::upper(k, i)] * turns.beyond_rest[i];
  c.value = std::sqrt(part[0] * part[0] + part[1] * part[1] + part[2] * part[2]);
  if (!(c.value > collapsed_ratio<Real>)) {
    c.value = 0;
    return c;
  }
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = k; i < 3; ++i) by_turn[i] += rest[detail::upper(k, i)] * part[k] / c.value;
  for (std::size_t i = 0; i < 3; ++i) add_gradient<Real>(c.gradient, turns.edge[i], i, by_turn[i]);
  return c;
}

template <std::size_t N>
std::array<double, 3> FaceBend<N>::turns(const Points<double>& p, const Rest<double>& rest, Law law) {
  const Turns<double> all = all_turns<double>(p, rest, law);
  return {all.edge[0].value, all.edge[1].value, all.edge[2].value};
}

}  // namespace bendlab
