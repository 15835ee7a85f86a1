// `expect`: bounds on a run's summary, each with its reason.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/scene/strict_json.hpp"
#include "bendlab/settings/field.hpp"
#include "experiments/config/run_config.hpp"

namespace bendlab {

/// A bound that `bendlab run` checks on every run of the experiment that matches `where`.
struct Expectation {
  std::string metric;
  std::optional<double> minimum, maximum;  ///< inclusive, in the metric's unit
  std::string why;
  /// {json pointer: value}: checks only runs whose config has these values; empty: every run.
  Json where = Json::object();
};

/// The settings of an entry of `expect`, except the object `where`, whose meaning is `where_meaning`.
const FieldTable& expectation_table();
inline constexpr std::string_view where_meaning =
    "Checks only runs that have these values: {\"/json/pointer\": value}; absent: every run";

/// Reads the entries of an `expect` list. Checks the pointers and values in `where` against `settings`.
std::vector<Expectation> read_expectations(const Json& expect, const Json& settings,
                                           ConfigProblems& problems);

/// Whether the run has every value in `where`. If the run does not depend on a setting, only null matches.
bool matches(const Expectation& expectation, const RunConfig& config);

struct ExpectationResult {
  Expectation expectation;
  std::optional<double> measured;  ///< empty if the run has no such metric
  bool holds = false;              ///< false for NaN and for an unknown metric
  std::string message;             ///< one line: the metric, its value, the bound, and why
};

/// Checks the expectations that match the run, against the run's summary (metric → value).
std::vector<ExpectationResult> check_expectations(const std::vector<Expectation>& expectations,
                                                  const RunConfig& config,
                                                  const std::map<std::string, double>& summary);

}  // namespace bendlab
