// Every setting of a config, row by row. These tables parse configs, fill in defaults and print the
// reference.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/parameters/parameter.hpp"

namespace bendlab {

/// A JSON object of a config: its pointer, what it is for, and its settings.
struct ConfigSection {
  std::string_view pointer;  ///< "" for the top level, "/mesh", "/material/strain", …
  std::string_view meaning;
  std::span<const Parameter> parameters;
};

/// Every section, parents before children, in the order of the reference page: the fixed ones, and
/// "/bending/<model>" for each registered bending model that has settings.
std::span<const ConfigSection> config_sections();

/// The section of that pointer, or nullptr.
const ConfigSection* find_section(std::string_view pointer);

/// The sections directly below `pointer`.
std::vector<const ConfigSection*> child_sections(std::string_view pointer);

/// Lets /output/measures name a further measure. Throws std::logic_error if sections were read before.
void add_measure_on_request(std::string_view name);

/// The last part of a section's pointer: its key in the parent object.
std::string_view section_key(const ConfigSection& section);

/// A key of the top level that is neither a setting nor a section.
struct ConfigList {
  std::string_view name, meaning;
};

/// `effects`, `sweep`, `cover` and `expect`.
std::span<const ConfigList> config_lists();

/// The `type` of an entry of `effects`; its other settings are the effect's own table.
const Parameter& effect_type_parameter();

/// The settings of `cover`.
std::span<const Parameter> cover_parameters();

/// The settings of an entry of `expect`, besides its object `where`.
std::span<const Parameter> expectation_parameters();
std::string_view expectation_where_meaning();

/// Names of a table's rows.
std::vector<std::string_view> names_of(std::span<const Parameter> table);

/// What a setting accepts, in words: "a whole number from 1 to 4096", "one of same, alternating, both", …
std::string expected_text(const Parameter& parameter);

}  // namespace bendlab
