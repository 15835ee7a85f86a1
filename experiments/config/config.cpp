#include "experiments/config/config.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bendlab/parameters/input_file.hpp"
#include "bendlab/parameters/names.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/config_tables.hpp"
#include "experiments/config/defaults.hpp"
#include "experiments/config/expectations.hpp"
#include "experiments/config/overrides.hpp"
#include "experiments/config/pointers.hpp"
#include "experiments/config/resolve.hpp"
#include "experiments/config/sweep.hpp"

namespace bendlab {
namespace {

std::string read_file(const std::filesystem::path& file) try {
  constexpr std::uint64_t most = 64 << 20;  // bytes: a million values of a sweep have 20 MB
  return read_input_file(file, most);
} catch (const std::runtime_error& error) {
  throw ConfigError(file.string(), {{"", fmt::format("the file cannot be read: it {}", error.what())}});
}

// Takes `key` out of the document.
Json take(Json& document, const std::string& key, Json if_absent) {
  if (!document.contains(key)) return if_absent;
  Json value = std::move(document[key]);
  document.erase(key);
  return value;
}

// The settings as they stand, but where an axis fills a gap: its own values are checked with the sweep.
void check_settings(const Json& settings, const std::vector<Axis>& axes, ConfigProblems& problems) {
  ConfigProblems found;
  resolve(with_first_values(settings, axes), found);
  const auto is_swept_gap = [&](const ConfigProblem& problem) {
    return std::ranges::any_of(axes, [&](const Axis& axis) {
      return lies_within(problem.pointer, axis.first) && value_at(settings, axis.first) == nullptr;
    });
  };
  std::erase_if(found, is_swept_gap);
  problems.insert(problems.begin(), found.begin(), found.end());
}

// An expectation that no run can meet checks nothing, which nobody would notice.
void check_every_where_matches(const Experiment& experiment, ConfigProblems& problems) {
  for (std::size_t i = 0; i < experiment.expectations.size(); ++i)
    if (std::ranges::none_of(experiment.runs, [&](const RunConfig& run) {
          return matches(experiment.expectations[i], experiment, run);
        }))
      problems.push_back({fmt::format("/expect/{}/where", i), "matches no run of this experiment"});
}

// A reason for a setting that isn't there would mislead.
void check_reasons(const Json& because, const Json& settings, ConfigProblems& problems) {
  if (!because.is_object()) {
    problems.push_back(
        {"/because", "expected an object {\"/json/pointer\": text}, got " + given_text(because)});
    return;
  }
  const std::vector<std::string> known = known_pointers(settings);
  for (const auto& [pointer, reason] : because.items())
    if (const std::string place = child_pointer("/because", pointer);
        std::ranges::find(known, pointer) == known.end())
      problems.push_back({place, unknown_pointer_text(pointer, known)});
    else if (!reason.is_string() || reason.get_ref<const std::string&>().empty())
      problems.push_back({place, "expected a text that gives the reason, got " + given_text(reason)});
}

Experiment parse_document(Json settings, ConfigProblems reading, std::string_view source_name,
                          const std::filesystem::path& folder, std::span<const std::string> overrides);

// A run of these settings, changed: one run, which has no errors of its own.
RunConfig with_changes(Json settings, const std::filesystem::path& folder, std::string_view what,
                       std::span<const std::string> changes) {
  for (const std::string& change : changes)
    for (const char* section : {"/sweep", "/expect", "/accuracy"})
      if (lies_within(change.substr(0, change.find('=')), section))
        throw ConfigError(
            std::string(what),
            {{section, fmt::format("cannot be changed: {} is one run, with neither a sweep nor errors of "
                                   "its own; remove \"{}\"",
                                   what, change)}});
  settings["name"] = "changed";
  settings["accuracy"] = Json::object();
  ConfigProblems problems;
  apply_overrides(settings, changes, problems);
  return parse_document(std::move(settings), std::move(problems), what, folder, changes).runs.front();
}

RunConfig derive_reference(const RunConfig& config, std::span<const std::string> changes) {
  const ParameterValues& accuracy = config.section("/accuracy");
  Json settings = config.resolved();
  if (accuracy.boolean("start_from_end"))
    for (const char* start : {"after", "velocity", "spin"}) settings["initial"].erase(start);
  RunConfig reference = with_changes(std::move(settings), config.folder(), "the reference", changes);
  const std::string& method = reference.section("/solver").text("method");
  if (accuracy.boolean("over_time") && !find_method(method)->has_motion)
    throw ConfigError(
        "the reference",
        {{"/solver/method", fmt::format("{} has no motion that could be compared over time", method)}});
  // Its folder's name depends on its own settings alone, so that several runs share one reference.
  for (const char* pointer : {"/bending/model", "/mesh/cells", "/solver/method", "/solver/substeps"})
    if (const Json* value = value_at(reference.resolved(), pointer))
      reference.point.emplace_back(pointer, *value);
  return reference;
}

// Before anything is computed; the first that is wrong, others most likely are for the same reason.
void check_runs_before(const std::vector<RunConfig>& runs, std::string_view source_name) {
  for (const RunConfig& run : runs) try {
      run_before(run);
    } catch (const ConfigError& error) {
      throw ConfigError(std::string(source_name), {{"/initial/after", error.what()}});
    }
}

bool same_run(const RunConfig& one, const RunConfig& other) {
  Json settings = one.resolved(), others = other.resolved();
  for (Json* each : {&settings, &others}) each->erase("accuracy");
  return identity_text(settings) == identity_text(others);
}

// A reference that no run can have is a mistake, as is one that is the run itself; one that some can't (k has
// no energy) is reported by those runs.
void check_references(const std::vector<RunConfig>& runs, std::string_view source_name) {
  for (const Against against : references)
    for (const bool coarser : {false, true}) {
      std::optional<std::string> wrong;
      bool one_is_right = false;
      for (const RunConfig& run : runs) try {
          const std::optional<RunConfig> reference = reference_of(run, against, coarser);
          const bool itself =
              reference && !run.section("/accuracy").boolean("start_from_end") && same_run(run, *reference);
          if (itself && !wrong) wrong = "changes nothing: a run differs from itself by 0";
          one_is_right |= reference && !itself;
        } catch (const ConfigError& error) {
          if (!wrong) wrong = error.what();
        }
      if (wrong && !one_is_right)
        throw ConfigError(std::string(source_name), {{reference_pointer(against, coarser), *wrong}});
    }
}

// The config's JSON with default effects and overrides in place; ConfigError where it is no JSON object at
// all.
Json read_document(std::string_view text, std::string_view source_name,
                   std::span<const std::string> overrides, ConfigProblems& problems) {
  std::optional<Json> document = read_strict_json(text, problems);
  if (document && !document->is_object())
    problems.push_back({"", "a config is a JSON object {\"name\": …, …}"});
  if (!document || !document->is_object()) throw ConfigError(source_name, std::move(problems));
  // Written out, so that overrides and axes can name their entries.
  // Which effects they are an override may say.
  if (!document->contains("effects")) {
    Json chosen = *document;
    ConfigProblems told_below;
    apply_overrides(chosen, overrides, told_below);
    if (value_at(chosen, "/sweep/~1defaults") == nullptr) (*document)["effects"] = default_effects(chosen);
  }
  apply_overrides(*document, overrides, problems);
  return *std::move(document);
}

// `reading`: what was wrong in the text, or in the overrides that `settings` has.
Experiment parse_document(Json settings, ConfigProblems reading, std::string_view source_name,
                          const std::filesystem::path& folder, std::span<const std::string> overrides) {
  const Json schema = take(settings, "$schema", "");  // for editors
  const Json sweep = take(settings, "sweep", Json::object());
  const Json expect = take(settings, "expect", Json::array());
  const Json because = take(settings, "because", Json::object());
  const bool covered = settings.contains("cover");
  const Json given_cover = take(settings, "cover", Json());

  Experiment experiment;
  ConfigProblems problems;
  if (!schema.is_string()) problems.push_back({"/$schema", "expected a text, got " + given_text(schema)});
  experiment.axes = read_axes(sweep, settings, covered, problems);
  const std::size_t of_axes = problems.size();
  experiment.expectations = read_expectations(expect, settings, problems);
  check_reasons(because, settings, problems);
  const std::optional<Cover> cover = covered ? read_cover(given_cover, problems) : std::nullopt;
  ConfigProblems beside_axes;
  if (!cover) check_settings(settings, experiment.axes, beside_axes);
  beside_axes.insert(beside_axes.begin(), reading.begin(), reading.end());
  problems.insert(problems.begin(), beside_axes.begin(), beside_axes.end());
  const std::size_t before_runs = problems.size();
  if (problems.empty())
    experiment.runs =
        cover ? expand_cover(settings, folder, experiment.axes, *cover, experiment.cover, problems)
              : expand_sweep(settings, folder, experiment.axes, problems);
  // Where all runs are right, all values are. Where not, a value alone says more than its combinations.
  if (!covered && !problems.empty()) {
    ConfigProblems of_values;
    check_values(settings, experiment.axes, of_values);
    if (before_runs == 0 && !of_values.empty()) problems.clear();
    const std::size_t place = before_runs == 0 ? 0 : beside_axes.size() + of_axes;
    problems.insert(problems.begin() + static_cast<std::ptrdiff_t>(place), of_values.begin(),
                    of_values.end());
  }
  // What no combination mends is wrong beside the sweep; without an axis there is nothing else to be wrong.
  if (cover && experiment.runs.empty()) {
    ConfigProblems beside;
    check_settings(settings, experiment.axes, beside);
    if (!beside.empty()) problems.resize(before_runs);
    problems.insert(problems.end(), beside.begin(), beside.end());
  }
  experiment.settings = std::move(settings);
  // With overrides the sweep may be a part of the one that the expectations were written for.
  if (problems.empty() && overrides.empty()) check_every_where_matches(experiment, problems);
  if (!problems.empty()) throw ConfigError(source_name, std::move(problems));

  experiment.name = experiment.settings["name"];
  experiment.description = experiment.settings.value("description", "");
  if (const Json* allow = value_at(experiment.settings, "/allow"); allow != nullptr && allow->is_array())
    experiment.allow = *allow;
  check_runs_before(experiment.runs, source_name);
  check_references(experiment.runs, source_name);
  return experiment;
}

Experiment parse(std::string_view text, std::string_view source_name, const std::filesystem::path& source,
                 std::span<const std::string> overrides) {
  ConfigProblems problems;
  Json settings = read_document(text, source_name, overrides, problems);
  Experiment experiment =
      parse_document(std::move(settings), std::move(problems), source_name, source.parent_path(), overrides);
  experiment.source = source;
  experiment.overrides.assign(overrides.begin(), overrides.end());
  return experiment;
}

}  // namespace

bool Experiment::allows(RunStatus status) const {
  return std::ranges::find(allow, to_string(status)) != allow.end();
}

std::optional<RunConfig> run_before(const RunConfig& config) {
  const ParameterValues& initial = config.section("/initial");
  if (!initial.has("after")) return std::nullopt;
  return config.derived("before", [&] {
    Json settings = config.resolved();
    settings["initial"].erase("after");
    return std::optional(
        with_changes(std::move(settings), config.folder(), "the run before", initial.texts("after")));
  });
}

std::string_view name_of(Against against) {
  return name_in(against_names, against);
}

std::string reference_pointer(Against against, bool coarser) {
  return fmt::format("/accuracy/{}{}", name_of(against), coarser ? "_coarser" : "");
}

std::optional<RunConfig> reference_of(const RunConfig& config, Against against, bool coarser) {
  const ParameterValues& accuracy = config.section("/accuracy");
  const std::string name(name_of(against)), coarser_name = name + "_coarser";
  if (!accuracy.has(coarser ? coarser_name : name)) return std::nullopt;
  return config.derived(coarser ? coarser_name : name, [&] {
    std::vector<std::string> changes = accuracy.texts(name);
    if (coarser) std::ranges::copy(accuracy.texts(coarser_name), std::back_inserter(changes));
    return std::optional(derive_reference(config, changes));
  });
}

Experiment load_experiment(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse(read_file(file), file.string(), file, overrides);
}

Experiment parse_experiment(std::string_view text, std::string_view source_name,
                            std::span<const std::string> overrides) {
  return parse(text, source_name, {}, overrides);
}

Experiment parse_config(std::string_view text, const std::filesystem::path& source,
                        std::span<const std::string> overrides) {
  return parse(text, source.string(), source, overrides);
}

}  // namespace bendlab
