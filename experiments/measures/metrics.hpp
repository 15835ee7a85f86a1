// Lists all measures and their metrics for `bendlab measures`, and checks the metrics that /expect names.
#pragma once

#include <optional>
#include <string>

#include "bendlab/scene/strict_json.hpp"
#include "experiments/config/experiment.hpp"

namespace bendlab {

/// Every measure: name, summary, when a run has it, cost, and its metrics with unit and meaning.
std::string measures_text();
Json measures_json();

/// Why no run of the experiment can have the metric of an expectation: no measure gives the metric, or no run
/// has the measure. Nothing if a run may have the metric. Known before any run.
std::optional<std::string> problem_with_metric(const Experiment& experiment, const std::string& metric);

/// Throws ConfigError with the problems of all expectations.
void check_metrics(const Experiment& experiment);

}  // namespace bendlab
