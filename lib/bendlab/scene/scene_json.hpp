// A scene from JSON, and as JSON.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Reads what a config states on top of its defaults. `other_keys` of the top level are the caller's. Appends
/// everything that is wrong, what does not go together included; then the scene is meaningless.
Scene read_scene(const Json& given, std::span<const std::string_view> other_keys, ConfigProblems& problems);

/// The scene's settings in canonical order: only those that are read, only the chosen model's and method's
/// own. Equal physics gives equal JSON. read_scene() of it gives the same scene.
Json to_json(const Scene& scene);

/// The list of effects: {"type": name, settings} each.
Json effects_json(const Scene& scene);

/// The effects of a config that lists none: gravity, and but for the paper's the drag of air.
Json default_effects(const Json& given);

}  // namespace bendlab
