// Which JSON pointers name a setting of a config.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/scene/pointers.hpp"
#include "bendlab/settings/field.hpp"

namespace bendlab {

/// Every pointer that a sweep may vary: settings, sections, /effects, the entries of this list, and their
/// settings.
std::vector<std::string> known_pointers(const Json& settings);

/// Every value of an object and of the objects inside it, by pointer. Lists are not split.
std::map<std::string, Json> flattened(const Json& object, const std::string& pointer = "");

/// The table row of the setting at `pointer`, or nullptr if there is no such setting. `settings` gives the
/// types of the effects.
const Field* find_setting(const Json& settings, std::string_view pointer);

/// "there is no setting '/mesh/cels'; did you mean …?"
std::string unknown_pointer_text(std::string_view pointer, const std::vector<std::string>& known);

}  // namespace bendlab
