#include "experiments/campaign/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "experiments/config/settings_by_pointer.hpp"
#include "experiments/measures/trajectory.hpp"

namespace bendlab {
namespace {

template <class Map>
std::set<std::string> names_in(const Map& one, const Map& other) {
  std::set<std::string> names;
  for (const Map* map : {&one, &other})
    for (const auto& [name, value] : *map) names.insert(name);
  return names;
}

std::optional<double> number_in(const std::map<std::string, double>& numbers, const std::string& name) {
  const auto found = numbers.find(name);
  return found == numbers.end() ? std::nullopt : std::optional(found->second);
}

bool same(const std::optional<double>& one, const std::optional<double>& other) {
  return one == other || (one && other && std::isnan(*one) && std::isnan(*other));
}

// Settings that differ between two configs, by pointer.
std::vector<ChangedSetting> changed_settings(const Json& one, const Json& other) {
  const std::map<std::string, Json> flat_one = flattened(one), flat_other = flattened(other);
  const auto value_in = [](const std::map<std::string, Json>& values, const std::string& pointer) {
    const auto found = values.find(pointer);
    return found == values.end() ? Json() : found->second;
  };
  std::vector<ChangedSetting> changed;
  for (const std::string& pointer : names_in(flat_one, flat_other))
    if (ChangedSetting setting{pointer, value_in(flat_one, pointer), value_in(flat_other, pointer)};
        setting.one != setting.other)
      changed.push_back(std::move(setting));
  return changed;
}

// Metrics that differ in any bit, the largest relative change first.
std::vector<ChangedNumber> changed_numbers(const std::map<std::string, double>& one,
                                           const std::map<std::string, double>& other) {
  std::vector<ChangedNumber> changed;
  for (const std::string& name : names_in(one, other)) {
    ChangedNumber number{name, number_in(one, name), number_in(other, name), std::nullopt};
    if (same(number.one, number.other)) continue;
    if (number.one && number.other && *number.one != 0) number.relative = *number.other / *number.one - 1;
    changed.push_back(std::move(number));
  }
  const auto size = [](const ChangedNumber& number) {
    return number.relative && !std::isnan(*number.relative) ? -std::abs(*number.relative)
                                                            : -std::numeric_limits<double>::infinity();
  };
  std::ranges::stable_sort(changed, {}, size);
  return changed;
}

}  // namespace

RunDifference difference(const RunRecord& one, const RunRecord& other) {
  RunDifference result;
  result.settings =
      changed_settings(Json::parse(one.config, nullptr, false), Json::parse(other.config, nullptr, false));
  result.summary = changed_numbers(one.summary, other.summary);
  result.differing_parts = differing_parts(one.file, other.file);
  try {
    result.cloth = errors_between(read_motion(one.file), read_motion(other.file), {.over_time = true});
  } catch (const std::invalid_argument& error) {
    result.no_cloth = error.what();
  }
  return result;
}

}  // namespace bendlab
