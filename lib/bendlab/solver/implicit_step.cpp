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
  return input.strain.size() + input.distance.size() + element_count(input.elements);
}

void require_energy(const SimulationInput& input) {
  const auto has_energy = [](const auto& s) {
    return s.kind == StiffnessKind::compliance && s.compliance > 0;
  };
  const bool bends = input.distance.size() + element_count(input.elements) > 0;
  if ((input.strain.size() > 0 && !has_energy(input.strain_stiffness)) ||
      (bends && !has_energy(input.bending_stiffness)))
    throw std::invalid_argument(fmt::format(
        "{}: every stiffness has to be a compliance above 0: only that has an energy", input.method.name()));
}

}  // namespace

template <class Real>
ImplicitStep<Real>::ImplicitStep(const SimulationInput& input, Integrator integrator, double tolerance,
                                 std::vector<int> permutation)
    : TimeStep<Real>(input, std::move(permutation)),
      integrator_(integrator),
      tolerance_(tolerance * input.size),
      size_(input.size),
      constraint_count_(count_constraints(input)) {
  require_energy(input);
  base_ = target_ = velocity_ = earlier_velocity_ = state_.position;
  for (std::size_t v = 0; v < static_cast<std::size_t>(state_.vertex_count); ++v)
    has_unknowns_ |= state_.position[v].w > 0;
}

template <class Real>
void ImplicitStep<Real>::compile_plan(std::vector<Pass<Real>> effect_passes, double per_weight, double mean) {
  double mass = 0, free = 0;
  for (std::size_t v = 0; v < static_cast<std::size_t>(state_.vertex_count); ++v)
    if (state_.position[v].w > 0) mass += state_.mass[v], ++free;
  contacts_ = ContactForces<Real>(per_weight, mass > 0 ? mean * free / mass : 0);
  const auto add = [&](Passes& passes, const char* name, auto action) {
    passes.push_back({[this, action](PassContext<Real>& c) { action(c); }, this->add_statistics(name)});
  };
  for (Pass<Real>& pass : effect_passes) take_drag_over(pass);
  add(before_, "start", [this](auto&) { remember_velocities(); });
  this->append_effects(before_, effect_passes, Stage::force);
  this->append_effects(before_, effect_passes, Stage::damp);
  add(before_, "target", [this](auto& c) { aim(c.substep); });
  this->append_effects(before_, effect_passes, Stage::predicted);
  if (preparation_.action)
    add(before_, preparation_.name, [this](auto&) {
      if (has_unknowns_) preparation_.action();
    });
  add_contact_passes(effect_passes);
  add(iteration_, "iterate", [this](auto&) {
    last_move_ = has_unknowns_ ? iterate() : Real(0);
    ++iterations_done_;
  });
  add(after_, "update", [this](auto&) { update(); });
  this->append_effects(after_, effect_passes, Stage::velocity);
}

// The passes change the positions; what they changed becomes a force, and the positions are as before.
template <class Real>
void ImplicitStep<Real>::add_contact_passes(std::vector<Pass<Real>>& effect_passes) {
  std::vector<Pass<Real>> gripping;
  std::erase_if(effect_passes, [&](Pass<Real>& pass) {
    if (!pass.friction) return false;
    const FrictionCoefficients friction = *pass.friction;
    pass.run = [this, friction](PassContext<Real>& c) {
      c.acted += contacts_.grip(state_, friction, is_late_);
    };
    gripping.push_back(std::move(pass));
    return true;
  });
  this->append_effects(contact_, effect_passes, Stage::project);
  this->append_effects(contact_, effect_passes, Stage::contact);
  iteration_ = contact_;
  this->append_effects(iteration_, gripping, Stage::contact);
  if (contact_.empty()) return;
  contacts_.resize(state_.position.size());
  contact_.front().run = [this, run = std::move(contact_.front().run)](PassContext<Real>& c) {
    contacts_.remember(state_);
    run(c);
  };
  iteration_.front().run = contact_.front().run;
  auto& last = iteration_[contact_.size() - 1].run;
  last = [this, run = std::move(last)](PassContext<Real>& c) {
    run(c);
    contacts_.push(state_, weight_, is_first_);
  };
}

// Drag that is linear in the velocity becomes part of the equations, so that no step is too long for it.
template <class Real>
void ImplicitStep<Real>::take_drag_over(Pass<Real>& pass) {
  if (pass.drag.empty()) return;
  drag_.resize(pass.drag.size());
  for (std::size_t v = 0; v < drag_.size(); ++v) drag_[v] += pass.drag[v];
  pass.run = [count = pass.drag.size()](PassContext<Real>& context) { context.acted += count; };
}

