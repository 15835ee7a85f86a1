// Sets up a run without stepping it, so that an error before its first step is found here.
#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/run/warning.hpp"

namespace bendlab {

/// Builds scene, bending, effects, measures and method of a run, and of the runs before it (/initial/after).
/// Returns the warnings that are known then. Throws the errors that the run would throw before its first
/// step.
std::vector<Warning> set_up(const Experiment& experiment, const RunConfig& config);

/// The settings that set_up() depends on, as text: runs with the same text are built alike.
std::string text_of_set_up(const RunConfig& config);

/// CPU seconds that set_up() is expected to take (forecast.hpp).
double expected_set_up_s(const RunConfig& config);

}  // namespace bendlab
