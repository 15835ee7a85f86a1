// Sweeps: from lists of values to one config per combination.
#pragma once

#include <optional>
#include <vector>

#include "experiments/config/config.hpp"
#include "experiments/config/cover.hpp"

namespace bendlab {

/// The axes of a `sweep` object, in its order. Each pointer must name a setting, a section or (part of) the
/// effects that `settings` lists; lists must not be empty. Every value is checked by itself against the rest
/// of the settings, and the number of combinations, unless they are `covered`: expand_cover() checks what it
/// takes.
std::vector<Axis> read_axes(const Json& sweep, const Json& settings, bool covered, ConfigProblems& problems);

/// `cover` as a config has it, a number or an object; nothing where there is none, or it is wrong.
std::optional<Cover> read_cover(const Json& cover, ConfigProblems& problems);

/// `settings` where every axis that it says nothing about has its first value: what can be checked as a
/// whole.
Json with_first_values(const Json& settings, const std::vector<Axis>& axes);

/// One run per combination of the axes' values, the last axis fastest, runs with equal resolved settings
/// merged into the first of them. Files are relative to `folder`. Problems are those of single combinations; the runs are then meaningless.
std::vector<RunConfig> expand_sweep(const Json& settings, const std::filesystem::path& folder,
                                    const std::vector<Axis>& axes, ConfigProblems& problems);

/// Runs of a covering array over the axes instead of every combination: any values of any `cover.strength`
/// axes are together in one of them, unless no combination with them is allowed, which `told` says. Runs with
/// equal resolved settings are merged. A value that no combination allows is a problem.
std::vector<RunConfig> expand_cover(const Json& settings, const std::filesystem::path& folder,
                                    const std::vector<Axis>& axes, const Cover& cover, Covered& told,
                                    ConfigProblems& problems);

}  // namespace bendlab
