// What a run of an experiment is called, by the values that are swept.
#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// The run's place on the sweep, "cells 64, model crossover"; its experiment's name where nothing is swept.
std::string place_text(const Experiment& experiment, const RunConfig& config);

/// The run's experiment and place, "fig5 (cells 64, model crossover)".
std::string run_text(const Experiment& experiment, const RunConfig& config);

/// Headings for the swept values: last part of each pointer, or all of it where two would be alike.
std::vector<std::string> axis_headings(const Experiment& experiment);

/// The run's values under axis_headings(), empty where an axis does not apply to it.
std::vector<std::string> axis_cells(const Experiment& experiment, const RunConfig& config);

}  // namespace bendlab
