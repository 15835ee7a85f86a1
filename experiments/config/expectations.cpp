#include "experiments/config/expectations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bendlab/io/without_traps.hpp"
#include "bendlab/scene/fields_json.hpp"
#include "bendlab/scene/nearest_name.hpp"
#include "experiments/config/run_json.hpp"
#include "experiments/config/settings_by_pointer.hpp"

namespace bendlab {
namespace {

// clang-format off
constexpr std::array expectation_fields = {
    field<&Expectation::metric>({.name = "metric",
              .meaning = "Name of a metric in the run's summary",
              .required = true}),
    field<&Expectation::minimum>({.name = "min",
              .meaning = "Smallest accepted value, in the metric's unit; give min, max or both"}),
    field<&Expectation::maximum>({.name = "max",
              .meaning = "Largest accepted value, in the metric's unit"}),
    field<&Expectation::why>({.name = "why",
              .meaning = "Where the bound comes from",
              .required = true}),
};
// clang-format on

Json read_where(const Json& entry, const std::string& pointer, const Json& settings,
                ConfigProblems& problems) {
  if (!entry.contains("where")) return Json::object();
  const Json& where = entry["where"];
  const std::string place = child_pointer(pointer, "where");
  if (!where.is_object()) {
    problems.push_back({place, "expected an object {\"/json/pointer\": value}"});
    return Json::object();
  }
  const std::vector<std::string> known = known_pointers(settings);
  for (const auto& [key, value] : where.items())
    if (std::ranges::find(known, key) == known.end())
      problems.push_back({child_pointer(place, key), unknown_pointer_text(key, known)});
    else
      check_value(settings, key, value, child_pointer(place, key), problems);
  return where;
}

Expectation read_expectation(const Json& entry, const std::string& pointer, const Json& settings,
                             ConfigProblems& problems) {
  Expectation expectation;
  if (!entry.is_object()) {
    problems.push_back({pointer, "expected an object with metric, min and/or max, and why"});
    return expectation;
  }
  constexpr std::array<std::string_view, 1> where = {"where"};
  const std::size_t before = problems.size();
  read_fields(expectation_table(), &expectation, entry, pointer, where, problems);
  expectation.where = read_where(entry, pointer, settings, problems);
  if (problems.size() > before) return expectation;
  if (!expectation.minimum && !expectation.maximum)
    problems.push_back({pointer, "has no bound: give min, max or both"});
  if (expectation.minimum && expectation.maximum && *expectation.minimum > *expectation.maximum)
    problems.push_back({pointer, "can never hold: min is larger than max"});
  return expectation;
}

std::string bound_text(const Expectation& expectation) {
  std::string text;
  if (expectation.minimum) text += fmt::format("at least {}", *expectation.minimum);
  if (expectation.minimum && expectation.maximum) text += " and ";
  if (expectation.maximum) text += fmt::format("at most {}", *expectation.maximum);
  return text;
}

ExpectationResult check(const Expectation& expectation, const std::map<std::string, double>& summary) {
  ExpectationResult result{expectation, std::nullopt, false, ""};
  const auto found = summary.find(expectation.metric);
  if (found == summary.end()) {
    std::vector<std::string> metrics;
    for (const auto& [name, value] : summary) metrics.push_back(name);
    result.message = fmt::format(
        "the run has no metric '{}'{} (`bendlab measures` lists all metrics, and which runs have a metric; "
        "`bendlab show` lists the metrics of a run)",
        expectation.metric, suggestion(expectation.metric, metrics));
    return result;
  }
  result.measured = found->second;
  const WithoutTraps traps_are_off;  // fmt compares the NaNs that it prints
  // Written so that NaN fails.
  result.holds = (!expectation.minimum || std::isgreaterequal(found->second, *expectation.minimum)) &&
                 (!expectation.maximum || std::islessequal(found->second, *expectation.maximum));
  result.message = fmt::format("{} = {:.6g}, expected {}: {}", expectation.metric, found->second,
                               bound_text(expectation), expectation.why);
  return result;
}

}  // namespace

const FieldTable& expectation_table() {
  static const FieldTable table = table_of<Expectation>(expectation_fields);
  return table;
}

std::vector<Expectation> read_expectations(const Json& expect, const Json& settings,
                                           ConfigProblems& problems) {
  std::vector<Expectation> expectations;
  if (!expect.is_array()) {
    problems.push_back({"/expect", "expected a list of objects with metric, min and/or max, and why"});
    return expectations;
  }
  constexpr std::size_t most = 1000;
  if (expect.size() > most) {
    problems.push_back(
        {"/expect", fmt::format("has {} entries, and at most {} are allowed", expect.size(), most)});
    return expectations;
  }
  for (std::size_t i = 0; i < expect.size(); ++i)
    expectations.push_back(read_expectation(expect[i], fmt::format("/expect/{}", i), settings, problems));
  return expectations;
}

bool matches(const Expectation& expectation, const RunConfig& config) {
  // A run matches a value if setting this value does not change the run. So 16 matches 16.0, and {} matches
  // defaults.
  return std::ranges::all_of(expectation.where.items(), [&](const auto& entry) {
    if (entry.key() == "/defaults") return entry.value() == config.settings().defaults;
    const Json* const own = value_at(config.resolved(), entry.key());
    if (own == nullptr) return entry.value().is_null();
    if (*own == entry.value()) return true;
    if (own->is_number() && entry.value().is_number()) return false;
    Json changed = config.resolved();
    changed["name"] = "any";
    ConfigProblems problems;
    return set_at(changed, entry.key(), entry.value()) &&
           to_json(read_run(changed, problems)) == config.resolved() && problems.empty();
  });
}

std::vector<ExpectationResult> check_expectations(const std::vector<Expectation>& expectations,
                                                  const RunConfig& config,
                                                  const std::map<std::string, double>& summary) {
  std::vector<ExpectationResult> results;
  for (const Expectation& expectation : expectations)
    if (matches(expectation, config)) results.push_back(check(expectation, summary));
  return results;
}

}  // namespace bendlab
