// The default settings of a config, as a scene.
#pragma once

#include <array>
#include <string_view>

#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Values of /defaults. "recommended": the settings of Scene{}, tested in configs/recommended.json; but a
/// config with a setting that only projections read (such as k) gets projections with coarse levels. "fast":
/// implicit steps with few iterations. "reference": converged implicit steps. "paper": the settings of the
/// paper.
inline constexpr std::array<std::string_view, 4> defaults_names = {"recommended", "fast", "reference",
                                                                   "paper"};

/// The defaults for the config `given`, without the settings that the config states. Appends a problem if the
/// config states two stiffnesses without a choice. Does not look for other mistakes.
Scene scene_before(const Json& given, ConfigProblems& problems);

}  // namespace bendlab
