#include "experiments/campaign/run_labels.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "experiments/config/settings_by_pointer.hpp"
#include "experiments/terminal/table.hpp"

namespace bendlab {
namespace {

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return format_number(value.get<double>());
  return value.dump();
}

constexpr std::array<std::string_view, 2> named_first = {"/model", "/method"};  // shown without their key

// Names an object of an axis by the settings that differ between the objects: "quasi_newton, substeps 4".
std::string object_text(const Json& object, const std::vector<std::map<std::string, Json>>& flat_values) {
  const auto differs = [&](const std::string& key, const Json& value) {
    return flat_values.size() == 1 || std::ranges::any_of(flat_values, [&](const auto& other) {
             const auto found = other.find(key);
             return found == other.end() || found->second != value;
           });
  };
  std::vector<std::string> first, rest;
  for (const auto& [key, value] : flattened(object)) {
    if (!differs(key, value)) continue;
    if (std::ranges::find(named_first, key) != named_first.end())
      first.push_back(value_text(value));
    else
      rest.push_back(fmt::format("{} {}", key.substr(key.rfind('/') + 1), value_text(value)));
  }
  first.insert(first.end(), rest.begin(), rest.end());
  return first.empty() ? "as it is" : fmt::format("{}", fmt::join(first, ", "));
}

// If an axis has more objects than this, each object is shown as a whole. To compare the objects for every
// run would take too long.
constexpr std::size_t most_objects = 64;

std::string text_on_axis(const Json& value, const std::vector<Json>& values) {
  if (!value.is_object() || values.size() > most_objects || !std::ranges::all_of(values, &Json::is_object))
    return value_text(value);
  std::vector<std::map<std::string, Json>> flat;
  for (const Json& object : values) flat.push_back(flattened(object));
  std::string text = object_text(value, flat);
  const auto same = [&](const Json& object) { return object_text(object, flat) == text; };
  return std::ranges::count_if(values, same) > 1 ? value.dump() : text;
}

}  // namespace

std::vector<std::string> axis_headings(const Experiment& experiment) {
  std::vector<std::string> headings;
  for (const auto& [pointer, values] : experiment.axes)
    headings.push_back(pointer.substr(pointer.rfind('/') + 1));
  const std::vector<std::string> last_parts = headings;
  for (std::size_t i = 0; i < headings.size(); ++i)
    if (std::ranges::count(last_parts, last_parts[i]) > 1) headings[i] = experiment.axes[i].first;
  return headings;
}

std::vector<std::string> axis_cells(const Experiment& experiment, const RunConfig& config) {
  std::vector<std::string> cells;
  for (const auto& [pointer, values] : experiment.axes) {
    const auto found = std::ranges::find(config.point, pointer, &std::pair<std::string, Json>::first);
    cells.push_back(found == config.point.end() ? "" : text_on_axis(found->second, values));
  }
  return cells;
}

std::string place_text(const Experiment& experiment, const RunConfig& config) {
  if (config.point.empty()) return experiment.name;
  const std::vector<std::string> headings = axis_headings(experiment), cells = axis_cells(experiment, config);
  std::string text;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (!cells[i].empty()) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", headings[i], cells[i]);
  return text;
}

std::string run_text(const Experiment& experiment, const RunConfig& config) {
  return config.point.empty() ? experiment.name
                              : fmt::format("{} ({})", experiment.name, place_text(experiment, config));
}

}  // namespace bendlab
