#include "experiments/campaign/run_labels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return format_number(value.get<double>());
  return value.dump();
}

}  // namespace

std::vector<std::string> axis_headings(const Experiment& experiment) {
  std::vector<std::string> headings;
  for (const auto& [pointer, values] : experiment.axes)
    headings.push_back(pointer.substr(pointer.rfind('/') + 1));
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const bool alike = std::ranges::count(headings, headings[i]) > 1;
    if (alike) headings[i] = experiment.axes[i].first;
  }
  return headings;
}

std::vector<std::string> axis_cells(const Experiment& experiment, const RunConfig& config) {
  std::vector<std::string> cells;
  for (const auto& [pointer, values] : experiment.axes) {
    const auto found = std::ranges::find(config.point, pointer, &std::pair<std::string, Json>::first);
    cells.push_back(found == config.point.end() ? "" : value_text(found->second));
  }
  return cells;
}

std::string place_text(const CampaignRun& run) {
  if (run.config->point.empty()) return run.experiment->name;
  const std::vector<std::string> headings = axis_headings(*run.experiment);
  const std::vector<std::string> cells = axis_cells(*run.experiment, *run.config);
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!cells[i].empty()) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", headings[i], cells[i]);
  return text;
}

std::string run_text(const CampaignRun& run) {
  if (run.config->point.empty()) return run.experiment->name;
  return fmt::format("{} ({})", run.experiment->name, place_text(run));
}

}  // namespace bendlab
