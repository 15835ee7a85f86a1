#include "bendlab/solver/implicit_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "bendlab/constraints/batches.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/memory.hpp"

namespace bendlab {

namespace {

std::uint64_t count_constraints(const SimulationInput& input) {
  return input.strain.size() + input.distance.size() + element_count(input.elements) + input.own.size();
}

void require_energy(const SimulationInput& input) {
  const auto has_energy = [](const auto& s) {
    return s.kind == StiffnessKind::compliance && s.compliance > 0;
  };
  const bool bends = input.distance.size() + element_count(input.elements) + input.own.size() > 0;
  if ((input.strain.size() > 0 && !has_energy(input.strain_stiffness)) ||
      (bends && !has_energy(input.bending_stiffness)))
    throw std::invalid_argument(fmt::format(
        "{}: every stiffness has to be a compliance above 0, because a stiffness given as k has no energy",
        input.method.name()));
}

}  // namespace

template <class Real>
ImplicitStep<Real>::ImplicitStep(const SimulationInput& input, Integrator integrator, double tolerance,
                                 std::vector<int> permutation)
    : TimeStep<Real>(input, std::move(permutation)),
      integrator_(integrator),
      tolerance_(tolerance * input.size),
      size_(input.size),
      clamped_(input.directors.clamped),
      constraint_count_(count_constraints(input)) {
  require_energy(input);
  data_.base = data_.target = data_.velocity = data_.earlier_velocity = state_.position;
  for (std::size_t v = 0; v < static_cast<std::size_t>(state_.point_count); ++v)
    has_unknowns_ |= state_.position[v].w > 0;
}

template <class Real>
void ImplicitStep<Real>::compile_plan(std::vector<Pass<Real>> effect_passes, double per_weight, double mean) {
  double mass = 0, free = 0;
  for (std::size_t v = 0; v < static_cast<std::size_t>(state_.vertex_count); ++v)
    if (state_.position[v].w > 0) mass += state_.mass[v], ++free;
  data_.contacts = ContactForces<Real>(per_weight, mass > 0 ? mean * free / mass : 0);
  for (Pass<Real>& pass : effect_passes) take_drag_over(pass);
  if (!data_.drag.empty()) data_.drag.resize(static_cast<std::size_t>(state_.point_count), 0);  // directors
  this->add_pass(before_, "start", [this](auto&) { remember_velocities(); });
  this->append_effects(before_, effect_passes, Stage::force);
  this->append_effects(before_, effect_passes, Stage::damp);
  this->add_pass(before_, "target", [this](auto& c) { aim(c.substep); });
  this->append_effects(before_, effect_passes, Stage::predicted);
  if (!clamped_.empty()) this->add_pass(before_, "clamps", [this](auto&) { turn_clamped_normals(); });
  if (preparation() != nullptr)
    this->add_pass(before_, preparation(), [this](auto&) {
      if (has_unknowns_) prepare();
    });
  add_contact_passes(effect_passes);
  this->add_pass(iteration_, "iterate", [this](auto&) {
    data_.last_move = has_unknowns_ ? iterate() : Real(0);
    ++iterations_done_;
  });
  this->add_pass(after_, "update", [this](auto&) { update(); });
  this->add_yield_pass(after_);
  this->append_effects(after_, effect_passes, Stage::velocity);
}

// The contact passes change positions. Each change becomes a force, and the positions are restored.
template <class Real>
void ImplicitStep<Real>::add_contact_passes(std::vector<Pass<Real>>& effect_passes) {
  std::vector<Pass<Real>> gripping;
  std::erase_if(effect_passes, [&](Pass<Real>& pass) {
    if (!pass.friction) return false;
    const FrictionCoefficients friction = *pass.friction;
    pass.run = [this, friction](PassContext<Real>& c) {
      c.acted += data_.contacts.grip(state_, friction, data_.is_late);
    };
    gripping.push_back(std::move(pass));
    return true;
  });
  this->append_effects(contact_, effect_passes, Stage::project);
  this->append_effects(contact_, effect_passes, Stage::contact);
  if (!contact_.empty()) {
    data_.contacts.resize(state_.position.size());
    contact_.insert(contact_.begin(),
                    this->part_of(contact_.front(), [this](auto&) { data_.contacts.remember(state_); }));
    iteration_.push_back(this->part_of(contact_.back(), [this](auto&) {
      data_.contacts.push(state_, data_.weight, data_.is_first_iteration);
    }));
  }
  this->append_effects(iteration_, gripping, Stage::contact);
}

// Drag that is linear in the velocity becomes part of the equations, so that even long steps are stable.
template <class Real>
void ImplicitStep<Real>::take_drag_over(Pass<Real>& pass) {
  if (pass.drag.empty()) return;
  data_.drag.resize(pass.drag.size());
  for (std::size_t v = 0; v < data_.drag.size(); ++v) data_.drag[v] += pass.drag[v];
  pass.run = [count = pass.drag.size()](PassContext<Real>& context) { context.acted += count; };
}

template <class Real>
void ImplicitStep<Real>::substep(PassContext<Real>& context) {
  this->run(before_, context);
  has_stepped_ = true;
  for (int i = 0; i < settings_.iterations || (must_go_on() && i < most_iterations()); ++i) {
    data_.is_first_iteration = i == 0, data_.is_late = 2 * i >= settings_.iterations;
    this->run(contact_, context);
    this->run(iteration_, context);
    if (static_cast<double>(data_.last_move) <= tolerance_ && data_.contacts.decided()) break;
  }
  this->run(contact_, context);
  if (data_.contacts.in_use()) data_.contacts.hold(state_);
  this->hold_axes();
  this->run(after_, context);
}

template <class Real>
void ImplicitStep<Real>::remember_velocities() {
  std::swap(data_.velocity, data_.earlier_velocity);
  std::copy(state_.velocity.begin(), state_.velocity.end(), data_.velocity.begin());
}

template <class Real>
Real ImplicitStep<Real>::weight_for(std::size_t v, double gamma) const {
  if (!(state_.position[v].w > 0)) return 0;
  return static_cast<Real>((state_.mass[v] + (data_.drag.empty() ? 0 : data_.drag[v] * gamma)) /
                           (gamma * gamma));
}

template <class Real>
std::vector<Real> ImplicitStep<Real>::lasting_weights() const {
  const double h = settings_.dt / settings_.substeps;
  std::vector<Real> weights(static_cast<std::size_t>(state_.point_count));
  for (std::size_t v = 0; v < weights.size(); ++v)
    weights[v] = weight_for(v, integrator_ == Integrator::bdf2 ? 2 * h / 3 : h);
  return weights;
}

// A clamp that moves in this substep turns its normals.
template <class Real>
void ImplicitStep<Real>::turn_clamped_normals() {
  for (const ClampedNormal& normal : clamped_) {
    const auto at = [&](std::size_t corner) {
      return this->permuted(static_cast<std::size_t>(normal.triangle[corner]));
    };
    const auto moves = [&](std::size_t v) {
      return state_.position[v].vector() != state_.previous[v].vector();
    };
    if (!moves(at(0)) && !moves(at(1)) && !moves(at(2))) continue;
    const auto place = [&](std::size_t corner) -> Vector3 {
      return state_.position[at(corner)].vector().template cast<double>();
    };
    state_.position[static_cast<std::size_t>(state_.vertex_count + normal.director)].set(
        normal.at(place(0), place(1), place(2)).template cast<Real>());
  }
}

template <class Real>
void ImplicitStep<Real>::aim(Real h) {
  const auto count = static_cast<std::size_t>(state_.point_count);
  data_.gamma.resize(count, 0), data_.weight.resize(count, 0);
  data_.weights_changed = false;
  data_.total_force = 0;
  for (std::size_t v = 0; v < count; ++v) {
    const bool second_order = data_.has_history && integrator_ == Integrator::bdf2 &&
                              !(data_.contacts.in_use() && data_.contacts.touched(v));
    const Real gamma = second_order ? 2 * h / 3 : h;
    if (gamma != data_.gamma[v]) {
      data_.gamma[v] = gamma, data_.weight[v] = weight_for(v, static_cast<double>(gamma));
      data_.weights_changed = true;
    }
    if (state_.position[v].w > 0)
      data_.total_force +=
          state_.mass[v] / static_cast<double>(h) *
          static_cast<double>((state_.velocity[v].vector() - data_.velocity[v].vector()).norm());
  }
  this->for_points([&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      const Real g = data_.gamma[v], share = g < h ? Real(1) / 3 : Real(0);
      const Vector3Of<Real> x = state_.position[v].vector(), start = data_.velocity[v].vector(),
                            acceleration = (state_.velocity[v].vector() - start) / h,
                            base = x + share * (x - state_.previous[v].vector()),
                            velocity = start + share * (start - data_.earlier_velocity[v].vector());
      const Real drag =
          data_.drag.empty() ? Real(0) : static_cast<Real>(data_.drag[v]) * state_.position[v].w;
      state_.previous[v] = state_.position[v];
      data_.base[v].set(base);
      data_.target[v].set(base + g / (1 + drag * g) * (velocity + g * acceleration));
      if (state_.position[v].w > 0) state_.position[v].set(x + h * start);
    }
  });
}

