// All measures and their numbers: what `bendlab measures` prints, and what `expect` may ask for.
#pragma once

#include <optional>
#include <string>

#include "bendlab/scene/strict_json.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {

/// Every measure: name, what it finds out, when a run has it, what it costs, its numbers with unit and
/// meaning.
std::string measures_text();
Json measures_json();

/// What is wrong with the metric of an expectation, before any run: no measure gives it, or none that a run
/// of the experiment has. Nothing if some run may have it.
std::optional<std::string> problem_with_metric(const Experiment& experiment, const std::string& metric);

/// Throws ConfigError with the problems of all expectations.
void check_metrics(const Experiment& experiment);

}  // namespace bendlab
