#include "bendlab/constraints/effective_stiffness.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "bendlab/constraints/oracle.hpp"

namespace bendlab {
namespace {

using Eigen::Vector3d;

// Calls visit(lane, stack) for every lane that holds a constraint.
template <class Visit>
void for_constraints(const BatchOrder& order, Visit visit) {
  for (std::size_t stack = 0; stack < order.stack_count(); ++stack)
    for (std::size_t lane = order.stacks[stack]; lane < order.stacks[stack + 1]; ++lane)
      if (order.holds(stack, lane)) visit(lane, stack);
}

std::size_t index_at(int offset) {
  return static_cast<std::size_t>(offset / offset_of(1));
}

template <class Batch>
bool has_compliance(const Batch& batch) {
  return batch.kind == StiffnessKind::compliance && batch.compliance > 0 && batch.count > 0;
}

template <class Batch>
double compliance_over_h2(const Batch& batch, double substep) {
  return static_cast<double>(batch.compliance) / (substep * substep);
}

double square(double x) {
  return x * x;
}

// Adds a constraint whose bending part B equals its value C.
template <std::size_t N>
void add(AppliedWork& work, const ConstraintValue<double, N>& c, double multiplier, double alpha,
         double rounding) {
  if (!c.defined) return;
  double slope = 0;  // |∇C|²
  for (const Vector3d& gradient : c.gradient) slope += gradient.squaredNorm();
  work.applied -= multiplier * c.value;
  work.stated += square(c.value) / alpha;
  work.spent += alpha * square(multiplier);
  work.measured += square(c.value) / alpha;
  work.rounding += square(rounding) * slope / alpha;
}

template <class Real>
AppliedWork membrane_work(const StrainBatch<Real>& batch, const PermutedState& state) {
  AppliedWork work;
  if (!has_compliance(batch)) return work;
  const std::size_t count = batch.a.size();
  for_constraints(batch.order, [&](std::size_t lane, std::size_t) {
    const std::array<Vector3d, 3> p = {state.positions[index_at(batch.a[lane])],
                                       state.positions[index_at(batch.b[lane])],
                                       state.positions[index_at(batch.c[lane])]};
    const std::array<double, 4> q = {batch.q00[lane], batch.q01[lane], batch.q10[lane], batch.q11[lane]};
    // As in oracle.cpp: α = compliance / A0.
    const double softness = batch.softness.empty() ? 1 : static_cast<double>(batch.softness[lane]);
    const double alpha =
        compliance_over_h2(batch, state.substep) * 2 * std::abs(q[0] * q[3] - q[1] * q[2]) * softness;
    const double stretch_alpha = stretch_softness(batch.form) * alpha;
    std::array<double, 3> softer;
    for (std::size_t i = 0; i < 3; ++i) softer[i] = static_cast<double>(batch.term_softness[i]);
    const auto add_term = [&](std::size_t term, Real k, const ConstraintValue<double, 3>& c,
                              double term_alpha) {
      if (k != 0)
        add(work, c, static_cast<double>(batch.multiplier[term * count + lane]), term_alpha, state.rounding);
    };
    add_term(0, batch.warp, stretch_constraint(p, q, 0, batch.form), softer[0] * stretch_alpha);
    add_term(1, batch.weft, stretch_constraint(p, q, 1, batch.form), softer[1] * stretch_alpha);
    add_term(2, batch.shear, shear_constraint(p, q, batch.form),
             softer[2] * shear_softness(batch.form) * alpha);
    if (batch.area != 0)
      add_term(3, batch.area, area_term(p, q, batch.form),
               area_softness(batch.form, static_cast<double>(batch.area)) * alpha);
  });
  return work;
}

// The Green strain E of the membrane at every vertex, as a tensor on the rest shape: the mean over the
// vertex's triangles, weighted by area. A vertex whose triangles have no area has no strain.
struct MembraneStrain {
  std::vector<Eigen::Matrix3d> strain;
  std::vector<double> area;  // m²

  template <class Real>
  MembraneStrain(const StrainBatch<Real>& batch, const PermutedState& state)
      : strain(state.positions.size(), Eigen::Matrix3d::Zero()), area(state.positions.size(), 0) {
    for_constraints(batch.order, [&](std::size_t lane, std::size_t) {
      add_triangle({index_at(batch.a[lane]), index_at(batch.b[lane]), index_at(batch.c[lane])}, state);
    });
    for (std::size_t v = 0; v < strain.size(); ++v)
      if (area[v] > 0) strain[v] /= area[v];
  }

