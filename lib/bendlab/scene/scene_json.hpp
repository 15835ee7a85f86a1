// Reads a scene from JSON, and writes it as JSON.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Reads a config: the settings that it states replace its defaults. Ignores `other_keys` of the top level,
/// which the caller reads. Appends everything that is wrong, including settings that contradict each other;
/// if there is a problem, the scene is meaningless.
Scene read_scene(const Json& given, std::span<const std::string_view> other_keys, ConfigProblems& problems);

/// The scene's settings in canonical order. Unread settings, and own settings of models and methods that are
/// not chosen, are left out. Equal physics gives equal JSON. read_scene() of this JSON gives the same scene.
Json to_json(const Scene& scene);

/// The list of effects, each as {"type": name, settings}.
Json effects_json(const Scene& scene);

/// The effects of a config without a list of effects: gravity and, except with the paper's defaults, the drag
/// of air.
Json default_effects(const Json& given);

}  // namespace bendlab
