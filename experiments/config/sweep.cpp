#include "experiments/config/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <unordered_set>

#include "bendlab/scene/fields_json.hpp"
#include "experiments/config/in_parallel.hpp"
#include "experiments/config/run_json.hpp"
#include "experiments/config/settings_by_pointer.hpp"

namespace bendlab {
namespace {

constexpr std::size_t most_points = 10000;  // a typing error in a list must not fill the memory

// clang-format off
constexpr std::array cover_fields = {
    field<&Cover::strength>({.name = "strength", .unit = "1",
              .meaning = "Every combination of the values of this many axes occurs in a run: 2 covers every "
                         "pair of values",
              .minimum = 1, .maximum = 6, .required = true}),
    field<&Cover::seed>({.name = "seed", .unit = "1",
              .meaning = "Another seed gives different runs with the same coverage",
              .minimum = 0, .maximum = std::numeric_limits<std::uint32_t>::max()}),
};
// clang-format on

// The same value in canonical form: 16 and 16.0 are equal values of a setting.
Json normalised(const Json& settings, const std::string& pointer, const Json& value) {
  const Field* row = find_setting(settings, pointer);
  if (row == nullptr) return value;
  ConfigProblems problems;  // check_values() reports them
  const std::optional<Value> read = read_value(*row, value, pointer, problems);
  return read ? json_of(*read) : value;
}

// The swept values: the list as written, or for "all" every choice of the setting that the config allows. For
// example, a method does not allow every model.
Json listed(const Json& settings, const std::string& pointer, const Json& values) {
  const Field* row = values == "all" ? find_setting(settings, pointer) : nullptr;
  if (row == nullptr || row->choices.empty()) return values;
  Json all = Json::array();
  for (const std::string_view choice : row->choices) {
    Json with_choice = settings;
    ConfigProblems problems;
    if (set_at(with_choice, pointer, choice)) read_run(with_choice, problems);
    if (std::ranges::find(problems, pointer, &ConfigProblem::pointer) == problems.end())
      all.push_back(choice);
  }
  return all;
}

std::string axis_pointer(const std::string& pointer) {
  return child_pointer("/sweep", pointer);
}

// Whether the run depends on the setting at `pointer`: the resolved settings have the setting, or the object
// that contains the setting.
bool depends_on(const Json& resolved, const std::string& pointer) {
  return value_at(resolved, pointer) != nullptr ||
         value_at(resolved, pointer.substr(0, pointer.rfind('/'))) != nullptr;
}

// Replaces `indices` (of a value on each axis) by those of the next combination. False after the last one.
bool advance(std::vector<std::size_t>& indices, const std::vector<Axis>& axes) {
  for (std::size_t a = axes.size(); a-- > 0;) {
    if (++indices[a] < axes[a].second.size()) return true;
    indices[a] = 0;
  }
  return false;
}

std::string tuple_text(const std::vector<Axis>& axes, const CoverTuple& tuple) {
  std::vector<std::string> parts;
  for (const auto& [axis, value] : tuple)
    parts.push_back(fmt::format("{} = {}", axes[axis].first, axes[axis].second[value].dump()));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string point_text(const std::vector<Axis>& axes, const std::vector<std::size_t>& indices) {
  CoverTuple whole;
  for (std::size_t a = 0; a < axes.size(); ++a) whole.emplace_back(a, indices[a]);
  return tuple_text(axes, whole);
}

// The run with one combination of swept values. Appends the problems of values that cannot be combined.
RunConfig make_run(Json settings, const std::filesystem::path& folder, const std::vector<Axis>& axes,
                   const std::vector<std::size_t>& indices, ConfigProblems& problems) {
  for (std::size_t a = 0; a < axes.size(); ++a)
    if (!set_at(settings, axes[a].first, axes[a].second[indices[a]]))
      problems.push_back(
          {axis_pointer(axes[a].first),
           "the config has no object that can hold this setting at " + point_text(axes, indices)});
  ConfigProblems found;
  RunSettings read = read_run(settings, found);
  for (const ConfigProblem& problem : found)
    problems.push_back({problem.pointer, axes.empty() ? problem.message
                                                      : fmt::format("{} (at {})", problem.message,
                                                                    point_text(axes, indices))});
  if (!problems.empty()) return {};
  RunConfig run(std::move(read), folder);
  for (std::size_t a = 0; a < axes.size(); ++a)
    if (depends_on(run.resolved(), axes[a].first))
      run.point.emplace_back(axes[a].first, axes[a].second[indices[a]]);
  return run;
}

// If several runs have equal settings, keeps only the first of these runs.
std::vector<RunConfig> without_repeats(std::vector<RunConfig> runs) {
  const auto hash = [](const RunConfig& run) { return std::hash<Json>()(run.resolved()); };
  const auto equal = [](const RunConfig& a, const RunConfig& b) { return a.resolved() == b.resolved(); };
  std::unordered_set<RunConfig, decltype(hash), decltype(equal)> seen(2 * runs.size(), hash, equal);
  std::erase_if(runs, [&](const RunConfig& run) { return !seen.insert(run).second; });
  return runs;
}

}  // namespace

std::vector<Axis> read_axes(const Json& sweep, const Json& settings, bool covered, ConfigProblems& problems) {
  std::vector<Axis> axes;
  if (!sweep.is_object()) {
    problems.push_back({"/sweep", "expected an object {\"/json/pointer\": [values]}"});
    return axes;
  }
  const std::vector<std::string> known = known_pointers(settings);
  std::size_t points = 1;
  bool too_long = false;
  for (const auto& [pointer, given] : sweep.items()) {
    const Json values = listed(settings, pointer, given);
    const auto contained = std::ranges::find_if(
        axes, [&within = pointer](const Axis& a) { return lies_within(a.first, within); });
    if (std::ranges::find(known, pointer) == known.end())
      problems.push_back({axis_pointer(pointer), "cannot be swept: " + unknown_pointer_text(pointer, known)});
    else if (!values.is_array() || values.empty())
      problems.push_back({axis_pointer(pointer),
                          "expected a list of at least one value to sweep, or \"all\" for every choice of a "
                          "setting that has choices"});
    else if (contained != axes.end())
      problems.push_back(
          {axis_pointer(pointer), fmt::format("would overwrite the values of '{}': list the object first, "
                                              "and then the settings inside the object",
                                              contained->first)});
    else if (values.size() > most_points) {
      too_long = true;
      problems.push_back(
          {axis_pointer(pointer), fmt::format("has {} values, and a sweep has at most {} runs; shorten the "
                                              "list, or split the sweep into several configs",
                                              values.size(), most_points)});
    } else {
      Axis& axis = axes.emplace_back(pointer, std::vector<Json>());
      for (const Json& value : values) axis.second.push_back(normalised(settings, pointer, value));
      points = std::min(points * values.size(), most_points + 1);
    }
  }
  if (!covered && !too_long && points > most_points)
    problems.push_back(
        {"/sweep",
         fmt::format("has more than {} combinations; shorten the lists, split the sweep into several "
                     "configs, or add \"cover\": 2 to run a part of the sweep that has every pair of values",
                     most_points)});
  return axes;
}

void check_values(const Json& settings, const std::vector<Axis>& axes, ConfigProblems& problems) {
  std::size_t values = 0;
  for (const Axis& axis : axes) values += axis.second.size();
  if (values > most_points) return;  // read_axes() reports that
  const Json base = with_first_values(settings, axes);
  ConfigProblems known;
  read_run(base, known);
  for (const auto& [pointer, listed_values] : axes)
    for (std::size_t i = 0; i < listed_values.size(); ++i) {
      const std::string place = child_pointer(axis_pointer(pointer), std::to_string(i));
      for (const ConfigProblem& other : check_value(base, pointer, listed_values[i], place, problems))
        if (std::ranges::find(known, other) == known.end())
          problems.push_back({place, fmt::format("with this value {}: {}", other.pointer, other.message)});
    }
}

const FieldTable& cover_table() {
  static const FieldTable table = table_of<Cover>(cover_fields);
  return table;
}

std::optional<Cover> read_cover(const Json& cover, ConfigProblems& problems) {
  Json given = cover;
  if (cover.is_number()) given = Json({{"strength", cover}});
  if (!given.is_object()) {
    problems.push_back({"/cover",
                        "expected a strength (a number of axes), such as \"cover\": 2, or an object "
                        "{\"strength\": 2, \"seed\": 1}"});
    return std::nullopt;
  }
  const std::size_t before = problems.size();
  Cover read;
  read_fields(cover_table(), &read, given, "/cover", {}, problems);
  return problems.size() == before ? std::optional(read) : std::nullopt;
}

Json with_first_values(const Json& settings, const std::vector<Axis>& axes) {
  Json filled = settings;
  for (const auto& [pointer, values] : axes)
    if (value_at(filled, pointer) == nullptr) set_at(filled, pointer, values.front());
  return filled;
}

std::vector<RunConfig> expand_sweep(const Json& settings, const std::filesystem::path& folder,
                                    const std::vector<Axis>& axes, ConfigProblems& problems) {
  struct Point {
    std::vector<std::size_t> indices;
    RunConfig run;
    ConfigProblems problems;
  };
  std::vector<Point> points;
  std::vector<std::size_t> indices(axes.size(), 0);
  do points.push_back({indices, {}, {}});
  while (advance(indices, axes));
  in_parallel(points.size(), 200, [&](std::size_t i) {
    points[i].run = make_run(settings, folder, axes, points[i].indices, points[i].problems);
  });
  std::vector<RunConfig> runs;
  for (Point& point : points) {
    problems.insert(problems.end(), point.problems.begin(), point.problems.end());
    if (!problems.empty()) return runs;
    runs.push_back(std::move(point.run));
  }
  return without_repeats(std::move(runs));
}

std::vector<RunConfig> expand_cover(const Json& settings, const std::filesystem::path& folder,
                                    const std::vector<Axis>& axes, const Cover& cover, Covered& covered,
                                    ConfigProblems& problems) {
  std::vector<std::size_t> sizes;
  for (const Axis& axis : axes) sizes.push_back(axis.second.size());
  std::map<CoverTuple, ConfigProblem> why;  // a value → the problem of a run with it
  std::vector<RunConfig> allowed_runs;
  const auto allowed = [&](const CoverRow& row) {
    ConfigProblems found;
    RunConfig run = make_run(settings, folder, axes, row, found);
    if (found.empty()) allowed_runs.push_back(std::move(run));
    for (std::size_t a = 0; a < axes.size() && !found.empty(); ++a) why[{{a, row[a]}}] = found.front();
    return found.empty();
  };
  const CoverRows covering = [&] {
    try {
      return covering_rows(sizes, cover, allowed, most_points);
    } catch (const std::invalid_argument& error) {
      problems.push_back({"/cover", error.what()});
      return CoverRows();
    }
  }();
  if (covering.rows.size() > most_points)
    problems.push_back(
        {"/cover", fmt::format("needs more than {} runs; choose a smaller strength, or shorten the lists "
                               "of the sweep",
                               most_points)});
  for (const CoverTuple& tuple : covering.impossible)
    if (tuple.size() == 1) {
      const auto& [axis, value] = tuple.front();
      problems.push_back(
          {child_pointer(axis_pointer(axes[axis].first), std::to_string(value)),
           fmt::format("gives an error in every combination that was tried; the last error is in {}: {}",
                       why[tuple].pointer, why[tuple].message)});
    } else {
      covered.refused.push_back(tuple_text(axes, tuple));
    }
  covered.strength = cover.strength;
  covered.tuples = covering.tuples;
  covered.missing = covering.missing;

  return without_repeats(std::move(allowed_runs));
}

}  // namespace bendlab
