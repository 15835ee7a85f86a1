// Reads the settings of a run from JSON, and writes the settings as JSON.
#pragma once

#include "bendlab/scene/pointers.hpp"
#include "experiments/config/run_settings.hpp"

namespace bendlab {

/// Reads a config from which `sweep`, `cover`, `expect` and `because` were removed. A setting that is not
/// stated has its default. Appends every problem; if there are problems, the returned settings are
/// meaningless.
RunSettings read_run(const Json& settings, ConfigProblems& problems);

/// Checks the config `settings` with `value` at `pointer`. Appends the problems of this value; `place` is the
/// pointer at which the config states the value. Returns the problems of all other settings.
ConfigProblems check_value(const Json& settings, const std::string& pointer, const Json& value,
                           const std::string& place, ConfigProblems& problems);

/// The canonical settings, which decide the run: without name, description, allow and defaults. Equal runs
/// have equal JSON. With a name added, read_run() reads the same settings from this JSON.
Json to_json(const RunSettings& settings);

}  // namespace bendlab
