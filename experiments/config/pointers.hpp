// JSON pointers into a config: which ones name a setting, and how a value gets to its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bendlab/parameters/parameter.hpp"
#include "experiments/config/strict_json.hpp"

namespace bendlab {

/// Pointer to `key` of the object (or entry of the list) at `parent`, escaped.
std::string child_pointer(std::string_view parent, std::string_view key);

/// Whether `pointer` is `container` or points to something inside it.
bool lies_within(std::string_view pointer, std::string_view container);

/// The value at `pointer`, or nullptr if there is none.
const Json* value_at(const Json& document, const std::string& pointer);

/// Puts a value at `pointer`, creating objects on the way. False, and nothing changed there, if the way leads
/// through something that is no object or past the end of a list.
bool set_at(Json& document, const std::string& pointer, Json value);

/// Every pointer that a sweep may vary: settings, whole sections, `/effects`, its entries and their settings.
std::vector<std::string> known_pointers(const Json& settings);

/// The row of the setting at `pointer`, or nullptr if it is no setting. `settings` says of which type an
/// effect is.
const Parameter* find_parameter(const Json& settings, std::string_view pointer);

/// "there is no setting '/mesh/cels'; did you mean …?"
std::string unknown_pointer_text(std::string_view pointer, const std::vector<std::string>& known);

/// "; did you mean '/solver/dt'?" if a pointer in `known` ends in the same key, else "".
std::string same_key_suggestion(std::string_view key, const std::vector<std::string>& known);

}  // namespace bendlab
