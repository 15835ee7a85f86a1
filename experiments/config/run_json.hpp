// The settings of a run from JSON, and as JSON.
#pragma once

#include "bendlab/scene/pointers.hpp"
#include "experiments/config/run_settings.hpp"

namespace bendlab {

/// Reads a config without `sweep`, `cover`, `expect` and `because`: everything that is stated, on top of the
/// defaults. Appends every problem; if there are any, the settings are meaningless.
RunSettings read_run(const Json& settings, ConfigProblems& problems);

/// Appends the problems of `settings` with `value` at `pointer` that are problems of the value, which stands
/// at `place` of the config. Returns the others.
ConfigProblems check_value(const Json& settings, const std::string& pointer, const Json& value,
                           const std::string& place, ConfigProblems& problems);

/// The canonical settings: what decides the run, without name, description, allow and defaults. Equal runs
/// have equal JSON. read_run() of it, with a name, gives the same settings.
Json to_json(const RunSettings& settings);

}  // namespace bendlab
