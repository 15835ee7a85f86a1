// Defaults that depend on other settings of the config.
#pragma once

#include <array>
#include <string_view>

#include "experiments/config/strict_json.hpp"

namespace bendlab {

/// Choices of /defaults. "recommended": the settings of configs/recommended.json, which are also the defaults
/// of the tables. "fast": implicit steps of few iterations. "reference": converged implicit steps. "paper":
/// those with which the paper is repeated.
inline constexpr std::array<std::string_view, 4> defaults_names = {"recommended", "fast", "reference",
                                                                   "paper"};

inline constexpr const char* default_bending_model = "discrete_shells";

/// B of a light cotton, N m: at 0.2 kg/m² its bending length (B/ρg)^⅓ is 17 mm; strips of shirt fabrics have
/// 15 to 25 mm by ASTM D1388.
inline constexpr double default_flexural_rigidity = 1e-5;

/// Of a membrane, N/m: a thin cotton has about this when it is pulled along its threads.
inline constexpr double default_membrane_stiffness = 1e4;

/// Curvature of a fold of 5 cm radius, 1/m: where springs, which have no one rigidity, get the stated one.
inline constexpr double default_at_curvature = 20;

/// Of viscous_drag, N s/m³: a sheet of 0.2 kg/m² falls flat at 2 m/s at most. (By the square law of air,
/// ½ · 1.2 kg/m³ · 1.28 v², it is 1.6 m/s.)
inline constexpr double default_drag_coefficient = 1;

/// The effects of a config that lists none: gravity, and but for the paper's the drag of air.
Json default_effects(const Json& settings);

/// The settings with those added whose default depends on others: what /defaults chooses, how bending is
/// stiff, the stated rigidity, and effects. What is given stays as it is. A problem if it is unclear which of
/// two stiffnesses is meant.
Json with_defaults(const Json& settings, ConfigProblems& problems);

}  // namespace bendlab