template <class Real>
bool ImplicitStep<Real>::pins_moved() const {
  for (std::size_t v = 0; v < static_cast<std::size_t>(state_.vertex_count); ++v)
    if (state_.position[v].w == 0 && state_.position[v].vector() != state_.previous[v].vector()) return true;
  return false;
}

// A push by a contact makes a kink in a vertex's motion. A second-order formula across the kink would throw
// the cloth back. So the velocity of a pushed vertex is computed from this substep alone: along the normal,
// or in all directions if friction holds the vertex. Steps of BDF2 are q += h f / m with q = 3/2 v - 1/2
// v_-1; steps of backward Euler are v += h f / m. The cloth's own forces must not change the momentum, so v
// becomes q when a vertex changes from BDF2 to backward Euler, and v_-1 becomes v when a vertex changes back.
template <class Real>
void ImplicitStep<Real>::update() {
  const auto h = static_cast<Real>(settings_.dt / settings_.substeps);
  this->for_points([&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      state_.velocity[v].set((state_.position[v].vector() - data_.base[v].vector()) / data_.gamma[v]);
      const bool touched = data_.contacts.in_use() && data_.contacts.touched(v),
                 second_order = data_.gamma[v] < Real(0.8) * h;  // γ is 2/3 h or h
      if (touched && second_order) {
        const Vector3Of<Real> own = (state_.position[v].vector() - state_.previous[v].vector()) / h,
                              q = Real(1.5) * state_.velocity[v].vector() -
                                  Real(0.5) * data_.velocity[v].vector();
        state_.velocity[v].set(data_.contacts.velocity(v, own, q));
      }
      if (touched || (data_.contacts.in_use() && data_.has_history && !second_order))
        data_.velocity[v] = state_.velocity[v];
    }
  });
  data_.has_history = true;
  this->find_divergence();
}

