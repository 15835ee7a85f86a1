// What a config gets that it does not state.
#pragma once

#include <array>
#include <string_view>

#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Choices of /defaults. "recommended": those of Scene{}, measured in configs/recommended.json; for a config
/// that states what only projections take (k, for example), projections with coarse levels. "fast": implicit
/// steps of few iterations. "reference": converged implicit steps. "paper": those with which the paper is
/// repeated.
inline constexpr std::array<std::string_view, 4> defaults_names = {"recommended", "fast", "reference",
                                                                   "paper"};

/// The scene that the config `given` starts from: what it states is then put on top. A problem if it is
/// unclear which of two stiffnesses it means. What is wrong in `given` otherwise is not looked at.
Scene scene_before(const Json& given, ConfigProblems& problems);

}  // namespace bendlab
