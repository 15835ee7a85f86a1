// Reads JSON into structs, and writes structs as JSON, by their tables of fields.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/scene/strict_json.hpp"
#include "bendlab/settings/field.hpp"

namespace bendlab {

/// What a setting accepts, in words: "a whole number from 1 to 4096", "one of same, alternating, both", …
std::string expected_text(const Field& field);

/// The value of a setting, from the JSON value `given`. If `given` is not allowed, appends a problem and
/// returns nothing. A whole number may be written as 3.0. For an optional setting, null means "not set".
std::optional<Value> read_value(const Field& field, const Json& given, const std::string& pointer,
                                ConfigProblems& problems);

/// A value as JSON: numbers with a fraction or exponent, 0 instead of -0, and null for "not set".
Json json_of(const Value& value);

/// Copies the settings in the JSON object `given` to `owner`, a struct described by `table`. Missing or wrong
/// settings are not changed. Ignores `other_keys`, which the caller reads. Any other key is a problem.
void read_fields(const FieldTable& table, void* owner, const Json& given, const std::string& pointer,
                 std::span<const std::string_view> other_keys, ConfigProblems& problems);

/// Appends the settings of `owner` to the object `json`, in the order of the table. Leaves out settings that
/// FieldNotes::kept_when excludes, and optional settings without a value.
void write_fields(const FieldTable& table, const void* owner, const void* scene, Json& json);

/// Names of a table's rows.
std::vector<std::string_view> names_of(std::span<const Field> fields);

/// Whether `given` is a JSON object. If not, appends a problem.
bool is_object(const Json& given, const std::string& pointer, ConfigProblems& problems);

}  // namespace bendlab
