// `--set /json/pointer=value`: changes to a config before it is checked.
#pragma once

#include <span>
#include <string>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Applies "/json/pointer=value" texts in order. The value is JSON, else plain text (a number for a text
/// setting stays text). Missing objects are created. For a swept pointer, the value replaces the axis, or a
/// list of values does (a list of lists if the setting is itself a list). For a setting inside a swept
/// object, every value of the axis is changed. The pointer may also be /name, /description, or anything in
/// /sweep, /cover and /expect.
void apply_overrides(Json& document, std::span<const std::string> overrides, ConfigProblems& problems);

/// The override that adds an axis: "/bending/k=0.1,0.2" gives "/sweep/~1bending~1k=[0.1,0.2]". The values are
/// JSON, else plain texts. Throws std::invalid_argument if `axis` is not of this form.
std::string sweep_override(const std::string& axis);

}  // namespace bendlab
