// JSON pointers: finding and setting the value at a pointer.
#pragma once

#include <string>
#include <string_view>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Whether `pointer` is `container` or points to something inside it.
bool lies_within(std::string_view pointer, std::string_view container);

/// The value at `pointer`, or nullptr if there is no value.
const Json* value_at(const Json& document, const std::string& pointer);

/// Sets the value at `pointer`, and creates missing objects on the way. Returns false, and sets no value, if
/// the pointer leads through a value that is neither an object nor a list, or past the end of a list.
bool set_at(Json& document, const std::string& pointer, Json value);

}  // namespace bendlab
