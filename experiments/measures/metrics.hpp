// The names of all numbers that a run's summary may have: what `expect` may ask for.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// Numbers of the scene and of the solver, which no measure gives: those of facts_of() and of the stepping.
std::span<const std::string_view> names_of_facts();

/// What is wrong with the metric of an expectation, before any run: no measure gives it, or none that a run
/// of the experiment has. Nothing if some run may have it.
std::optional<std::string> problem_with_metric(const Experiment& experiment, const std::string& metric);

/// Throws ConfigError with the problems of all expectations.
void check_metrics(const Experiment& experiment);

}  // namespace bendlab
