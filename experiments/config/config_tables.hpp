// Tables of every setting of a config: the settings of the scene, and the run's own settings.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "bendlab/scene/scene_tables.hpp"
#include "experiments/config/run_settings.hpp"

namespace bendlab {

/// One of the parts of the run's own settings: RunSettings, OutputSettings, Accuracy or QualityThresholds.
struct RunPart {
  std::string_view pointer, meaning;
  FieldTable table;
  const void* (*in)(const RunSettings& settings);  ///< address of the part in `settings`
};

/// The parts "" (the top level), "/output", "/accuracy" and "/quality".
std::span<const RunPart> run_parts();

/// Every section, parents before children, in the order in which `bendlab schema` prints them: the top level,
/// the scene's sections, /output, /accuracy and /quality.
std::span<const Section> config_sections();

/// The section at `pointer`, or nullptr.
const Section* find_section(std::string_view pointer);

/// The sections directly below `pointer`.
std::vector<const Section*> child_sections(std::string_view pointer);

/// The measures that /output/measures may name. Defined in measures/measure.cpp, which lists all measures.
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
