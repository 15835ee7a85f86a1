#include "bendlab/constraints/oracle.hpp"

#include <algorithm>

#include "bendlab/constraints/kinds.hpp"
#include "bendlab/constraints/sine_projection.hpp"

namespace bendlab {
namespace {

// Calls visit(lane, stack) for every lane that holds a constraint, in the order of the lanes or backwards.
template <class Visit>
void for_lanes(const BatchOrder& order, bool backwards, Visit visit) {
  for (std::size_t step = 0; step < order.stack_count(); ++step) {
    const std::size_t stack = backwards ? order.stack_count() - 1 - step : step;
    const std::size_t begin = order.stacks[stack], end = order.stacks[stack + 1];
    for (std::size_t at = begin; at < end; ++at) {
      const std::size_t lane = backwards ? end - 1 - (at - begin) : at;
      if (order.holds(stack, lane)) visit(lane, stack);
    }
  }
}

// Offset of a spring's first vertex, the centre of its star.
template <class Real>
int centre_of(const DistanceBatch<Real>& batch, std::size_t lane, std::size_t stack) {
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  return batch.a[stack * width + lane % width];
}

template <class Real, class P, std::size_t N>
std::array<Vector3Of<Real>, N> vectors_of(const std::array<P*, N>& points) {
  std::array<Vector3Of<Real>, N> vectors;
  for (std::size_t i = 0; i < N; ++i) vectors[i] = points[i]->vector();
  return vectors;
}
template <class Real, std::size_t N>
std::array<Vector3Of<Real>, N> vectors_of(const std::array<Corner<Real>, N>& corners) {
  std::array<Vector3Of<Real>, N> vectors;
  for (std::size_t i = 0; i < N; ++i) vectors[i] = corners[i].vector();
  return vectors;
}

template <class Kind, class P, class Batch>
std::array<P*, Kind::arity> corners_of(P* points, const Batch& batch, std::size_t lane) {
  std::array<P*, Kind::arity> corners;
  for (std::size_t i = 0; i < Kind::arity; ++i) corners[i] = &point_at(points, batch.corner[i][lane]);
  return corners;
}

template <class Real, class Kind>
std::array<Real, Kind::rest_values> rest_of(const ElementBatch<Real, Kind>& batch, std::size_t lane) {
  std::array<Real, Kind::rest_values> rest;
  for (std::size_t i = 0; i < Kind::rest_values; ++i) rest[i] = batch.rest[i][lane];
  return rest;
}

// value_at(p). If the constraint has collapsed, the result has the gradient of the rest shape, whose corners
// are `rest` (null: there is no rest shape).
template <class Real, std::size_t N, class ValueAt>
ConstraintValue<Real, N> opening(const std::array<Corner<Real>, N>& p,
                                 const std::array<const Point<Real>*, N>& rest, const ValueAt& value_at) {
  ConstraintValue<Real, N> c = value_at(vectors_of<Real>(p));
  if (c.defined || c.value == 0 || rest[0] == nullptr) return c;
  const ConstraintValue<Real, N> at_rest = value_at(vectors_of<Real>(rest));
  return {c.value, at_rest.gradient, at_rest.defined};
}

// Whether a projection with k acts.
template <class Kind, class Real>
bool resists(Real value, typename Kind::Law law) {
  if constexpr (std::is_same_v<Kind, HingeAngle>)
    return law != HingeAngle::Law::sine || std::abs(value) < Real(largest_sine);
  else
    return true;
}

template <class Real, class... Offsets>
std::array<const Point<Real>*, sizeof...(Offsets)> rest_corners(const Point<Real>* rest_points,
                                                                Offsets... offsets) {
  if (rest_points == nullptr) return {};
  return {&point_at(rest_points, offsets)...};
}

// XPBD for a kind that defines its own change of the multiplier.
template <class Real, OneSided Kind, std::size_t N>
void project_one_sided(const std::array<Corner<Real>, N>& p, const ConstraintValue<Real, N>& c,
                       const std::array<Real, Kind::rest_values>& rest, typename Kind::Law law, Real alpha,
                       Real& multiplier, Real reach) {
  if (!c.defined) return;
  const Real w = weighted_square(inverse_masses(p), c);
  if (!(w > 0)) return;
  std::array<double, Kind::rest_values> exact_rest;
  std::copy(rest.begin(), rest.end(), exact_rest.begin());
  const auto change = static_cast<Real>(Kind::change(c.value, exact_rest, law, w, alpha, multiplier));
  multiplier += move_by_oracle(p, c, change, reach);
}

// For a spring that only pulls (λ ≤ 0). Undoes the pull of a slack spring. Returns whether the spring is
// slack.
template <class Real>
bool slackened(const std::array<Corner<Real>, 2>& p, const ConstraintValue<Real, 2>& c, Real* multiplier) {
  if (multiplier == nullptr) return c.value <= 0;
  const Real w = weighted_square(inverse_masses(p), c);
  if (!c.defined || !(w > 0) || c.value >= *multiplier * w) return false;
  *multiplier += move_by_oracle(p, c, -*multiplier, anywhere<Real>);
  return true;
}

}  // namespace

template <class Real>
void project_by_oracle(const PlacesOf<Real>& places, DistanceBatch<Real>& batch, Real substep,
                       bool backwards) {
  const Real compliance = batch.compliance / (substep * substep);
  for_lanes(batch.order, backwards, [&](std::size_t lane, std::size_t stack) {
    const Real alpha = batch.softness.empty() ? compliance : compliance * batch.softness[lane];
    const auto p = corners_at<Real>(places, centre_of(batch, lane, stack), batch.b[lane]);
    const bool compliant = batch.kind == StiffnessKind::compliance;
    const auto c = opening(p, rest_corners(batch.rest_points, centre_of(batch, lane, stack), batch.b[lane]),
                           [&](const auto& x) { return distance_constraint(x, batch.rest_length[lane]); });
    Real* const multiplier = compliant ? &batch.multiplier[lane] : nullptr;
    if (batch.only_pulls && slackened(p, c, multiplier)) return;
    project_by_oracle(p, c, batch.k, multiplier, compliant ? alpha : Real(0));
  });
}

template <class Real>
void project_by_oracle(const PlacesOf<Real>& places, StrainBatch<Real>& batch, Real substep, bool backwards) {
  const std::size_t count = batch.a.size();
  const bool compliant = batch.kind == StiffnessKind::compliance;
  for_lanes(batch.order, backwards, [&](std::size_t lane, std::size_t) {
    const auto p = corners_at<Real>(places, batch.a[lane], batch.b[lane], batch.c[lane]);
    const std::array<Real, 4> q = {batch.q00[lane], batch.q01[lane], batch.q10[lane], batch.q11[lane]};
    // α = compliance / A0 with A0 = 1 / (2 |det Q⁻¹|).
    const Real softness = batch.softness.empty() ? Real(1) : batch.softness[lane];
    const Real alpha =
        batch.compliance / (substep * substep) * 2 * std::abs(q[0] * q[3] - q[1] * q[2]) * softness;
    const auto stretch_alpha = [&](std::size_t axis) {
      return static_cast<Real>(stretch_softness(batch.form)) * batch.term_softness[axis] * alpha;
    };
    const auto rest = rest_corners(batch.rest_points, batch.a[lane], batch.b[lane], batch.c[lane]);
    const auto apply = [&](std::size_t term, Real k, Real term_alpha, const auto& value_at,
                           int most_sizes = largest_move) {
      if (k == 0) return;
      project_by_oracle(p, opening(p, rest, value_at), k,
                        compliant ? &batch.multiplier[term * count + lane] : nullptr,
                        compliant ? term_alpha : Real(0),
                        static_cast<Real>(most_sizes) * size_of_triangle(vectors_of<Real>(p), q));
    };
    // If warp or weft had collapsed before the first term, its stretch is C = f·d - 1, even if the first term
    // changed f. d is the direction of f in the rest shape.
    const auto start = vectors_of<Real>(p);
    const auto stretch = [&](int axis) {
      const auto constraint = [&, axis](const auto& x) { return stretch_constraint(x, q, axis, batch.form); };
      const ConstraintValue<Real, 3> before = constraint(start);
      const bool opens = !before.defined && before.value != 0 && rest[0] != nullptr;
      const auto which = static_cast<std::size_t>(axis);
      return [&, axis, which, opens](const auto& x) {
        if (!opens) return stretch_constraint(x, q, axis, batch.form);
        auto c = stretch_constraint(vectors_of<Real>(rest), q, axis, StrainForm::normalised);
        c.value =
            deformation_gradient(x, q)[which].dot(deformation_gradient(vectors_of<Real>(rest), q)[which]) - 1;
        return c;
      };
    };
    const auto warp = stretch(0), weft = stretch(1);
    apply(0, batch.warp, stretch_alpha(0), warp);
    apply(1, batch.weft, stretch_alpha(1), weft);
    apply(
        2, batch.shear, static_cast<Real>(shear_softness(batch.form)) * batch.term_softness[2] * alpha,
        [&](const auto& x) { return shear_constraint(x, q, batch.form); },
        batch.form == StrainForm::normalised ? largest_published_move : largest_move);
    if (batch.area != 0)
      apply(3, batch.area, area_softness(batch.form, batch.area) * alpha,
            [&](const auto& x) { return area_term(x, q, batch.form); });
  });
}

template <class Real>
void damp_by_oracle(const Point<Real>* points, Point<Real>* velocities, const DistanceBatch<Real>& batch,
                    Real k) {
  for_lanes(batch.order, false, [&](std::size_t lane, std::size_t stack) {
    const std::array<const Point<Real>*, 2> p = {&point_at(points, centre_of(batch, lane, stack)),
                                                 &point_at(points, batch.b[lane])};
    const std::array<Point<Real>*, 2> v = {&point_at(velocities, centre_of(batch, lane, stack)),
                                           &point_at(velocities, batch.b[lane])};
    damp_by_oracle(p, v, distance_constraint(vectors_of<Real>(p), batch.rest_length[lane]), k);
  });
}

template <class Real>
void damp_by_oracle(const Point<Real>* points, Point<Real>* velocities, const StrainBatch<Real>& batch,
                    Real k) {
  for_lanes(batch.order, false, [&](std::size_t lane, std::size_t) {
    const std::array<const Point<Real>*, 3> p = {
        &point_at(points, batch.a[lane]), &point_at(points, batch.b[lane]), &point_at(points, batch.c[lane])};
    const std::array<Point<Real>*, 3> v = {&point_at(velocities, batch.a[lane]),
                                           &point_at(velocities, batch.b[lane]),
                                           &point_at(velocities, batch.c[lane])};
    const std::array<Real, 4> q = {batch.q00[lane], batch.q01[lane], batch.q10[lane], batch.q11[lane]};
    const auto x = vectors_of<Real>(p);
    if (batch.warp != 0) damp_by_oracle(p, v, stretch_constraint(x, q, 0, StrainForm::normalised), k);
    if (batch.weft != 0) damp_by_oracle(p, v, stretch_constraint(x, q, 1, StrainForm::normalised), k);
    if (batch.shear != 0) damp_by_oracle(p, v, shear_constraint(x, q, StrainForm::normalised), k);
  });
}

template <class Real, class Kind>
void project_by_oracle(const PlacesOf<Real>& places, ElementBatch<Real, Kind>& batch, Real substep,
                       bool backwards) {
  const bool compliant = batch.kind == StiffnessKind::compliance;
  for_lanes(batch.order, backwards, [&](std::size_t lane, std::size_t) {
    std::array<int, Kind::arity> offsets;
    for (std::size_t i = 0; i < Kind::arity; ++i) offsets[i] = batch.corner[i][lane];
    const auto p = corners_at<Real>(places, offsets, directors_of<Kind>);
    Real alpha = compliant ? batch.compliance * batch.softness[lane] / (substep * substep) : Real(0);
    const auto rest = rest_of(batch, lane);
    std::array<const Point<Real>*, Kind::arity> at_rest{};
    if (batch.rest_points != nullptr) at_rest = corners_of<Kind>(batch.rest_points, batch, lane);
    const auto c = opening(p, at_rest, [&](const auto& x) { return Kind::value(x, rest, batch.law); });
    if (!batch.is_linear())
      alpha /= static_cast<Real>(resistance(batch.softening, std::abs(static_cast<double>(c.value)),
                                            batch.length[lane], batch.yield[lane], batch.hardening[lane])
                                     .secant);
    const Real reach = largest_move * size_of(vectors_of<Real>(p), Kind::rest_size(rest), directors_of<Kind>);
    if constexpr (OneSided<Kind>) {
      if (compliant)
        project_one_sided<Real, Kind>(p, c, rest, batch.law, alpha, batch.multiplier[lane], reach);
      else if (c.value < 0)
        project_by_oracle<Real>(p, c, batch.k, nullptr, 0, reach);
    } else if (compliant || resists<Kind>(c.value, batch.law)) {
      project_by_oracle(p, c, batch.k, compliant ? &batch.multiplier[lane] : nullptr, alpha, reach);
    }
  });
}

template <class Real, class Kind>
void damp_by_oracle(const Point<Real>* points, Point<Real>* velocities, const ElementBatch<Real, Kind>& batch,
                    Real k) {
  for_lanes(batch.order, false, [&](std::size_t lane, std::size_t) {
    const auto p = corners_of<Kind>(points, batch, lane);
    const auto c = Kind::value(vectors_of<Real>(p), rest_of(batch, lane), batch.law);
    if ((OneSided<Kind> && !(c.value < 0)) || !resists<Kind>(c.value, batch.law)) return;
    damp_by_oracle(p, corners_of<Kind>(velocities, batch, lane), c, k);
  });
}

#define BENDLAB_ELEMENT_ORACLE(Kind)                                                                         \
  template void project_by_oracle(const Places<float>&, ElementBatch<float, Kind>&, float, bool);            \
  template void project_by_oracle(const Places<double>&, ElementBatch<double, Kind>&, double, bool);         \
  template void damp_by_oracle(const Point<float>*, Point<float>*, const ElementBatch<float, Kind>&, float); \
  template void damp_by_oracle(const Point<double>*, Point<double>*, const ElementBatch<double, Kind>&,      \
                               double);
BENDLAB_FOR_ELEMENT_KINDS(BENDLAB_ELEMENT_ORACLE)

template void damp_by_oracle(const Point<float>*, Point<float>*, const DistanceBatch<float>&, float);
template void damp_by_oracle(const Point<double>*, Point<double>*, const DistanceBatch<double>&, double);
template void damp_by_oracle(const Point<float>*, Point<float>*, const StrainBatch<float>&, float);
template void damp_by_oracle(const Point<double>*, Point<double>*, const StrainBatch<double>&, double);
template void project_by_oracle(const Places<float>&, DistanceBatch<float>&, float, bool);
template void project_by_oracle(const Places<double>&, DistanceBatch<double>&, double, bool);
template void project_by_oracle(const Places<float>&, StrainBatch<float>&, float, bool);
template void project_by_oracle(const Places<double>&, StrainBatch<double>&, double, bool);

}  // namespace bendlab
