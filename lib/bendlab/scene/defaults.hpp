// The defaults of a config: the scene from which it starts.
#pragma once

#include <array>
#include <string_view>

#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Choices of /defaults. "recommended": the settings of Scene{}, measured in configs/recommended.json; for a
/// config that states a setting which only projections read (k, for example), projections with coarse levels.
/// "fast": implicit steps with few iterations. "reference": converged implicit steps. "paper": settings that
/// repeat the paper.
inline constexpr std::array<std::string_view, 4> defaults_names = {"recommended", "fast", "reference",
                                                                   "paper"};

/// The scene that the config `given` starts from; the caller then applies the settings that the config
/// states. Appends a problem if it is unclear which of two stiffnesses the config means. Does not look for
/// other mistakes in `given`.
Scene scene_before(const Json& given, ConfigProblems& problems);

}  // namespace bendlab
