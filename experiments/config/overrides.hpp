// `--set /json/pointer=value`: changes to a config before it is checked.
#pragma once

#include <span>
#include <string>

#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// Applies "/json/pointer=value" texts in order. A value that is no JSON is a plain text, and so is a number
/// for a text setting. Missing objects are created. For a swept pointer, the value or list of values replaces
/// the swept values. (A setting that is itself a list takes a list of lists.) For a setting inside a swept
/// object, every value of the axis is changed. The pointer may also be /name, /description, or anything in
/// /sweep, /cover and /expect.
void apply_overrides(Json& document, std::span<const std::string> overrides, ConfigProblems& problems);

/// The override that adds an axis: "/bending/k=0.1,0.2" gives "/sweep/~1bending~1k=[0.1,0.2]". Values that
/// are no JSON are plain texts. Throws std::invalid_argument if `axis` is not of this form.
std::string sweep_override(const std::string& axis);

}  // namespace bendlab
