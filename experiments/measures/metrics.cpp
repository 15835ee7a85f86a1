#include "experiments/measures/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "bendlab/scene/nearest_name.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

std::string_view when(const Measure& measure) {
  if (!measure.applies) return "if /output/measures names it";
  return measure.applies == always ? "always" : measure.when;
}

std::string rows_text(const char* heading, const std::vector<Column>& rows) {
  std::string text;
  for (const Column& row : rows)
    text += fmt::format("{}    {} ({}): {}\n", text.empty() ? fmt::format("  {}\n", heading) : "", row.name,
                        row.unit, row.meaning);
  return text;
}

Json rows_json(const std::vector<Column>& rows) {
  Json json = Json::array();
  for (const Column& row : rows)
    json.push_back({{"name", row.name}, {"unit", row.unit}, {"meaning", row.meaning}});
  return json;
}

// The measure that gives the metric, or null.
const Measure* measure_of(const std::string& metric) {
  for (const Measure* measure : measures()) {
    const std::vector<Quantity> all = measure->gives();
    if (std::ranges::find(all, metric, &Quantity::name) != all.end()) return measure;
  }
  return nullptr;
}

std::vector<std::string> known_metrics() {
  std::vector<std::string> names;
  for (const Column& metric : numbers_of_scene()) names.push_back(metric.name);
  for (const Measure* measure : measures())
    for (const Quantity& metric : measure->gives()) names.push_back(metric.name);
  return names;
}

}  // namespace

std::string measures_text() {
  const auto scene = numbers_of_scene();
  std::string text = "scene and solver: metrics that every run has\n" +
                     rows_text("metrics of a run", {scene.begin(), scene.end()});
  for (const Measure* measure : measures())
    text += fmt::format("\n{}: {}\n  a run has it {}; cost: {}\n{}{}{}", measure->name, measure->summary,
                        when(*measure), measure->cost, rows_text("metrics of a run", measure->gives()),
                        rows_text("metrics of every frame", measure->columns()),
                        rows_text("metrics of every triangle in every frame", measure->fields()));
  return text;
}

Json measures_json() {
  Json json = Json::array();
  for (const Measure* measure : measures())
    json.push_back({{"name", measure->name},
                    {"summary", measure->summary},
                    {"when", when(*measure)},
                    {"cost", measure->cost},
                    {"run", rows_json(measure->gives())},
                    {"frame", rows_json(measure->columns())},
                    {"triangle", rows_json(measure->fields())}});
  return json;
}

std::optional<std::string> problem_with_metric(const Experiment& experiment, const std::string& metric) {
  // Bending models choose the names of these metrics themselves.
  if (metric.starts_with("model_") ||
      std::ranges::find(numbers_of_scene(), metric, &Column::name) != numbers_of_scene().end())
    return std::nullopt;
  const Measure* measure = measure_of(metric);
  if (!measure)
    return fmt::format("there is no metric '{}'{} (`bendlab measures` lists all metrics)", metric,
                       suggestion(metric, known_metrics()));
  if (!measure->applies && std::ranges::none_of(experiment.runs, [&](const RunConfig& run) {
        return is_asked_for(*measure, run);
      }))
    return fmt::format("no run has the metric '{}': add its measure, {}, to /output/measures", metric,
                       measure->name);
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
