// Sweeps: from lists of values to one config per combination.
#pragma once

#include <vector>

#include "experiments/config.hpp"

namespace bendlab {

/// The axes of a `sweep` object, in its order. Each pointer must name a setting, a section or (part of) the
/// effects that `settings` lists; lists must not be empty. Every value is checked by itself against the rest
/// of the settings.
std::vector<Axis> read_axes(const Json& sweep, const Json& settings, ConfigProblems& problems);

/// `settings` where every axis that it says nothing about has its first value: what can be checked as a
/// whole.
Json with_first_values(const Json& settings, const std::vector<Axis>& axes);

/// One run per combination of the axes' values, the last axis fastest, runs with equal resolved settings
/// merged into the first of them. Problems are those of single combinations; the runs are then meaningless.
std::vector<RunConfig> expand_sweep(const Json& settings, const std::vector<Axis>& axes,
                                    ConfigProblems& problems);

}  // namespace bendlab
