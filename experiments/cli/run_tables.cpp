// The tables of an experiment's runs: a row per run.
#include "experiments/cli/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "experiments/campaign/run_labels.hpp"
#include "experiments/config/expectations.hpp"
#include "experiments/measures/effective_stiffness.hpp"
#include "experiments/measures/measure.hpp"
#include "experiments/terminal/printable.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

/// The metrics of the summary that every table has.
constexpr std::array<const char*, 7> main_columns = {
    "vertices", "triangles", "springs", "mean_strain", "max_stretch", "pin_max_stretch", "drop"};

bool has_number(const CampaignRun& run, const std::string& name) {
  return run.outcome && run.outcome->summary.contains(name);
}

/// A metric of a run's summary as text, "" if the run does not have the metric. An effective stiffness that
/// is too small for a reliable estimate is written as "< 0.01".
std::string number_cell(const CampaignRun& run, const std::string& name) {
  if (!has_number(run, name)) return "";
  const double value = run.outcome->summary.at(name);
  const bool unknown =
      name.starts_with("effective_") && name.ends_with("_stiffness") && value < least_known_share;
  return unknown ? fmt::format("< {:.2g}", least_known_share) : format_number(value);
}

std::string status_cell(const CampaignRun& run) {
  if (!run.outcome) return coloured("failed", Colour::red, stdout);
  const std::string text = to_string(run.outcome->status) + (run.outcome->reused ? ", reused" : "");
  const bool fine = run.exit_code == 0 && run.outcome->status == RunStatus::complete;
  return fine ? text : coloured(text, Colour::red, stdout);
}

/// The main columns, the expected metrics, the effective stiffnesses (if a run has less than 90 % of the
/// stated stiffness), and the errors (if runs have errors).
std::vector<std::string> columns_of(std::span<const CampaignRun> runs) {
  std::vector<std::string> columns(main_columns.begin(), main_columns.end());
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(columns, name) == columns.end()) columns.push_back(name);
  };
  const auto any_run_has = [&](const std::string& name) {
    return std::ranges::any_of(runs, [&](const CampaignRun& run) { return has_number(run, name); });
  };
  for (const Expectation& expected : runs.front().experiment->expectations)
    if (any_run_has(expected.metric)) add(expected.metric);
  constexpr double converged = 0.9;  // 1
  for (const char* share : {"effective_bending_stiffness", "effective_membrane_stiffness"})
    if (std::ranges::any_of(runs, [&](const CampaignRun& run) {
          return has_number(run, share) && run.outcome->summary.at(share) < converged;
        }))
      add(share);
  for (const char* error : {"error_solver_rms", "error_physical_rms"})
    if (any_run_has(error)) add(error);
  return columns;
}

/// The metrics of a measure that at least one run has in its summary.
std::vector<std::string> numbers_of(const Measure& measure, std::span<const CampaignRun> runs) {
  std::vector<std::string> names;
  for (const Quantity& quantity : measure.gives())
    if (std::ranges::any_of(runs, [&](const CampaignRun& run) { return has_number(run, quantity.name); }))
      names.push_back(quantity.name);
  return names;
}

/// A metric's name without the name of its measure: "fit_B" for "stiffness_fit_B".
std::string short_name(const std::string& name, std::string_view measure) {
  const std::string beginning = fmt::format("{}_", measure);
  return name.starts_with(beginning) ? name.substr(beginning.size()) : name;
}

/// A table with a row per run: swept values, and the metrics `names`.
std::string numbers_table(std::span<const CampaignRun> runs, std::span<const std::string> names,
                          std::string_view measure) {
  const Experiment& experiment = *runs.front().experiment;
  std::vector<std::string> headings = axis_headings(experiment);
  for (const std::string& name : names) headings.push_back(short_name(name, measure));
  Table table(headings);
  for (const CampaignRun& run : runs) {
    std::vector<std::string> cells = axis_cells(experiment, *run.config);
    for (const std::string& name : names) cells.push_back(number_cell(run, name));
    table.add_row(std::move(cells));
  }
  return table.text();
}

/// How many of the metrics `names` fit into a table of ordinary width, beside the swept values; at least 1.
std::size_t how_many_fit(const Experiment& experiment, std::span<const std::string> names,
                         std::string_view measure) {
  constexpr std::size_t ordinary = 110, gap = 2, number = 9;  // columns of a terminal
  std::size_t used = 0, count = 0;
  for (const std::string& heading : axis_headings(experiment)) used += std::max(heading.size(), number) + gap;
  for (const std::string& name : names) {
    used += std::max(short_name(name, measure).size(), number) + gap;
    if (used > ordinary) break;
    ++count;
  }
  return std::max<std::size_t>(count, 1);
}

}  // namespace

std::string run_table(std::span<const CampaignRun> runs) {
  const Experiment& experiment = *runs.front().experiment;
  const std::vector<std::string> columns = columns_of(runs);
  std::vector<std::string> headings = axis_headings(experiment);
  headings.insert(headings.end(), columns.begin(), columns.end());
  headings.insert(headings.end(), {"wall_s", "status"});
  Table table(headings);
  for (const CampaignRun& run : runs) {
    std::vector<std::string> cells = axis_cells(experiment, *run.config);
    for (const std::string& column : columns) cells.push_back(number_cell(run, column));
    cells.push_back(run.outcome ? fmt::format("{:.1f}", run.outcome->wall_s) : "");
    cells.push_back(status_cell(run));
    table.add_row(std::move(cells));
  }
  return table.text();
}

std::string measure_tables(std::span<const CampaignRun> runs) {
  std::string text;
  for (const Measure* measure : measures()) {
    if (measure->applies) continue;
    const std::vector<std::string> all = numbers_of(*measure, runs);
    std::span<const std::string> left = all;
    if (!left.empty()) text += fmt::format("{}: {}\n\n", measure->name, measure->summary);
    while (!left.empty()) {
      const std::size_t count = how_many_fit(*runs.front().experiment, left, measure->name);
      text += numbers_table(runs, left.first(count), measure->name) + "\n";
      left = left.subspan(count);
    }
  }
  return text;
}

}  // namespace bendlab
