// One function for each kind of warning. The function returns the text of the warning, or nothing.
// warnings.cpp lists these functions in order.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "bendlab/effects/effect.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/run/warning.hpp"

namespace bendlab {

using Message = std::optional<WarningText>;

/// Whether the config states or sweeps the setting `pointer`, or sweeps an object that contains the setting.
bool is_chosen(const WarningInput& input, const std::string& pointer);

// Warnings about the config, in setting_warnings.cpp.
Message inert_seed(const WarningInput& input);
Message inert_stiffness(const WarningInput& input);
Message inert_setting(const WarningInput& input);
Message replaced_setting(const WarningInput& input);

// Warnings about the scene, in scene_warnings.cpp.
Message piece_without_pin(const WarningInput& input);
Message effect_without_pins(const WarningInput& input);
Message friction_without_obstacle(const WarningInput& input);
Message mixed_sides(const WarningInput& input);
Message doubtful_effect(const WarningInput& input);
Message starts_inside(const WarningInput& input);
Message far_vertex(const WarningInput& input);
Message all_pinned(const WarningInput& input);
Message other_extent(const WarningInput& input);
Message no_symmetry_plane(const WarningInput& input);
Message units(const WarningInput& input);
Message fabric_without_friction(const WarningInput& input);

// Warnings about the solver, in solver_warnings.cpp.
Message unconverged(const WarningInput& input);
Message membrane_courant(const WarningInput& input);
Message tethers_for_membrane(const WarningInput& input);
Message vbd_reach(const WarningInput& input);
Message k_overshoot(const WarningInput& input);
Message single_precision(const WarningInput& input);
Message weaker_push(const WarningInput& input);
Message soft_solver(const WarningInput& input);
Message softened_membrane(const WarningInput& input);
Message lagging(const WarningInput& input);
Message no_equilibrium(const WarningInput& input);

// Warnings about a stiffness that differs from the stated stiffness, in stiffness_warnings.cpp.
Message strip_out_of_range(const WarningInput& input);
Message doubtful_stiffness(const WarningInput& input);
Message uneven_stiffness(const WarningInput& input);
Message other_poisson_ratio(const WarningInput& input);
Message pushed_membrane(const WarningInput& input);

inline bool has_obstacle(const BuiltScene& scene) {
  return std::ranges::any_of(scene.effects, [](const Effect& effect) { return effect.kind().is_obstacle(); });
}

}  // namespace bendlab
