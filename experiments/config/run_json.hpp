// The settings of a run from JSON, and as JSON.
#pragma once

#include "bendlab/scene/pointers.hpp"
#include "experiments/config/run_settings.hpp"

namespace bendlab {

/// Reads a config from which `sweep`, `cover`, `expect` and `because` were removed. Settings that it does not
/// state have their defaults. Appends every problem; if there are problems, the returned settings are
/// meaningless.
RunSettings read_run(const Json& settings, ConfigProblems& problems);

/// Checks `settings` with `value` at `pointer`. Appends the problems of this value; `place` is the pointer at
/// which the config states the value. Returns the problems of other settings.
ConfigProblems check_value(const Json& settings, const std::string& pointer, const Json& value,
                           const std::string& place, ConfigProblems& problems);

/// The canonical settings: what decides the run, without name, description, allow and defaults. Equal runs
/// have equal JSON. read_run() of it, with a name, gives the same settings.
Json to_json(const RunSettings& settings);

}  // namespace bendlab
