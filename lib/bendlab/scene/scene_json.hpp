// Reads a scene from JSON, and writes it as JSON.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bendlab/scene/scene.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Reads a scene from the config `given`; settings not in the config get their defaults. Ignores the keys
/// `other_keys` of the top level, which the caller reads. Appends all problems, including settings that
/// contradict each other. If there is a problem, the returned scene must not be used.
Scene read_scene(const Json& given, std::span<const std::string_view> other_keys, ConfigProblems& problems);

/// The settings of the scene, in a fixed order (canonical settings). Leaves out unread settings, and settings
/// that belong to models and methods that are not chosen, so scenes with equal physics give equal JSON.
/// read_scene() of this JSON gives an equal scene.
Json to_json(const Scene& scene);

/// The list of effects; an effect is {"type": name, …} with the settings of the effect.
Json effects_json(const Scene& scene);

/// The effects of a config without /effects: gravity and, unless /defaults is "paper", the drag of air.
Json default_effects(const Json& given);

}  // namespace bendlab
