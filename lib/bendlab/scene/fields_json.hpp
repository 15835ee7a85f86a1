// JSON from and to structs, by their tables of fields.
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

/// The setting's value as given, or nothing and a problem. A whole number may be written 3.0; null stands for
/// "not set" where a setting is optional.
std::optional<Value> read_value(const Field& field, const Json& given, const std::string& pointer,
                                ConfigProblems& problems);

/// A value as canonical JSON: numbers always with a fraction or exponent, -0 as 0; null for "not set".
Json json_of(const Value& value);

/// Puts what the object `given` states into `owner`, a struct of that table. What is absent or wrong stays as
/// it is. Keys in `other_keys` are the caller's; any further key is a problem.
void read_fields(const FieldTable& table, void* owner, const Json& given, const std::string& pointer,
                 std::span<const std::string_view> other_keys, ConfigProblems& problems);

/// Appends the settings of `owner` that are read in `scene` to the object `json`, in the table's order,
/// without those not set.
void write_fields(const FieldTable& table, const void* owner, const void* scene, Json& json);

/// Names of a table's rows.
std::vector<std::string_view> names_of(std::span<const Field> fields);

/// Whether `given` is a JSON object; a problem if it is not.
bool is_object(const Json& given, const std::string& pointer, ConfigProblems& problems);

}  // namespace bendlab
