// Sweeps: from lists of values to one config per combination.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bendlab/parameters/field.hpp"
#include "experiments/config/cover.hpp"
#include "experiments/config/run_config.hpp"

namespace bendlab {

/// A swept pointer and its values, normalised.
using Axis = std::pair<std::string, std::vector<Json>>;

/// How much of a sweep its cover runs.
struct Covered {
  int strength = 0;  ///< every combination of values of this many axes is in a run; 0: no cover, all run
  std::size_t tuples = 0;            ///< how many such combinations there are
  std::size_t missing = 0;           ///< how many of these combinations are in no run
  std::vector<std::string> refused;  ///< values that no run can have together, as "/a = 1, /b = 2"
};

/// The axes of a `sweep` object, in its order. Each pointer must name a setting, a section or (part of) the
/// effects that `settings` lists; lists must not be empty. The number of combinations is checked, unless the
/// sweep is `covered`: then expand_cover() checks it.
std::vector<Axis> read_axes(const Json& sweep, const Json& settings, bool covered, ConfigProblems& problems);

/// Checks each value of the axes by itself, together with the other settings.
void check_values(const Json& settings, const std::vector<Axis>& axes, ConfigProblems& problems);

/// The settings of `cover`.
const FieldTable& cover_table();

/// The value of a config's `cover`, a number or an object; nothing if it is absent or wrong.
std::optional<Cover> read_cover(const Json& cover, ConfigProblems& problems);

/// `settings` where each missing swept setting has the first value of its axis: a complete config that can be
/// checked.
Json with_first_values(const Json& settings, const std::vector<Axis>& axes);

/// One run per combination of the axes' values, the last axis fastest. Of runs with equal resolved settings
/// only the first is kept. File names are relative to `folder`. Appends problems of single combinations; if
/// there are any, the runs are meaningless.
std::vector<RunConfig> expand_sweep(const Json& settings, const std::filesystem::path& folder,
                                    const std::vector<Axis>& axes, ConfigProblems& problems);

/// The runs of a covering array instead of all combinations: for any `cover.strength` axes, every combination
/// of their values is in a run, unless no run can have it; `covered` lists such combinations. Of runs with
/// equal resolved settings only the first is kept. A value that no run can have is a problem.
std::vector<RunConfig> expand_cover(const Json& settings, const std::filesystem::path& folder,
                                    const std::vector<Axis>& axes, const Cover& cover, Covered& covered,
                                    ConfigProblems& problems);

}  // namespace bendlab
