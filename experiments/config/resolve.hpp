// From JSON as someone wrote it to canonical settings: checked against the tables, defaults filled in.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bendlab/parameters/parameter.hpp"
#include "experiments/config/strict_json.hpp"

namespace bendlab {

/// The setting's value as given, or nothing and a problem. A whole number may be written 3.0; null stands for
/// "not set" where a setting has no default and is not required.
std::optional<Value> read_value(const Parameter& row, const Json& given, const std::string& pointer,
                                ConfigProblems& problems);

/// A value as canonical JSON: numbers always with a fraction or exponent, -0 as 0; null for "not set".
Json json_of(const Value& value);

/// The settings of one table from the object `given`, in the order of the table, without those not set. What
/// is absent or wrong gets its default. Keys in `other_keys` are the caller's; any further key is a problem.
Json read_settings(const Json& given, const std::string& pointer, std::span<const Parameter> table,
                   std::span<const std::string_view> other_keys, ConfigProblems& problems);

/// Canonical JSON of read_settings() as typed values, what is not there at its default. Throws
/// std::invalid_argument where a value is not one that the table allows.
ParameterValues values_of(const Json& canonical, std::span<const Parameter> table);

/// Checks everything but `sweep` and `expect` (which must not be there) and returns the canonical settings:
/// every value of every section, only the chosen bending model's own settings, no generator settings beside a
/// mesh file, no name, description, allow, defaults and because. Equal physics gives equal JSON. Meaningless
/// if there were problems.
Json resolve(const Json& settings, ConfigProblems& problems);

}  // namespace bendlab