template <class Real>
std::size_t ImplicitStep<Real>::memory_bytes() const {
  return TimeStep<Real>::memory_bytes() + bytes_of(data_.drag) + bytes_of(data_.weight) +
         bytes_of(data_.target) + bytes_of(data_.base) + bytes_of(data_.velocity) +
         bytes_of(data_.earlier_velocity) + bytes_of(data_.gamma) + data_.contacts.memory_bytes();
}

template <class Real>
Positions ImplicitStep<Real>::in_world(const Points<Real>& points) const {
  Positions positions(static_cast<Eigen::Index>(data_.weight.size()), 3);
  for (std::size_t v = 0; v < data_.weight.size(); ++v)
    positions.row(static_cast<Eigen::Index>(v)) =
        (points[v].vector().template cast<double>() + this->origin_of(v)).transpose();
  return positions;
}

template <class Real>
void ImplicitStep<Real>::keep_momentum() {
  const auto vertices = static_cast<std::size_t>(state_.vertex_count);
  for (std::size_t v = 0; v < vertices; ++v)
    if (!(data_.weight[v] > 0)) return;
  Vector3 unbalanced = Vector3::Zero();
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  for (std::size_t v = 0; v < vertices; ++v) {
    const auto weight = static_cast<double>(data_.weight[v]);
    stiffness.diagonal().array() += weight;
    unbalanced += weight * (state_.position[v].vector() - data_.target[v].vector()).template cast<double>();
    if (!data_.contacts.in_use() || !data_.contacts.pushes(v)) continue;
    unbalanced -= data_.contacts.obstacle_force_at(v, state_.position[v].vector()).template cast<double>();
    stiffness += data_.contacts.obstacle_stiffness(v).template cast<double>();
  }
  Vector3Of<Real> move = stiffness.llt().solve(unbalanced).template cast<Real>();
  for (const auto& held : this->held_)  // a support carries the momentum along its axes
    for (int axis = 0; axis < 3; ++axis)
      if (held.axes[static_cast<std::size_t>(axis)]) move(axis) = 0;
  for (std::size_t v = 0; v < vertices; ++v) state_.position[v].set(state_.position[v].vector() - move);
}

