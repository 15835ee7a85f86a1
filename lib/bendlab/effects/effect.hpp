// The interface of an effect. A scene lists its effects by name, and the step plan is compiled from that
// list. An effect that is not listed has no pass and no buffer, and takes no time. A new effect is one file,
// one line in effects.def and one test.
#pragma once

#include <span>
#include <string_view>

#include "bendlab/constraints/state.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/parameters/parameter.hpp"

namespace bendlab {

/// What an effect gets from its scene.
struct EffectInput {
  const ParameterValues& parameters;  ///< the effect's own table, defaults filled in
  const RestMesh& rest;
  const Pins& pins;
  std::span<const int> permutation;  ///< #V, the index of each vertex in State's arrays; empty: its own

  bool contacts_used = false;  ///< an effect or the method uses them: obstacles fill State::contacts

  std::size_t permuted(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return permutation.empty() ? v : static_cast<std::size_t>(permutation[v]);
  }
};

struct Effect {
  std::string_view name;
  std::string_view summary;
  std::string_view source;  ///< paper and equation
  std::span<const Parameter> parameters;
  /// Its passes act on projected constraints or between projections: only for solver methods that project.
  bool needs_projection = false;
  bool helps_projection = false;  ///< needs it, and has no other purpose: in other methods it does nothing
  bool uses_contacts = false;     ///< reads State::contacts, at Stage::contact
  bool is_obstacle = false;       ///< a body that cloth may lie on
  bool repeatable = false;        ///< a scene may list it more than once
  /// Its force depends on velocities: it acts first, on those that the last substep ended with, wherever the
  /// scene lists it. Behind gravity it would see a speed g h of cloth that rests.
  bool acts_first = false;
  double vertex_seconds = 3e-9;   ///< of CPU, of a vertex and substep, about
  /// The effect's passes for one scene, for each precision.
  std::vector<Pass<float>> (*compile_float)(const EffectInput&);
  std::vector<Pass<double>> (*compile_double)(const EffectInput&);

  /// Whether the effect provably changes nothing with these settings, for any motion of the cloth; null:
  /// never known.
  bool (*idle)(const ParameterValues&) = nullptr;

  template <class Real>
  std::vector<Pass<Real>> compile(const EffectInput& input) const {
    if constexpr (std::is_same_v<Real, float>)
      return compile_float(input);
    else
      return compile_double(input);
  }
};

/// Every registered effect, in the order of effects.def.
std::span<const Effect* const> effects();

/// The effect of that name, or nullptr.
const Effect* find_effect(std::string_view name);

}  // namespace bendlab
