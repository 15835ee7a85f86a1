#include "experiments/measures/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "bendlab/scene/nearest_name.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

constexpr std::array<std::string_view, 14> facts = {"size",
                                                    "edge_length",
                                                    "vertices",
                                                    "triangles",
                                                    "springs",
                                                    "bending_constraints",
                                                    "springs_beyond_ring_1",
                                                    "pinned_vertices",
                                                    "projections",
                                                    "substeps",
                                                    "memory_bytes",
                                                    "unbalanced",
                                                    "membrane_softness",
                                                    "settled_at"};

// The measure that gives the number, or null.
const Measure* measure_of(const std::string& metric) {
  for (const Measure* measure : measures()) {
    if (!measure->gives) continue;
    const std::vector<Quantity> all = measure->gives();
    if (std::ranges::find(all, metric, &Quantity::name) != all.end()) return measure;
  }
  return nullptr;
}

std::vector<std::string> known_metrics() {
  std::vector<std::string> names(facts.begin(), facts.end());
  for (const Measure* measure : measures())
    for (const Quantity& quantity : measure->gives ? measure->gives() : std::vector<Quantity>{})
      names.push_back(quantity.name);
  return names;
}

bool asked_for(const Measure& measure, const RunConfig& run) {
  const std::vector<std::string> asked = run.settings().output.measures;
  return std::ranges::find(asked, measure.name) != asked.end();
}

}  // namespace

std::span<const std::string_view> names_of_facts() {
  return facts;
}

std::optional<std::string> problem_with_metric(const Experiment& experiment, const std::string& metric) {
  // Bending models choose these names themselves.
  if (metric.starts_with("model_") || std::ranges::find(facts, metric) != facts.end()) return std::nullopt;
  const Measure* measure = measure_of(metric);
  if (!measure)
    return fmt::format("there is no metric '{}'{} (`bendlab measures` lists them)", metric,
                       suggestion(metric, known_metrics()));
  const bool on_request = !measure->applies;
  if (on_request &&
      std::ranges::none_of(experiment.runs, [&](const RunConfig& run) { return asked_for(*measure, run); }))
    return fmt::format("no run has '{}': it comes from the measure {}, which /output/measures has to name",
                       metric, measure->name);
  return std::nullopt;
}

void check_metrics(const Experiment& experiment) {
  ConfigProblems problems;
  for (std::size_t i = 0; i < experiment.expectations.size(); ++i)
    if (const auto problem = problem_with_metric(experiment, experiment.expectations[i].metric))
      problems.push_back({fmt::format("/expect/{}/metric", i), *problem});
  if (!problems.empty()) throw ConfigError(experiment.source.string(), std::move(problems));
}

}  // namespace bendlab
