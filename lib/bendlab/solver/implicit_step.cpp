#include "bendlab/solver/implicit_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "bendlab/constraints/batches.hpp"
#include "bendlab/parameters/names.hpp"
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
        "{}: every stiffness has to be a compliance above 0: only that has an energy", input.method->name));
}

}  // namespace

template <class Real>
ImplicitStep<Real>::ImplicitStep(const SimulationInput& input, std::vector<int> permutation)
    : TimeStep<Real>(input, std::move(permutation)), constraint_count_(count_constraints(input)) {
  require_energy(input);
  const ParameterValues own = own_settings(input);
  integrator_ = named<Integrator>(own.text("integrator"), integrator_names);
  tolerance_ = own.number("tolerance") * input.size;
  base_ = target_ = velocity_ = earlier_velocity_ = state_.position;
  for (std::size_t v = 0; v < static_cast<std::size_t>(state_.vertex_count); ++v)
    has_unknowns_ |= state_.position[v].w > 0;
}

template <class Real>
void ImplicitStep<Real>::compile_plan(std::vector<Pass<Real>> effect_passes, double per_weight,
                                      double least) {
  contact_per_weight_ = static_cast<Real>(per_weight), contact_least_ = static_cast<Real>(least);
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
  this->append_effects(contact_, effect_passes, Stage::project);
  this->append_effects(contact_, effect_passes, Stage::contact);
  if (contact_.empty()) return;
  contact_.front().run = [this, run = std::move(contact_.front().run)](PassContext<Real>& c) {
    whole_ = state_.position;
    run(c);
  };
  iteration_ = contact_;
  contact_force_.resize(state_.position.size());
  iteration_.back().run = [this, run = std::move(iteration_.back().run)](PassContext<Real>& c) {
    run(c);
    take_contacts();
  };
}

template <class Real>
void ImplicitStep<Real>::take_contacts() {
  std::swap(state_.position, whole_);
  if (is_first_) touched_.assign(weight_.size(), 0);
  for (std::size_t v = 0; v < weight_.size(); ++v) {
    const Vector3Of<Real> push = whole_[v].vector() - state_.position[v].vector();
    contact_force_[v].set(weight_[v] > 0 ? contact_stiffness(v) * push : Vector3Of<Real>::Zero().eval());
    touched_[v] |= contact_force_[v].vector().squaredNorm() > 0;
  }
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
  for (int i = 0; i < settings_.iterations; ++i) {
    is_first_ = i == 0;
    this->run(iteration_, context);
    if (static_cast<double>(last_move_) <= tolerance_) break;
  }
  this->run(contact_, context);
  this->run(after_, context);
}

template <class Real>
void ImplicitStep<Real>::remember_velocities() {
  std::swap(velocity_, earlier_velocity_);
  std::copy(state_.velocity.begin(), state_.velocity.end(), velocity_.begin());
}

template <class Real>
double ImplicitStep<Real>::lasting_gamma() const {
  const double h = settings_.dt / settings_.substeps;
  return integrator_ == Integrator::bdf2 ? 2 * h / 3 : h;
}

template <class Real>
std::vector<Real> ImplicitStep<Real>::weights_for(double gamma) const {
  std::vector<Real> weights(static_cast<std::size_t>(state_.vertex_count));
  for (std::size_t v = 0; v < weights.size(); ++v)
    if (state_.position[v].w > 0)
      weights[v] =
          static_cast<Real>((state_.mass[v] + (drag_.empty() ? 0 : drag_[v] * gamma)) / (gamma * gamma));
  return weights;
}

