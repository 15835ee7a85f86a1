// The interface of an effect: something a scene lists by name and the step plan is compiled from. An effect
// that is not listed has no pass, no buffer and no time. A new effect is one file, one line in effects.def,
// one test.
#pragma once

#include <span>
#include <string_view>

#include "bendlab/constraints/state.hpp"
#include "bendlab/parameters/parameter.hpp"

namespace bendlab {

struct Effect {
  std::string_view name;
  std::string_view summary;
  std::string_view source;  ///< paper and equation
  std::span<const Parameter> parameters;
  /// Its passes act on the scene's constraints, which only solver methods that project constraints have.
  bool acts_on_constraints = false;
  /// The effect's passes for one scene, for each precision.
  std::vector<Pass<float>> (*compile_float)(const ParameterValues&);
  std::vector<Pass<double>> (*compile_double)(const ParameterValues&);

  template <class Real>
  std::vector<Pass<Real>> compile(const ParameterValues& values) const {
    if constexpr (std::is_same_v<Real, float>)
      return compile_float(values);
    else
      return compile_double(values);
  }
};

/// Every registered effect, in the order of effects.def.
std::span<const Effect* const> effects();

/// The effect of that name, or nullptr.
const Effect* find_effect(std::string_view name);

}  // namespace bendlab
