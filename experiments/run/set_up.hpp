// Sets up a run without stepping it, to find errors that would occur before the first step.
#pragma once

#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"
#include "experiments/run/warning.hpp"

namespace bendlab {

/// Builds scene, bending, effects, measures and method of a run, and of the earlier runs after which it
/// starts (/initial/after). Returns the warnings that are known before the first step. Throws the errors that
/// the run would throw before its first step.
std::vector<Warning> set_up(const Experiment& experiment, const RunConfig& config);

/// The settings that set_up() depends on, as text: set_up() does the same for runs with the same text.
std::string text_of_set_up(const RunConfig& config);

}  // namespace bendlab
