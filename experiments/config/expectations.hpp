// `expect`: bounds on a run's summary, each with its reason.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/config/experiment.hpp"

namespace bendlab {

/// The entries of an `expect` list. The pointers and values of their `where` are checked against `settings`.
std::vector<Expectation> read_expectations(const Json& expect, const Json& settings,
                                           ConfigProblems& problems);

/// Whether the experiment's run has every value that `where` asks for. A setting that the run does not depend
/// on matches nothing.
bool matches(const Expectation& expectation, const Experiment& experiment, const RunConfig& config);

struct ExpectationResult {
  Expectation expectation;
  std::optional<double> measured;  ///< nothing where the run has no such metric
  bool holds = false;              ///< false for NaN and for an unknown metric
  std::string message;             ///< one line: the metric, its value, the bound, and why
};

/// Every expectation that matches the run, against the run's summary (metric → value).
std::vector<ExpectationResult> check_expectations(const Experiment& experiment, const RunConfig& config,
                                                  const std::map<std::string, double>& summary);

}  // namespace bendlab
