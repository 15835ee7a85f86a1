// Runs the passes of an effect without a solver, on a state that a test makes.
#pragma once

#include <initializer_list>
#include <utility>

#include "tests/support.hpp"

namespace bendlab::test {

/// The passes of an effect with some settings changed from their defaults.
template <class Real>
std::vector<Pass<Real>> passes_of(std::string_view name, const RestMesh& rest, const Pins& pins,
                                  const Changes& settings = {}) {
  const Effect effect = effect_of(name, settings);
  return bendlab::passes_of<Real>(effect, {rest, pins, {}, effect.kind().uses_contacts});
}

/// A cloth at rest in its rest shape, with 0.2 kg/m².
template <class Real>
State<Real> state_of(const RestMesh& rest, const Pins& pins) {
  State<Real> state;
  const auto count = static_cast<std::size_t>(rest.vertex_count());
  state.vertex_count = rest.vertex_count();
  state.mass = lumped_masses(rest, 0.2);
  state.position.resize(count + dummy_points), state.velocity.resize(count + dummy_points);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    Point<Real>& p = state.position[static_cast<std::size_t>(v)];
    p.set(rest.position(v).template cast<Real>());
    p.w = pins.pinned(v) ? Real(0) : static_cast<Real>(1 / state.mass[static_cast<std::size_t>(v)]);
  }
  state.previous = state.position;
  return state;
}

/// Runs the passes once, and returns how often they acted by their own count.
template <class Real>
std::uint64_t run(std::vector<Pass<Real>>& passes, State<Real>& state, double substep, double time = 0) {
  const Constraints<Real> none;
  PassContext<Real> context{state, none, static_cast<Real>(substep), time};
  for (Pass<Real>& pass : passes) pass.run(context);
  return context.acted;
}

/// ½ Σ m |v - air|² of all vertices, J.
template <class Real>
double kinetic_energy(const State<Real>& state, const Vector3& air = Vector3::Zero()) {
  double energy = 0;
  for (std::size_t v = 0; v < state.mass.size(); ++v)
    energy += 0.5 * state.mass[v] * (state.velocity[v].vector().template cast<double>() - air).squaredNorm();
  return energy;
}

/// Σ m x of points: the momentum, kg m/s, if they are velocities.
template <class Real>
Vector3 weighted_sum(const State<Real>& state, const Points<Real>& points) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t v = 0; v < state.mass.size(); ++v)
    sum += state.mass[v] * points[v].vector().template cast<double>();
  return sum;
}

}  // namespace bendlab::test