template <class Real>
void ImplicitStep<Real>::aim(Real h) {
  const bool second_order = has_history_ && integrator_ == Integrator::bdf2;
  const double gamma = second_order ? 2 * static_cast<double>(h) / 3 : static_cast<double>(h);
  if (gamma != gamma_) gamma_ = gamma, weight_ = weights_for(gamma);
  total_force_ = 0;
  for (std::size_t v = 0; v < static_cast<std::size_t>(state_.vertex_count); ++v)
    if (state_.position[v].w > 0)
      total_force_ += state_.mass[v] / static_cast<double>(h) *
                      static_cast<double>((state_.velocity[v].vector() - velocity_[v].vector()).norm());
  const auto g = static_cast<Real>(gamma), share = second_order ? Real(1) / 3 : Real(0);
  this->for_vertices([&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
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
// throw the cloth back. So there the velocity is that of the substep alone, and the one before counts as the
// same.
template <class Real>
void ImplicitStep<Real>::update() {
  const auto per_gamma = static_cast<Real>(1 / gamma_),
             per_h = static_cast<Real>(settings_.substeps / settings_.dt);
  this->for_vertices([&](std::size_t first, std::size_t last) {
    for (std::size_t v = first; v < last; ++v) {
      state_.velocity[v].set(per_gamma * (state_.position[v].vector() - base_[v].vector()));
      if (!has_contacts() || !touched_[v]) continue;
      state_.velocity[v].set(per_h * (state_.position[v].vector() - state_.previous[v].vector()));
      velocity_[v].set(state_.velocity[v].vector());
    }
  });
  has_history_ = true;
  this->find_divergence();
}

template <class Real>
std::size_t ImplicitStep<Real>::memory_bytes() const {
  return TimeStep<Real>::memory_bytes() + bytes_of(drag_) + bytes_of(weight_) + bytes_of(target_) +
         bytes_of(base_) + bytes_of(velocity_) + bytes_of(earlier_velocity_) + bytes_of(whole_) +
         bytes_of(contact_force_) + bytes_of(touched_);
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
  double whole = 0;
  for (std::size_t v = 0; v < weight_.size(); ++v) {
    const auto weight = static_cast<double>(weight_[v]);
    whole += weight;
    unbalanced += weight * (state_.position[v].vector() - target_[v].vector()).template cast<double>();
    if (!has_contacts()) continue;
    const Vector3Of<Real> push = contact_force_[v].vector();
    unbalanced -= push.template cast<double>();
    if (push.squaredNorm() > 0) whole += static_cast<double>(contact_stiffness(v));
  }
  const Vector3Of<Real> move = (unbalanced / whole).template cast<Real>();
  for (auto& p : state_.position) p.set(p.vector() - move);
}

template <class Real>
void ImplicitStep<Real>::start_lower(const ElasticSystem& system) {
  double inertia = 0;  // there, minus at the guess
  for (std::size_t v = 0; v < weight_.size(); ++v)
    inertia += 0.5 * static_cast<double>(
                         weight_[v] * ((state_.previous[v].vector() - target_[v].vector()).squaredNorm() -
                                       (state_.position[v].vector() - target_[v].vector()).squaredNorm()));
  Points<Real> last = state_.position;
  for (std::size_t v = 0; v < weight_.size(); ++v)
    if (weight_[v] > 0) last[v].set(state_.previous[v].vector());
  if (inertia + system.energy(in_world(last)) < system.energy(in_world(state_.position)))
    state_.position = std::move(last);
}

template <class Real>
std::optional<double> ImplicitStep<Real>::step_residual() const {
  if (!(total_force_ > 0)) return std::nullopt;
  const Points<Real>& reached = has_contacts() ? whole_ : state_.position;  // before contacts took it back
  const Points<Real> elastic = elastic_forces(reached);
  double left = 0;
  for (std::size_t v = 0; v < weight_.size(); ++v) {
    if (!(weight_[v] > 0) || (has_contacts() && touched_[v])) continue;
    const Vector3Of<Real> inertia = weight_[v] * (target_[v].vector() - reached[v].vector());
    left += static_cast<double>((elastic[v].vector() + inertia).norm());
  }
  return left / total_force_;
}

template <class Real>
void ImplicitStep<Real>::archive(Archive& state) {
  TimeStep<Real>::archive(state);
  state(velocity_, has_history_, iterations_done_);
}

template class ImplicitStep<float>;
template class ImplicitStep<double>;

}  // namespace bendlab
