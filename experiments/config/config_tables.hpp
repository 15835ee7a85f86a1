// Every setting of a config: those of the scene, and those of the run beside them.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "bendlab/scene/scene_tables.hpp"

namespace bendlab {

/// The settings of RunSettings' own, "/name" for example, and of its structs.
const FieldTable& run_table();
const FieldTable& output_table();
const FieldTable& accuracy_table();
const FieldTable& quality_table();

/// Every section, parents before children, in the order of the reference page: the top level, those of the
/// scene, /output, /accuracy and /quality.
std::span<const Section> config_sections();

/// The section of that pointer, or nullptr.
const Section* find_section(std::string_view pointer);

/// The sections directly below `pointer`.
std::vector<const Section*> child_sections(std::string_view pointer);

/// Lets /output/measures name a further measure. To be called before sections are read.
void add_measure_on_request(std::string_view name);

/// The last part of a section's pointer: its key in the parent object.
std::string_view section_key(const Section& section);

/// A key of the top level that is neither a setting nor a section.
struct ConfigList {
  std::string_view name, meaning;
};

/// `effects`, `sweep`, `cover`, `expect` and `because`.
std::span<const ConfigList> config_lists();

/// The settings of `cover`.
const FieldTable& cover_table();

/// The settings of an entry of `expect`, besides its object `where`.
const FieldTable& expectation_table();
std::string_view expectation_where_meaning();

}  // namespace bendlab