  void add_triangle(const std::array<std::size_t, 3>& corner, const PermutedState& state) {
    const auto edges = [&](std::span<const Vector3d> p) {
      Eigen::Matrix<double, 3, 2> e;
      e << p[corner[1]] - p[corner[0]], p[corner[2]] - p[corner[0]];
      return e;
    };
    const Eigen::Matrix<double, 3, 2> at_rest = edges(state.rest), now = edges(state.positions);
    const Eigen::Matrix2d metric = at_rest.transpose() * at_rest;
    constexpr double least = 1e-6;  // sin² of the angle at the first corner: flatter triangles are left out
    if (!(metric.determinant() > least * metric(0, 0) * metric(1, 1))) return;
    const Eigen::Matrix<double, 3, 2> dual = at_rest * metric.inverse();
    const double of_triangle = 0.5 * std::sqrt(metric.determinant());
    const Eigen::Matrix3d e = 0.5 * dual * (now.transpose() * now - metric) * dual.transpose();
    for (const std::size_t v : corner) strain[v] += of_triangle * e, area[v] += of_triangle;
  }
};

// r0 and B of a spring, as defined in the header.
struct BendingPart {
  double at_rest = 0, value = 0;  // m
};

class SpringMeter {
 public:
  template <class Real>
  SpringMeter(const StrainBatch<Real>& membrane, const PermutedState& state)
      : state_(state), membrane_(membrane, state) {}

  std::optional<BendingPart> operator()(std::size_t a, std::size_t b) const {
    if (state_.is_pinned[a] || state_.is_pinned[b] || !(membrane_.area[a] > 0 && membrane_.area[b] > 0))
      return std::nullopt;
    const Vector3d along = state_.rest[a] - state_.rest[b];
    const double at_rest = along.norm();
    if (!(at_rest > 0)) return std::nullopt;
    const double strain =
        along.dot((membrane_.strain[a] + membrane_.strain[b]) * along) / 2 / square(at_rest);
    const double stretched = at_rest * std::sqrt(std::max(0.0, 1 + 2 * strain));
    return BendingPart{at_rest, (state_.positions[a] - state_.positions[b]).norm() - stretched};
  }

  // The rounding error of B, m. Both ends of the spring and the strain between its ends contribute.
  double rounding() const { return 4 * state_.rounding; }

