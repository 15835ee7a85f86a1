// Expands a sweep: from lists of values to one run per combination of values.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bendlab/settings/field.hpp"
#include "experiments/config/cover.hpp"
#include "experiments/config/run_config.hpp"

namespace bendlab {

/// A swept pointer and its values, normalised.
using Axis = std::pair<std::string, std::vector<Json>>;

/// How many combinations of values the runs of a cover contain.
struct Covered {
  int strength = 0;  ///< every combination of values of this many axes is in a run; 0: no cover, all run
  std::size_t tuples = 0;            ///< how many such combinations there are
  std::size_t missing = 0;           ///< how many of these combinations are in no run
  std::vector<std::string> refused;  ///< values that no run can have together, as "/a = 1, /b = 2"
};

/// The axes of a `sweep` object, in the same order. Each pointer must name a setting, a section or (part of)
/// the effects that `settings` lists; lists must not be empty. Checks the number of combinations. For a sweep
/// with a cover (`covered`), expand_cover() checks this number.
std::vector<Axis> read_axes(const Json& sweep, const Json& settings, bool covered, ConfigProblems& problems);

/// Checks the values of the axes one by one, together with the settings outside the sweep.
void check_values(const Json& settings, const std::vector<Axis>& axes, ConfigProblems& problems);

/// The settings of `cover`.
const FieldTable& cover_table();

/// Reads a config's `cover`, a number or an object. Nothing if the value is wrong.
std::optional<Cover> read_cover(const Json& cover, ConfigProblems& problems);

/// `settings`, to which the first value of each missing swept setting is added, so that the config can be
/// checked.
Json with_first_values(const Json& settings, const std::vector<Axis>& axes);

/// One run per combination of the axes' values; the last axis varies fastest. If several runs have equal
/// resolved settings, only the first of these runs is kept. File names are relative to `folder`. Appends
/// problems of single combinations; if there are problems, the runs are meaningless.
std::vector<RunConfig> expand_sweep(const Json& settings, const std::filesystem::path& folder,
                                    const std::vector<Axis>& axes, ConfigProblems& problems);

/// The runs of a covering array (cover.hpp) instead of all combinations. Combinations of values that no run
/// can have are listed in `covered`. A single value that no run can have is a problem. If several runs have
/// equal resolved settings, only the first of these runs is kept.
std::vector<RunConfig> expand_cover(const Json& settings, const std::filesystem::path& folder,
                                    const std::vector<Axis>& axes, const Cover& cover, Covered& covered,
                                    ConfigProblems& problems);

}  // namespace bendlab
