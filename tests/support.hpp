// Scenes and random states that several tests share.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <random>
#include <vector>

#include "bendlab/bending/model.hpp"
#include "bendlab/bending/models.hpp"
#include "bendlab/constraints/build.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/effects/effects.hpp"
#include "bendlab/io/without_traps.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/solver/methods.hpp"

namespace bendlab::test {

inline double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

inline Vector3 random_vector(std::mt19937_64& random, double size = 1) {
  return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

inline std::vector<std::array<int, 2>> plain(const PairList& pairs) {
  return {pairs.begin(), pairs.end()};
}

/// A cloth with the springs of its bending model, at rest in its rest shape, without effects.
inline SimulationInput sheet(const RestMesh& rest, const Pins& pins, std::string_view model,
                             double density = 0.2) {
  SimulationInput input{.method = Pbd{}};
  input.positions = rest.positions();
  input.rest = rest.positions();
  input.origin = rest.centre();
  input.size = rest.size();
  input.mass = lumped_masses(rest, density);
  input.is_pinned = pins.is_pinned;
  input.strain = strain_constraints(rest, pins, inverse_rest_from_warp(rest.mesh(), Vector3::UnitX()));
  BendingConstraints constraints = constraints_of(BendingModel(*find_bending_model(model)), {rest, pins});
  input.distance = std::move(constraints.distance);
  input.elements = std::move(constraints.elements);
  input.own = std::move(constraints.own);
  input.directors = std::move(constraints.directors);
  return input;
}

/// A member of a family (such as an effect), with some settings changed from their defaults.
using Changes = std::vector<std::pair<std::string, Value>>;
template <class Kind>
Chosen<Kind> chosen(const Kind& kind, const Changes& changes) {
  std::shared_ptr<void> settings = kind.settings.copy(kind.settings.defaults());
  for (const auto& [name, value] : changes) {
    const Field* const field = kind.settings.find(name);
    if (field == nullptr) throw std::logic_error("there is no setting " + name);
    field->put(settings.get(), value);
  }
  return {kind, std::move(settings)};
}
inline Effect effect_of(std::string_view name, const Changes& changes = {}) {
  return chosen(*find_effect(name), changes);
}

/// The passes of an effect on a cloth. At most one setting is changed from its default.
template <class Real>
std::vector<Pass<Real>> effect_passes(std::string_view name, const RestMesh& rest, const Pins& pins,
                                      std::string_view setting = {}, Value value = {}) {
  const Effect effect =
      effect_of(name, setting.empty() ? Changes{} : Changes{{std::string(setting), std::move(value)}});
  return bendlab::passes_of<Real>(effect, {rest, pins, {}, effect.kind().uses_contacts});
}

/// The passes of an effect that does not depend on the cloth.
template <class Real>
std::vector<Pass<Real>> effect_passes(std::string_view name, std::string_view setting = {},
                                      Value value = {}) {
  const RestMesh any(grid(1, 1, 1, 1));
  return effect_passes<Real>(name, any, make_pins(any, {}, 0), setting, std::move(value));
}

}  // namespace bendlab::test
