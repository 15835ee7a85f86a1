// The oracle: the value and gradient of one constraint at a time, with Eigen 3-vectors, in the papers'
// symbols. The kernels must agree with the oracle to rounding. With the solver's order `mesh` the oracle
// projects constraints.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "bendlab/constraints/elements.hpp"
#include "bendlab/constraints/value.hpp"

namespace bendlab {

/// A corner of a constraint. If places are split (point.hpp), relative to the base of the first corner.
template <class Real>
struct Corner {
  Vector3Of<Real> base;
  Point<Real>* moved;
  Real w;

  Vector3Of<Real> vector() const { return base + moved->vector(); }
  void move(const Vector3Of<Real>& way) { moved->set(moved->vector() + way); }
};

/// The corners at these offsets. The last `directors` corners are directors (directors.hpp), which are
/// relative to nothing.
template <class Real, std::size_t N>
std::array<Corner<Real>, N> corners_at(const Places<Real>& places, const std::array<int, N>& offsets,
                                       std::size_t directors = 0) {
  std::array<Corner<Real>, N> corners;
  for (std::size_t i = 0; i < N; ++i) {
    Point<Real>& moved = point_at(places.moved, offsets[i]);
    corners[i] = {Vector3Of<Real>::Zero(), &moved, moved.w};
    if (places.base == nullptr) continue;
    const Point<Real>& base = point_at(places.base, offsets[i]);
    corners[i].base = base.vector(), corners[i].w = base.w;
    if (i < N - directors) corners[i].base -= point_at(places.base, offsets[0]).vector();
  }
  return corners;
}
template <class Real, class... Offsets>
std::array<Corner<Real>, 1 + sizeof...(Offsets)> corners_at(const Places<Real>& places, int first,
                                                            Offsets... other_offsets) {
  return corners_at(places, std::array<int, 1 + sizeof...(Offsets)>{first, other_offsets...});
}

/// C = |p_a - p_b| - rest_length, ∇_a C = n, ∇_b C = -n (Müller et al. 2007, §3.2).
template <class Real>
ConstraintValue<Real, 2> distance_constraint(const std::array<Vector3Of<Real>, 2>& p, Real rest_length) {
  const Vector3Of<Real> d = p[0] - p[1];
  const Real length = d.norm();
  if (!(length > collapsed_ratio<Real> * rest_length))
    return {.value = -rest_length, .gradient = {}, .defined = false};
  const Vector3Of<Real> n = d / length;
  return {length - rest_length, {n, -n}};
}

/// Columns f1, f2 of the deformation gradient F = P Q⁻¹ (3 by 2); `q` is Q⁻¹ row by row.
template <class Real>
std::array<Vector3Of<Real>, 2> deformation_gradient(const std::array<Vector3Of<Real>, 3>& p,
                                                    const std::array<Real, 4>& q) {
  const Vector3Of<Real> e1 = p[1] - p[0], e2 = p[2] - p[0];
  return {e1 * q[0] + e2 * q[2], e1 * q[1] + e2 * q[3]};
}

/// The longest distance between two corners that are no directors, or `at_rest` if `at_rest` is longer, m.
template <class Real, std::size_t N>
Real size_of(const std::array<Vector3Of<Real>, N>& p, Real at_rest, std::size_t directors = 0) {
  Real size = at_rest;
  for (std::size_t i = 0; i < N - directors; ++i)
    for (std::size_t j = i + 1; j < N - directors; ++j) size = std::max(size, (p[j] - p[i]).norm());
  return size;
}

/// size_of() for a triangle. The size at rest is exact for two equal sides at a right angle, otherwise too
/// small.
template <class Real>
Real size_of_triangle(const std::array<Vector3Of<Real>, 3>& p, const std::array<Real, 4>& q) {
  return size_of(p, std::sqrt(2 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])));
}

namespace detail {
template <class Real>
std::array<Vector3Of<Real>, 3> corner_gradients(const Vector3Of<Real>& of_b, const Vector3Of<Real>& of_c) {
  return {-of_b - of_c, of_b, of_c};
}
}  // namespace detail

/// Stretch along material axis `i` (0 warp, 1 weft), f = f_i, S_ii = |f|²:
///
///   normalised, angle   C = √S_ii - 1   ∂C/∂f = f / |f|   (SBD 2014, eq. 14)
///   green, stvk         C = S_ii - 1    ∂C/∂f = 2 f       (eq. 9)
///
/// The corners b and c have the gradients q[i] ∂C/∂f and q[2 + i] ∂C/∂f; ∇_a C = -∇_b C - ∇_c C.
template <class Real>
ConstraintValue<Real, 3> stretch_constraint(const std::array<Vector3Of<Real>, 3>& p,
                                            const std::array<Real, 4>& q, int i, StrainForm form) {
  const auto column = static_cast<std::size_t>(i);
  const Vector3Of<Real> f = deformation_gradient(p, q)[column];
  const Real length = f.norm();
  if (!(length > collapsed_ratio<Real>)) return {.value = -1, .gradient = {}, .defined = false};
  if (!(length * length < overgrown_square<Real>)) return {.gradient = {}, .defined = false};
  const bool normalised = !is_green(form);
  const Vector3Of<Real> by_f = normalised ? Vector3Of<Real>(f / length) : Vector3Of<Real>(2 * f);  // ∂C/∂f
  return {normalised ? length - 1 : length * length - 1,
          detail::corner_gradients<Real>(q[column] * by_f, q[2 + column] * by_f)};
}