template <class Real>
void ImplicitStep<Real>::substep(PassContext<Real>& context) {
  this->run(before_, context);
  has_stepped_ = true;
  for (int i = 0; i < settings_.iterations || (must_go_on() && i < most_iterations()); ++i) {
    is_first_ = i == 0, is_late_ = 2 * i >= settings_.iterations;
    this->run(iteration_, context);
    if (static_cast<double>(last_move_) <= tolerance_ && contacts_.decided()) break;
  }
  this->run(contact_, context);
  if (has_contacts()) contacts_.hold(state_);
  this->run(after_, context);
}

template <class Real>
void ImplicitStep<Real>::remember_velocities() {
  std::swap(velocity_, earlier_velocity_);
  std::copy(state_.velocity.begin(), state_.velocity.end(), velocity_.begin());
}

template <class Real>
Real ImplicitStep<Real>::weight_for(std::size_t v, double gamma) const {
  if (!(state_.position[v].w > 0)) return 0;
  return static_cast<Real>((state_.mass[v] + (drag_.empty() ? 0 : drag_[v] * gamma)) / (gamma * gamma));
}

template <class Real>
std::vector<Real> ImplicitStep<Real>::lasting_weights() const {
  const double h = settings_.dt / settings_.substeps;
  std::vector<Real> weights(static_cast<std::size_t>(state_.vertex_count));
  for (std::size_t v = 0; v < weights.size(); ++v)
    weights[v] = weight_for(v, integrator_ == Integrator::bdf2 ? 2 * h / 3 : h);
  return weights;
}

