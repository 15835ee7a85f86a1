#include "bendlab/solver/time_step.hpp"

#include <chrono>
#include <cmath>
#include <limits>

#include "bendlab/solver/colouring.hpp"
#include "bendlab/solver/memory.hpp"

namespace bendlab {
namespace {

constexpr double divergence_bound = 1e6;  // sizes from the origin

}  // namespace

template <class Real>
TimeStep<Real>::TimeStep(const SimulationInput& input, std::vector<int> permutation)
    : settings_(input.settings),
      permutation_(std::move(permutation)),
      workers_(input.settings.threads),
      bound_(static_cast<Real>(divergence_bound * input.size)),
      yields_(can_yield(input.elements)),
      strain_schedule_(input.strain_schedule),
      bending_schedule_(input.bending_schedule) {
  fill_state(input);
  lists_.emplace(input);
  constraints_.for_each([](auto& batch) { batch.order = list_order(0); });
}

template <class Real>
void TimeStep<Real>::order_constraints(const SimulationInput& input, const Ordering& ordering) {
  constraints_ = ordered_constraints<Real>(input, rest_points(), ordering);
  strain_compliance_ = constraints_.strain.compliance;
  bending_compliance_ = input.bending_stiffness.compliance;
  lists_.reset();
}

template <class Real>
void TimeStep<Real>::fill_state(const SimulationInput& input) {
  const std::size_t count = input.point_count();
  state_.vertex_count = static_cast<int>(input.positions.rows());
  state_.point_count = static_cast<int>(count);
  state_.origin = input.origin;
  state_.mass.resize(count);
  state_.position.resize(count + dummy_points);
  state_.velocity.resize(count + dummy_points);
  const Positions start = input.points(), rest = input.rest_points();
  for (std::size_t v = 0; v < count; ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    const std::size_t at = permuted(v);
    state_.mass[at] = input.mass_of(v);
    state_.position[at].set((start.row(row).transpose() - origin_of(v)).template cast<Real>());
    const bool free = input.is_free(v);
    state_.position[at].w = free ? static_cast<Real>(1 / state_.mass[at]) : Real(0);
    if (free && row < input.velocities.rows())
      state_.velocity[at].set(input.velocities.row(row).transpose().template cast<Real>());
  }
  for (std::size_t v = 0; v < input.held.size(); ++v)
    if (input.held[v] != 0 && input.is_free(v))
      held_.push_back({permuted(v), {input.is_held(v, 0), input.is_held(v, 1), input.is_held(v, 2)}});
  drop_held(state_.velocity);
  place_dummies(state_.position, count);
  state_.previous = state_.position;
  if (rest.rows() == 0) return;
  rest_.resize(count + dummy_points);
  for (std::size_t v = 0; v < count; ++v)
    rest_[permuted(v)].set(
        (rest.row(static_cast<Eigen::Index>(v)).transpose() - origin_of(v)).template cast<Real>());
}

template <class Real>
bool TimeStep<Real>::step() {
  PassContext<Real> context{state_, constraints_, static_cast<Real>(settings_.dt / settings_.substeps)};
  for (int s = 0; s < settings_.substeps; ++s) {
    context.time = time();
    follow_schedules();
    substep(context);
    ++substeps_done_;
  }
  return divergence_.vertex < 0 || (divergence_.time = time(), false);
}

// The stiffness of a substep is that at its end.
template <class Real>
void TimeStep<Real>::follow_schedules() {
  if (!strain_schedule_.is_given() && !bending_schedule_.is_given()) return;
  const double end = time() + settings_.dt / settings_.substeps;
  const StiffnessFactors now{strain_schedule_.at(end), bending_schedule_.at(end)};
  if (now == factors_) return;
  scale_stiffness(now);
  factors_ = now;
}

template <class Real>
void TimeStep<Real>::scale_stiffness(const StiffnessFactors& factors) {
  constraints_.strain.compliance =
      static_cast<Real>(static_cast<double>(strain_compliance_) / factors.strain);
  const double bending = bending_compliance_ / factors.bending;
  constraints_.distance.compliance = static_cast<Real>(bending);
  for_each_kind(constraints_.elements, [&](auto& batch) { batch.compliance = static_cast<Real>(bending); });
  constraints_.own.compliance = bending;
}

template <class Real>
std::size_t TimeStep<Real>::memory_bytes() const {
  return bytes_of(state_) + bytes_of(constraints_) + bytes_of(rest_) + bytes_of(permutation_);
}

template <class Real>
std::size_t TimeStep<Real>::add_statistics(const std::string& name) {
  statistics_.push_back({name});
  return statistics_.size() - 1;
}

template <class Real>
void TimeStep<Real>::append_effects(Passes& passes, std::vector<Pass<Real>>& effect_passes, Stage stage) {
  for (Pass<Real>& pass : effect_passes) {
    if (pass.stage != stage) continue;
    passes.push_back({std::move(pass.run), add_statistics(pass.name)});
    if (pass.archive) effect_archives_.push_back(std::move(pass.archive));
  }
}

// The archive does not need the divergence, because a diverged simulation takes no more steps. Contacts (for
// one iteration) and multipliers (for one substep) are left out, too.
template <class Real>
void TimeStep<Real>::archive(Archive& state) {
  double helpers = helper_seconds();
  state(state_.position, state_.previous, state_.velocity, state_.position_remainder,
        state_.velocity_remainder, substeps_done_, cut_substeps_, helpers);
  if (state.reads()) earlier_helper_seconds_ = helpers - workers_.helper_seconds();
  std::vector<PassStatistics> passes = statistics_;
  state(passes);
  for (PassStatistics& pass : statistics_)  // passes with equal names keep their order
    if (const auto saved = std::ranges::find(passes, pass.name, &PassStatistics::name); saved != passes.end())
      pass = *saved, passes.erase(saved);
  for (const auto& archive : effect_archives_) archive(state);
  if (strain_schedule_.is_given() || bending_schedule_.is_given()) {
    state(factors_);
    if (state.reads()) scale_stiffness(factors_);
  }
  if (yields_)
    for_each_kind(constraints_.elements, [&](auto& batch) {
      for (auto& values : batch.rest) state(values);
      state(batch.yield);
    });
}

template <class Real>
void TimeStep<Real>::run(const Passes& passes, PassContext<Real>& context) {
  for (const PlannedPass<Real>& pass : passes) {
    const auto start = std::chrono::steady_clock::now();
    context.acted = 0;
    pass.run(context);
    PassStatistics& statistics = statistics_[pass.statistics];
    statistics.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (pass.counts) ++statistics.calls;
    statistics.acted += context.acted;
  }
}

// A NaN is out of bounds, because every comparison with a NaN is false.
template <class Real>
void TimeStep<Real>::find_divergence() {
  if (divergence_.vertex >= 0) return;
  bool inside = true;
  for (int v = 0; v < state_.vertex_count; ++v)
    inside &= within_bound(state_.position[static_cast<std::size_t>(v)]);
  if (inside) return;
  double farthest = -1;
  for (std::size_t vertex = 0; vertex < static_cast<std::size_t>(state_.vertex_count); ++vertex) {
    const Vector3 position = state_.position[permuted(vertex)].vector().template cast<double>();
    const double distance = position.allFinite() ? position.norm() : std::numeric_limits<double>::infinity();
    if (!(distance > farthest)) continue;
    farthest = distance;
    divergence_.vertex = static_cast<int>(vertex);
    divergence_.position = position + state_.origin;
  }
  name_worst_triangle();
}

template <class Real>
void TimeStep<Real>::name_worst_triangle() {
  const StrainBatch<Real>& batch = constraints_.strain;
  std::vector<int> vertex_at(static_cast<std::size_t>(state_.vertex_count));
  for (std::size_t v = 0; v < vertex_at.size(); ++v) vertex_at[permuted(v)] = static_cast<int>(v);
  double worst = 0;
  const std::vector<int> triangles = batch.order.constraint_of_lane();
  for (std::size_t lane = 0; lane < triangles.size(); ++lane) {
    if (triangles[lane] < 0) continue;
    const std::array<int, 3> offset = {batch.a[lane], batch.b[lane], batch.c[lane]};
    const auto at = [&](std::size_t c) -> Vector3 {
      return point_at(state_.position.data(), offset[c]).vector().template cast<double>();
    };
    const Vector3 e1 = at(1) - at(0), e2 = at(2) - at(0);
    Eigen::Matrix<double, 3, 2> f;
    f.col(0) = e1 * batch.q00[lane] + e2 * batch.q10[lane];
    f.col(1) = e1 * batch.q01[lane] + e2 * batch.q11[lane];
    const Eigen::Matrix2d s = f.transpose() * f;
    const double half = 0.5 * (s(0, 0) + s(1, 1)), away = std::hypot(0.5 * (s(0, 0) - s(1, 1)), s(0, 1));
    const double largest = std::sqrt(half + away);
    if (largest <= worst) continue;  // false for a NaN
    for (std::size_t c = 0; c < 3; ++c)
      divergence_.triangle[c] = vertex_at[static_cast<std::size_t>(offset[c] / offset_of(1))];
    divergence_.stretch = largest;
    if (!std::isfinite(largest)) return;
    worst = largest;
  }
}

template <class Real>
bool TimeStep<Real>::within_bound(const Point<Real>& p) const {
  return (std::abs(p.x) < bound_) & (std::abs(p.y) < bound_) & (std::abs(p.z) < bound_);
}

template <class Real>
Positions TimeStep<Real>::to_rows(const Points<Real>& points, const Points<Real>& remainders,
                                  const Vector3& origin) const {
  Positions rows(state_.vertex_count, 3);
  for (int v = 0; v < state_.vertex_count; ++v) {
    const std::size_t slot = permuted(static_cast<std::size_t>(v));
    Vector3 whole = points[slot].vector().template cast<double>();
    if (!remainders.empty()) whole += remainders[slot].vector().template cast<double>();
    rows.row(v) = (whole + origin).transpose();
  }
  return rows;
}

template class TimeStep<float>;
template class TimeStep<double>;

}  // namespace bendlab