 private:
  const PermutedState& state_;
  MembraneStrain membrane_;
};

void add(AppliedWork& work, const BendingPart& bend, double multiplier, double stated, double alpha,
         double rounding) {
  work.applied -= multiplier * bend.value;
  work.stated -= stated * bend.value;
  work.measured += square(bend.value) / alpha;
  work.rounding += square(rounding) / alpha;
}

template <class Real>
void add_springs(AppliedWork& work, const DistanceBatch<Real>& batch, const SpringMeter& meter,
                 double substep) {
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  for_constraints(batch.order, [&](std::size_t lane, std::size_t stack) {
    const std::optional<BendingPart> bend =
        meter(index_at(batch.a[stack * width + lane % width]), index_at(batch.b[lane]));
    if (!bend) return;
    const double softness = batch.softness.empty() ? 1 : static_cast<double>(batch.softness[lane]);
    const double alpha = softness * compliance_over_h2(batch, substep);
    const double value = bend->at_rest - static_cast<double>(batch.rest_length[lane]) + bend->value;
    add(work, *bend, static_cast<double>(batch.multiplier[lane]), -value / alpha, alpha, meter.rounding());
  });
}

// Adds the springs of a kind whose value is a distance. `stated` is the push by the law of the kind.
template <class Real, OneSided Kind>
void add_springs(AppliedWork& work, const ElementBatch<Real, Kind>& batch, const SpringMeter& meter,
                 double substep) {
  for_constraints(batch.order, [&](std::size_t lane, std::size_t) {
    const std::optional<BendingPart> bend =
        meter(index_at(batch.corner[0][lane]), index_at(batch.corner[1][lane]));
    if (!bend || !(bend->value < 0)) return;
    const double alpha = static_cast<double>(batch.softness[lane]) * compliance_over_h2(batch, substep);
    const double length = static_cast<double>(batch.rest[0][lane]);
    const double stated = Kind::push(1 + bend->value / length, batch.law) / (alpha * square(length));
    add(work, *bend, static_cast<double>(batch.multiplier[lane]), stated, alpha, meter.rounding());
  });
}

template <class Real, class Kind>
void add_hinges(AppliedWork& work, const ElementBatch<Real, Kind>& batch, const PermutedState& state) {
  for_constraints(batch.order, [&](std::size_t lane, std::size_t) {
    std::array<Vector3d, Kind::arity> p;
    std::array<double, Kind::rest_values> rest;
    for (std::size_t i = 0; i < Kind::arity; ++i) p[i] = state.positions[index_at(batch.corner[i][lane])];
    for (std::size_t i = 0; i < Kind::rest_values; ++i) rest[i] = static_cast<double>(batch.rest[i][lane]);
    const auto c = Kind::value(p, rest, batch.law);
    double alpha = static_cast<double>(batch.softness[lane]) * compliance_over_h2(batch, state.substep);
    if (!batch.is_linear())
      alpha /= resistance(batch.softening, std::abs(c.value), static_cast<double>(batch.length[lane]),
                          static_cast<double>(batch.yield[lane]), static_cast<double>(batch.hardening[lane]))
                   .secant;
    add(work, c, static_cast<double>(batch.multiplier[lane]), alpha, state.rounding);
  });
}

bool is_measured(const AppliedWork& work) {
  constexpr double least = 100;  // ratio of squares: C is then 10 times its rounding
  return work.measured > least * work.rounding && work.stated > 0;
}

// The share is 0 if the work has the wrong sign, because the constraints increase the deformation.
double share_of(const AppliedWork& work) {
  // Bound on flexibility / stiffness. In strips and sheets at rest this ratio was 7 or less. In a cloth that
  // shakes it is in the hundreds, because of multipliers that do not resist bending.
  constexpr double most = 8;
  const double stiffness = std::max(0.0, work.applied) / work.stated;
  if (work.spent == 0 || !(stiffness > 0)) return stiffness;
  const double flexibility = std::min(work.spent / work.applied, most * stiffness);
  return std::cbrt(stiffness * square(flexibility));
}

}  // namespace

AppliedWork& AppliedWork::operator+=(const AppliedWork& other) {
  applied += other.applied, stated += other.stated, spent += other.spent;
  measured += other.measured, rounding += other.rounding;
  return *this;
}

EffectiveStiffness& EffectiveStiffness::operator+=(const EffectiveStiffness& other) {
  membrane += other.membrane, hinges += other.hinges, springs += other.springs;
  return *this;
}

std::optional<double> EffectiveStiffness::bending_share() const {
  double sum = 0, weight = 0;
  for (const AppliedWork* work : {&hinges, &springs})
    if (is_measured(*work)) sum += work->stated * share_of(*work), weight += work->stated;
  return weight > 0 ? std::optional(sum / weight) : std::nullopt;
}

std::optional<double> EffectiveStiffness::membrane_share() const {
  return is_measured(membrane) ? std::optional(share_of(membrane)) : std::nullopt;
}

template <class Real>
EffectiveStiffness effective_stiffness(const Constraints<Real>& constraints, const PermutedState& state) {
  EffectiveStiffness result{
      .membrane = membrane_work(constraints.strain, state), .hinges = {}, .springs = {}};
  if (constraints.own.count > 0) return result;  // which part of own elements is bending is not known
  std::optional<SpringMeter> meter;
  const auto measure_springs = [&](const auto& batch) {
    if (state.rest.empty()) return;
    if (!meter) meter.emplace(constraints.strain, state);
    add_springs(result.springs, batch, *meter, state.substep);
  };
  if (has_compliance(constraints.distance)) measure_springs(constraints.distance);
  for_each_kind(constraints.elements, [&]<class Kind>(const ElementBatch<Real, Kind>& batch) {
    if (!has_compliance(batch)) return;
    if constexpr (OneSided<Kind>)
      measure_springs(batch);
    else
      add_hinges(result.hinges, batch, state);
  });
  return result;
}

template EffectiveStiffness effective_stiffness(const Constraints<float>&, const PermutedState&);
template EffectiveStiffness effective_stiffness(const Constraints<double>&, const PermutedState&);

}  // namespace bendlab
