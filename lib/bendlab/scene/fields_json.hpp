// Reads JSON into structs, and writes structs as JSON, by their tables of fields.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/parameters/field.hpp"
#include "bendlab/scene/strict_json.hpp"

namespace bendlab {

/// What a setting accepts, in words: "a whole number from 1 to 4096", "one of same, alternating, both", …
std::string expected_text(const Field& field);

/// The setting's value as given, or nothing, with a problem appended. A whole number may be written 3.0; null
/// stands for "not set" where a setting is optional.
std::optional<Value> read_value(const Field& field, const Json& given, const std::string& pointer,
                                ConfigProblems& problems);

/// A value as canonical JSON: numbers always with a fraction or exponent, -0 as 0; null for "not set".
Json json_of(const Value& value);

/// Puts the settings that the object `given` states into `owner`, a struct of that table. Settings that are
/// absent or wrong stay as they are. The caller reads the keys in `other_keys`; any further key is a problem.
void read_fields(const FieldTable& table, void* owner, const Json& given, const std::string& pointer,
                 std::span<const std::string_view> other_keys, ConfigProblems& problems);

/// Appends the settings of `owner` that are read in `scene` to the object `json`, in the table's order.
/// Settings that are not set are left out.
void write_fields(const FieldTable& table, const void* owner, const void* scene, Json& json);

/// Names of a table's rows.
std::vector<std::string_view> names_of(std::span<const Field> fields);

/// Whether `given` is a JSON object; appends a problem if it is not.
bool is_object(const Json& given, const std::string& pointer, ConfigProblems& problems);

}  // namespace bendlab