template <class Real>
void ImplicitStep<Real>::start_lower(const ElasticSystem& system) {
  double inertia = 0;  // energy at the end of the last substep minus energy at the guess, J
  for (std::size_t v = 0; v < data_.weight.size(); ++v)
    inertia +=
        0.5 * static_cast<double>(data_.weight[v] *
                                  ((state_.previous[v].vector() - data_.target[v].vector()).squaredNorm() -
                                   (state_.position[v].vector() - data_.target[v].vector()).squaredNorm()));
  Points<Real> last = state_.position;
  for (std::size_t v = 0; v < data_.weight.size(); ++v)
    if (data_.weight[v] > 0) last[v].set(state_.previous[v].vector());
  if (inertia + system.energy(in_world(last)) < system.energy(in_world(state_.position)))
    state_.position = std::move(last);
}

template <class Real>
std::optional<StepResidual> ImplicitStep<Real>::step_residual() const {
  if (!has_stepped_) return std::nullopt;
  // No residual is computed relative to forces that move vertices by less than the tolerance or rounding.
  const double least = std::max(tolerance_,
                                100 * size_ * static_cast<double>(std::numeric_limits<Real>::epsilon())),
               rounded = std::accumulate(data_.weight.begin(), data_.weight.end(), 0.0) * least;  // N
  const Points<Real>& reached = data_.contacts.in_use() ? data_.contacts.before() : state_.position;
  const Points<Real> elastic = elastic_forces(reached);
  double left = 0, inertia = 0;
  Points<Real> forces(data_.weight.size());
  for (std::size_t v = 0; v < data_.weight.size(); ++v) {
    if (!(data_.weight[v] > 0)) continue;
    Vector3Of<Real> force = data_.weight[v] * (data_.target[v].vector() - reached[v].vector());
    inertia += static_cast<double>(force.norm());
    force += elastic[v].vector();
    if (data_.contacts.in_use()) force = data_.contacts.along(v, force, reached[v].vector());
    forces[v].set(force);
  }
  this->drop_held(forces);
  for (const Point<Real>& force : forces) left += static_cast<double>(force.vector().norm());
  const double scale = data_.total_force > rounded ? data_.total_force : inertia;
  if (!(scale > rounded)) return std::nullopt;
  return StepResidual{left, scale};
}

template <class Real>
void ImplicitStep<Real>::archive(Archive& state) {
  TimeStep<Real>::archive(state);
  state(data_.velocity, data_.has_history, iterations_done_, data_.gamma);
  data_.contacts.archive(state);
  if (!state.reads()) return;
  data_.weight.resize(data_.gamma.size());
  for (std::size_t v = 0; v < data_.gamma.size(); ++v)
    data_.weight[v] = weight_for(v, static_cast<double>(data_.gamma[v]));
}

template class ImplicitStep<float>;
template class ImplicitStep<double>;

}  // namespace bendlab
