// Names the runs of an experiment by their swept values.
#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// The run's swept values, "cells 64, model crossover"; the experiment's name if nothing is swept.
std::string place_text(const Experiment& experiment, const RunConfig& config);

/// The run's experiment and swept values, "fig5 (cells 64, model crossover)".
std::string run_text(const Experiment& experiment, const RunConfig& config);

/// Headings for the swept values: the last part of each pointer, or the whole pointer if two headings would
/// be the same.
std::vector<std::string> axis_headings(const Experiment& experiment);

/// The run's values under axis_headings(), empty where an axis does not apply to it.
std::vector<std::string> axis_cells(const Experiment& experiment, const RunConfig& config);

}  // namespace bendlab
