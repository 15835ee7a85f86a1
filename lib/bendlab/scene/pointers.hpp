// JSON pointers: finding and setting the value at a pointer.
#pragma once

#include <string>
#include <string_view>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Whether `pointer` is `container` or points to something inside it.
bool lies_within(std::string_view pointer, std::string_view container);

/// The value at `pointer`, or nullptr if there is none.
const Json* value_at(const Json& document, const std::string& pointer);

/// Puts a value at `pointer`, creating objects on the way. Returns false, and changes nothing there, if the
/// pointer leads through a value that is not an object, or past the end of a list.
bool set_at(Json& document, const std::string& pointer, Json value);

}  // namespace bendlab
