// When the stiffness read from a cantilever strip is in doubt: the strip is too stiff, too soft or too coarse
// to be read, or its two readings disagree.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/run_config.hpp"

namespace bendlab {

/// Why the strip of a run with the measure `stiffness` cannot show the stiffness that the config states, and
/// which strip would; nothing if it can, or if the config states no physical stiffness.
std::optional<std::string> unreadable_strip(const RunConfig& config, const BuiltScene& scene);

/// Why the numbers that the measure `stiffness` put into a run's summary are no stiffness, and what to do;
/// nothing if they are.
std::optional<std::string> doubtful_reading(const RunConfig& config, const BuiltScene& scene,
                                            const std::map<std::string, double>& summary);

/// The stiffness by the free end over that by the whole shape, of the law that the whole shape shows. Nothing
/// if it shows neither law, or a reading is missing.
std::optional<double> ratio_of_readings(const std::map<std::string, double>& summary);

/// Whether the two readings differ by more than 3 % (by 5 % in m = C κ³, where a length counts to the fifth
/// power instead of the third).
bool readings_disagree(const std::map<std::string, double>& summary);

/// Why the last pose of a run is no reference for the stated cloth: two readings of its strip disagree.
/// Nothing if they agree, or if it is no strip. Throws RunFileError.
std::optional<std::string> doubtful_reference(const RunConfig& config, const std::filesystem::path& file);

}  // namespace bendlab