/// Shear, with n_i = f_i / |f_i| and φ the angle between warp and weft:
///
///   green, stvk  C = S_12 = f1·f2         ∂C/∂f1 = a1 = f2                              (SBD 2014, eq. 10)
///   normalised   C = cos φ = n1·n2        ∂C/∂f1 = a1 = (n2 - cos φ n1) / |f1|          (eq. 15)
///   angle        C = asin cos φ           ∂C/∂f1 = a1 = (n2 - cos φ n1) / (|f1| sin φ)  (not from a paper)
///
/// a2 = ∂C/∂f2 follows from a1 by exchanging f1 and f2. The corners b and c have the gradients q[0] a1 + q[1]
/// a2 and q[2] a1 + q[3] a2; ∇_a C = -∇_b C - ∇_c C.
template <class Real>
ConstraintValue<Real, 3> shear_constraint(const std::array<Vector3Of<Real>, 3>& p,
                                          const std::array<Real, 4>& q, StrainForm form) {
  const auto [f1, f2] = deformation_gradient(p, q);
  if (is_green(form)) {
    const Real trace = f1.squaredNorm() + f2.squaredNorm();  // S_11 + S_22
    if (!(trace > collapsed_ratio<Real> * collapsed_ratio<Real> && trace < overgrown_square<Real>))
      return {.gradient = {}, .defined = false};
    const Real product = f1.squaredNorm() * f2.squaredNorm();  // S_11 S_22
    if (!(f1.cross(f2).squaredNorm() > parallel_sine_squared<Real> * product || product > open_product<Real>))
      return {.value = f1.dot(f2), .gradient = {}, .defined = false};
    return {f1.dot(f2), detail::corner_gradients<Real>(q[0] * f2 + q[1] * f1, q[2] * f2 + q[3] * f1)};
  }
  const Real l1 = f1.norm(), l2 = f2.norm();
  if (!(l1 > collapsed_ratio<Real> && l2 > collapsed_ratio<Real> && l1 * l1 < overgrown_square<Real> &&
        l2 * l2 < overgrown_square<Real>))
    return {.gradient = {}, .defined = false};
  const Vector3Of<Real> n1 = f1 / l1, n2 = f2 / l2;
  const Real cosine = n1.dot(n2), sine = n1.cross(n2).norm();
  const bool is_angle = form == StrainForm::angle;
  const Real value = is_angle ? std::atan2(cosine, sine) : cosine;
  if (!(1 - cosine * cosine > parallel_sine_squared<Real>))
    return {.value = value, .gradient = {}, .defined = false};
  const Real slope = is_angle ? 1 / sine : Real(1);
  const Vector3Of<Real> a1 = slope * (n2 - cosine * n1) / l1, a2 = slope * (n1 - cosine * n2) / l2;
  return {value, detail::corner_gradients<Real>(q[0] * a1 + q[1] * a2, q[2] * a1 + q[3] * a2)};
}

/// Area ratio C = A / A0 - 1 (SBD 2014, eqs. 17 and 19), ∇_b C = e2 × n / 2A0 and ∇_c C = n × e1 / 2A0 with
/// the unit normal n; 1 / 2A0 = |det Q⁻¹|.
template <class Real>
ConstraintValue<Real, 3> area_constraint(const std::array<Vector3Of<Real>, 3>& p,
                                         const std::array<Real, 4>& q) {
  const Vector3Of<Real> e1 = p[1] - p[0], e2 = p[2] - p[0], normal = e1.cross(e2);
  const Real twice_area = normal.norm(), inverse_rest = std::abs(q[0] * q[3] - q[1] * q[2]);
  if (!(twice_area * inverse_rest > collapsed_ratio<Real>))
    return {.value = -1, .gradient = {}, .defined = false};
  if (!(twice_area * twice_area * inverse_rest * inverse_rest < overgrown_square<Real>))
    return {.gradient = {}, .defined = false};
  const Vector3Of<Real> n = normal / twice_area;
  return {twice_area * inverse_rest - 1,
          detail::corner_gradients<Real>(inverse_rest * e2.cross(n), inverse_rest * n.cross(e1))};
}

/// C = S_11 + S_22 - 2, ∂C/∂f_i = 2 f_i: the fourth term of StrainForm::stvk.
template <class Real>
ConstraintValue<Real, 3> trace_constraint(const std::array<Vector3Of<Real>, 3>& p,
                                          const std::array<Real, 4>& q) {
  const auto [f1, f2] = deformation_gradient(p, q);
  const Real trace = f1.squaredNorm() + f2.squaredNorm();
  if (!(trace > collapsed_ratio<Real> * collapsed_ratio<Real> && trace < overgrown_square<Real>))
    return {.gradient = {}, .defined = false};
  return {trace - 2,
          detail::corner_gradients<Real>(2 * (q[0] * f1 + q[1] * f2), 2 * (q[2] * f1 + q[3] * f2))};
}