template <class Real>
void ImplicitStep<Real>::aim(Real h) {
  const auto count = static_cast<std::size_t>(state_.vertex_count);
  gamma_.resize(count, 0), weight_.resize(count, 0);
  weights_changed_ = false;
  total_force_ = 0;
  for (std::size_t v = 0; v < count; ++v) {
    const bool second_order =
        has_history_ && integrator_ == Integrator::bdf2 && !(has_contacts() && contacts_.touched(v));
    const Real gamma = second_order ? 2 * h / 3 : h;
    if (gamma != gamma_[v])
      gamma_[v] = gamma, weight_[v] = weight_for(v, static_cast<double>(gamma)), weights_changed_ = true;
    if (state_.position[v].w > 0)
      total_force_ += state_.mass[v] / static_cast<double>(h) *
                      static_cast<double>((state_.velocity[v].vector() - velocity_[v].vector()).norm());
  }
  this->for_vertices([&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      const Real g = gamma_[v], share = g < h ? Real(1) / 3 : Real(0);
      const Vector3Of<Real> x = state_.position[v].vector(), start = velocity_[v].vector(),
                            acceleration = (state_.velocity[v].vector() - start) / h,
                            base = x + share * (x - state_.previous[v].vector()),
                            velocity = start + share * (start - earlier_velocity_[v].vector());
      const Real drag = drag_.empty() ? Real(0) : static_cast<Real>(drag_[v]) * state_.position[v].w;
      state_.previous[v] = state_.position[v];
      base_[v].set(base);
      target_[v].set(base + g / (1 + drag * g) * (velocity + g * acceleration));
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

// Where a contact pushed, motion has a kink, which no formula of second order may reach across: it would
// throw the cloth back. So there the velocity along the normal, and all of it where friction holds, is that
// of the substep alone. BDF2's steps are q += h f / m with q = 3/2 v - 1/2 v_-1, those of backward Euler
// v += h f / m. So that the cloth's own forces keep its momentum, v becomes q where the first ends, and v_-1
// becomes v where the second does.
template <class Real>
void ImplicitStep<Real>::update() {
  const auto h = static_cast<Real>(settings_.dt / settings_.substeps);
  this->for_vertices([&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      state_.velocity[v].set((state_.position[v].vector() - base_[v].vector()) / gamma_[v]);
      const bool touched = has_contacts() && contacts_.touched(v),
                 second_order = gamma_[v] < Real(0.8) * h;  // 2/3 or 1
      if (touched && second_order) {
        const Vector3Of<Real> own = (state_.position[v].vector() - state_.previous[v].vector()) / h,
                              q = Real(1.5) * state_.velocity[v].vector() - Real(0.5) * velocity_[v].vector();
        state_.velocity[v].set(contacts_.velocity(v, own, q));
      }
      if (touched || (has_contacts() && has_history_ && !second_order)) velocity_[v] = state_.velocity[v];
    }
  });
  has_history_ = true;
  this->find_divergence();
}

template <class Real>
std::size_t ImplicitStep<Real>::memory_bytes() const {
  return TimeStep<Real>::memory_bytes() + bytes_of(drag_) + bytes_of(weight_) + bytes_of(target_) +
         bytes_of(base_) + bytes_of(velocity_) + bytes_of(earlier_velocity_) + bytes_of(gamma_) +
         contacts_.memory_bytes();
}

template <class Real>
Positions ImplicitStep<Real>::in_world(const Points<Real>& points) const {
  Positions positions(static_cast<Eigen::Index>(weight_.size()), 3);
  for (std::size_t v = 0; v < weight_.size(); ++v)
    positions.row(static_cast<Eigen::Index>(v)) =
        (points[v].vector().template cast<double>() + state_.origin).transpose();
  return positions;
}

template <class Real>
void ImplicitStep<Real>::keep_momentum() {
  if (std::ranges::any_of(weight_, [](Real w) { return !(w > 0); })) return;
  Vector3 unbalanced = Vector3::Zero();
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();
  for (std::size_t v = 0; v < weight_.size(); ++v) {
    const auto weight = static_cast<double>(weight_[v]);
    stiffness.diagonal().array() += weight;
    unbalanced += weight * (state_.position[v].vector() - target_[v].vector()).template cast<double>();
    if (!has_contacts() || !contacts_.pushes(v)) continue;
    unbalanced -= contacts_.obstacle_force_at(v, state_.position[v].vector()).template cast<double>();
    stiffness += contacts_.obstacle_stiffness(v).template cast<double>();
  }
  const Vector3Of<Real> move = stiffness.llt().solve(unbalanced).template cast<Real>();
  for (auto& p : state_.position) p.set(p.vector() - move);
}

template <class Real>
void ImplicitStep<Real>::start_lower(const ElasticSystem& system) {
  double inertia = 0;  // there, minus at the guess
  for (std::size_t v = 0; v < weight_.size(); ++v)
    inertia += 0.5 * static_cast<double>(weight_[v] *
                                         ((state_.previous[v].vector() - target_[v].vector()).squaredNorm() -
                                          (state_.position[v].vector() - target_[v].vector()).squaredNorm()));
  Points<Real> last = state_.position;
  for (std::size_t v = 0; v < weight_.size(); ++v)
    if (weight_[v] > 0) last[v].set(state_.previous[v].vector());
  if (inertia + system.energy(in_world(last)) < system.energy(in_world(state_.position)))
    state_.position = std::move(last);
}

template <class Real>
std::optional<StepResidual> ImplicitStep<Real>::step_residual() const {
  if (!has_stepped_) return std::nullopt;
  // What moves vertices by less than the tolerance, or than rounding, is no force to measure by.
  const double least = std::max(tolerance_,
                                100 * size_ * static_cast<double>(std::numeric_limits<Real>::epsilon())),
               rounded = std::accumulate(weight_.begin(), weight_.end(), 0.0) * least;  // N
  const Points<Real>& reached = has_contacts() ? contacts_.before() : state_.position;
  const Points<Real> elastic = elastic_forces(reached);
  double left = 0, inertia = 0;
  for (std::size_t v = 0; v < weight_.size(); ++v) {
    if (!(weight_[v] > 0)) continue;
    Vector3Of<Real> force = weight_[v] * (target_[v].vector() - reached[v].vector());
    inertia += static_cast<double>(force.norm());
    force += elastic[v].vector();
    if (has_contacts()) force = contacts_.along(v, force, reached[v].vector());
    left += static_cast<double>(force.norm());
  }
  const double scale = total_force_ > rounded ? total_force_ : inertia;
  if (!(scale > rounded)) return std::nullopt;
  return StepResidual{left, scale};
}

template <class Real>
void ImplicitStep<Real>::archive(Archive& state) {
  TimeStep<Real>::archive(state);
  state(velocity_, has_history_, iterations_done_, gamma_);
  contacts_.archive(state);
  if (!state.reads()) return;
  weight_.resize(gamma_.size());
  for (std::size_t v = 0; v < gamma_.size(); ++v) weight_[v] = weight_for(v, static_cast<double>(gamma_[v]));
}

template class ImplicitStep<float>;
template class ImplicitStep<double>;

}  // namespace bendlab
