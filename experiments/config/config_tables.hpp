// Every setting of a config: those of the scene, and those of the run beside them.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "bendlab/scene/scene_tables.hpp"
#include "experiments/config/run_settings.hpp"

namespace bendlab {

/// RunSettings itself, or a struct of it beside the scene: its pointer, what it is for, and its rows.
struct RunPart {
  std::string_view pointer, meaning;
  FieldTable table;
  const void* (*in)(const RunSettings& settings);  ///< where it is
};

/// "" (the top level), "/output", "/accuracy" and "/quality".
std::span<const RunPart> run_parts();

/// Every section, parents before children, in the order of the reference page: the top level, those of the
/// scene, /output, /accuracy and /quality.
std::span<const Section> config_sections();

/// The section of that pointer, or nullptr.
const Section* find_section(std::string_view pointer);

/// The sections directly below `pointer`.
std::vector<const Section*> child_sections(std::string_view pointer);

/// The measures that /output/measures may name: measures/measure.cpp, which knows them all, defines it.
std::span<const std::string_view> measures_on_request();

/// The last part of a section's pointer: its key in the parent object.
std::string_view section_key(const Section& section);

/// A key of the top level that is neither a setting nor a section.
struct ConfigList {
  std::string_view name, meaning;
};

/// `effects`, `sweep`, `cover`, `expect` and `because`.
std::span<const ConfigList> config_lists();

}  // namespace bendlab