/// The fourth term of a form.
template <class Real>
ConstraintValue<Real, 3> area_term(const std::array<Vector3Of<Real>, 3>& p, const std::array<Real, 4>& q,
                                   StrainForm form) {
  return form == StrainForm::stvk ? trace_constraint(p, q) : area_constraint(p, q);
}

/// Σ w|∇C|², or 0 if the gradient of the free corners is only a rounding error (see least_lever).
template <class Real, std::size_t N>
Real weighted_square(const std::array<Real, N>& w, const ConstraintValue<Real, N>& c) {
  Real sum = 0, whole = 0;
  for (std::size_t i = 0; i < N; ++i) {
    sum += w[i] * c.gradient[i].squaredNorm();
    whole += c.gradient[i].squaredNorm();
  }
  return sum > least_lever<Real> * *std::max_element(w.begin(), w.end()) * whole ? sum : Real(0);
}

template <class Real, std::size_t N>
std::array<Real, N> inverse_masses(const std::array<Corner<Real>, N>& corners) {
  std::array<Real, N> w;
  for (std::size_t i = 0; i < N; ++i) w[i] = corners[i].w;
  return w;
}

/// No bound on the move of a corner, m. Used for distances, whose correction is never longer than C.
template <class Real>
inline constexpr Real anywhere = std::numeric_limits<Real>::infinity();

/// Moves the corners by Δx = w ∇C Δλ and returns Δλ. Δλ is `change`, or less if a corner would move over
/// `reach`, m.
template <class Real, std::size_t N>
Real move_by_oracle(std::array<Corner<Real>, N> corners, const ConstraintValue<Real, N>& c, Real change,
                    Real reach) {
  Real farthest = 0;
  for (std::size_t i = 0; i < N; ++i)
    farthest = std::max(farthest, std::abs(change) * corners[i].w * c.gradient[i].norm());
  if (farthest > reach) change *= reach / farthest;
  for (std::size_t i = 0; i < N; ++i) corners[i].move(corners[i].w * change * c.gradient[i]);
  return change;
}

/// One projection. If `multiplier` is null: PBD with the fraction `k`, Δλ = -k C / Σ w|∇C|². Otherwise: XPBD
/// with λ = *multiplier and α̃ = `compliance_over_h2`, Δλ = (-C - α̃ λ) / (Σ w|∇C|² + α̃).
template <class Real, std::size_t N>
void project_by_oracle(const std::array<Corner<Real>, N>& corners, const ConstraintValue<Real, N>& c, Real k,
                       Real* multiplier, Real compliance_over_h2, Real reach = anywhere<Real>) {
  if (!c.defined) return;
  const Real w = weighted_square(inverse_masses(corners), c);
  if (!(w > 0)) return;
  const Real change = multiplier ? (-c.value - compliance_over_h2 * *multiplier) / (w + compliance_over_h2)
                                 : -k * c.value / w;
  const Real done = move_by_oracle(corners, c, change, reach);
  if (multiplier) *multiplier += done;
}

/// Removes the fraction `k` of Ċ from the velocities: Δv = -k Ċ / Σ w|∇C|² w ∇C.
template <class Real, std::size_t N>
void damp_by_oracle(const std::array<const Point<Real>*, N>& points,
                    const std::array<Point<Real>*, N>& velocities, const ConstraintValue<Real, N>& c,
                    Real k) {
  if (!c.defined) return;
  std::array<Real, N> w;
  Real rate = 0;
  for (std::size_t i = 0; i < N; ++i) {
    w[i] = points[i]->w;
    rate += c.gradient[i].dot(velocities[i]->vector());
  }
  const Real sum = weighted_square(w, c);
  if (!(sum > 0)) return;
  for (std::size_t i = 0; i < N; ++i)
    velocities[i]->set(velocities[i]->vector() - k * rate / sum * points[i]->w * c.gradient[i]);
}

template <class Real>
void damp_by_oracle(const Point<Real>* points, Point<Real>* velocities, const DistanceBatch<Real>& batch,
                    Real k);
template <class Real>
void damp_by_oracle(const Point<Real>* points, Point<Real>* velocities, const StrainBatch<Real>& batch,
                    Real k);

template <class Real, class Kind>
void damp_by_oracle(const Point<Real>* points, Point<Real>* velocities, const ElementBatch<Real, Kind>& batch,
                    Real k);

/// Projects all constraints of a batch once, in the order of the lanes or backwards.
template <class Real>
void project_by_oracle(const PlacesOf<Real>& places, DistanceBatch<Real>& batch, Real substep,
                       bool backwards = false);
template <class Real>
void project_by_oracle(const PlacesOf<Real>& places, StrainBatch<Real>& batch, Real substep,
                       bool backwards = false);
template <class Real, class Kind>
void project_by_oracle(const PlacesOf<Real>& places, ElementBatch<Real, Kind>& batch, Real substep,
                       bool backwards = false);

}  // namespace bendlab
