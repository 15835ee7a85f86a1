// Checks whether the stiffness that is read from a cantilever strip is doubtful: the strip may be too stiff,
// too soft or too coarse, or the two readings of its stiffness may disagree.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/run_config.hpp"

namespace bendlab {

/// Why the strip of a run with the measure `stiffness` cannot show the stiffness that the config states, and
/// which strip can. Nothing if the strip can show the stiffness, or if the config states no physical
/// stiffness.
std::optional<std::string> unreadable_strip(const RunConfig& config, const BuiltScene& scene);

/// Why the metrics that the measure `stiffness` put into a run's summary do not give the stiffness, and a
/// remedy. Nothing if these metrics give the stiffness.
std::optional<std::string> doubtful_reading(const RunConfig& config, const BuiltScene& scene,
                                            const std::map<std::string, double>& summary);

/// The stiffness read from the free end, divided by the stiffness read from the whole shape, for the bending
/// law that the shape follows. Nothing if the shape follows neither law, or if a reading is missing.
std::optional<double> ratio_of_readings(const std::map<std::string, double>& summary);

/// Whether the two readings differ by more than 3 % (5 % for m = C κ³, because C depends on the fifth power
/// of a length, and B on the third).
bool readings_disagree(const std::map<std::string, double>& summary);

/// Why the last pose of a run is no reference for the stated cloth: the two readings of the strip disagree.
/// Nothing if the readings agree, or if the cloth is no strip. Throws RunFileError.
std::optional<std::string> doubtful_reference(const RunConfig& config, const std::filesystem::path& file);

}  // namespace bendlab
