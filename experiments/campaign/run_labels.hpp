// Names the runs of an experiment by their swept values.
#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// The run's swept values, such as "cells 64, model crossover". Without a sweep, the experiment's name.
std::string place_text(const Experiment& experiment, const RunConfig& config);

/// The run's experiment and swept values, such as "fig5 (cells 64, model crossover)".
std::string run_text(const Experiment& experiment, const RunConfig& config);

/// Headings for the swept values: the last part of each pointer. Pointers with the same last part are written
/// as a whole.
std::vector<std::string> axis_headings(const Experiment& experiment);

/// The run's values, in the order of axis_headings(); "" for an axis that does not apply to the run.
std::vector<std::string> axis_cells(const Experiment& experiment, const RunConfig& config);

}  // namespace bendlab
