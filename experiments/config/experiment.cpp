#include "experiments/config/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/scene_json.hpp"
#include "bendlab/scene/start_after.hpp"
#include "bendlab/settings/input_file.hpp"
#include "experiments/config/overrides.hpp"
#include "experiments/config/references.hpp"
#include "experiments/config/run_json.hpp"
#include "experiments/config/settings_by_pointer.hpp"

namespace bendlab {
namespace {

std::string read_file(const std::filesystem::path& file) try {
  constexpr std::uint64_t most = 64 << 20;  // bytes; a sweep of a million values has 20 MB
  return read_input_file(file, most);
} catch (const std::runtime_error& error) {
  throw ConfigError(file.string(), {{"", fmt::format("the file cannot be read: it {}", error.what())}});
}

// Removes `key` from the document and returns its value.
Json take(Json& document, const std::string& key, Json if_absent) {
  if (!document.contains(key)) return if_absent;
  Json value = std::move(document[key]);
  document.erase(key);
  return value;
}

// Problems of the settings outside the sweep. Swept settings may be missing: the sweep checks their values.
ConfigProblems problems_of(const Json& settings, const std::vector<Axis>& axes) {
  ConfigProblems found;
  read_run(with_first_values(settings, axes), found);
  const auto is_swept_gap = [&](const ConfigProblem& problem) {
    return std::ranges::any_of(axes, [&](const Axis& axis) {
      return lies_within(problem.pointer, axis.first) && value_at(settings, axis.first) == nullptr;
    });
  };
  std::erase_if(found, is_swept_gap);
  return found;
}

ConfigProblems joined(std::initializer_list<ConfigProblems> parts) {
  ConfigProblems all;
  for (const ConfigProblems& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

// Reports expectations that match no run, because such an expectation would check nothing.
void check_every_where_matches(const Experiment& experiment, ConfigProblems& problems) {
  for (std::size_t i = 0; i < experiment.expectations.size(); ++i)
    if (std::ranges::none_of(experiment.runs,
                             [&](const RunConfig& run) { return matches(experiment.expectations[i], run); }))
      problems.push_back({fmt::format("/expect/{}/where", i), "matches no run of this experiment"});
}

// Reports reasons for settings that do not exist.
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

// Checks the scenes of /initial/after before anything is computed. Reports only the first problem, because
// the other runs most likely have the same problem.
void check_earlier_scenes(const std::vector<RunConfig>& runs, std::string_view source_name) {
  for (const RunConfig& run : runs) try {
      earlier_scene(run.scene());
    } catch (const ConfigError& error) {
      throw ConfigError(std::string(source_name), {{"/initial/after", error.what()}});
    }
}

// The config's JSON with default effects filled in and overrides applied. Throws ConfigError if the text is
// no JSON object.
Json read_document(std::string_view text, std::string_view source_name,
                   std::span<const std::string> overrides, ConfigProblems& problems) {
  std::optional<Json> document = read_strict_json(text, problems);
  if (document && !document->is_object())
    problems.push_back({"", "a config must be a JSON object {\"name\": …, …}"});
  if (!document || !document->is_object()) throw ConfigError(source_name, std::move(problems));
  // The default effects are written out, so that overrides and axes can name their entries. An override may
  // choose other defaults, which have other effects.
  if (!document->contains("effects")) {
    Json chosen = *document;
    ConfigProblems reported_below;
    apply_overrides(chosen, overrides, reported_below);
    if (value_at(chosen, "/sweep/~1defaults") == nullptr) (*document)["effects"] = default_effects(chosen);
  }
  apply_overrides(*document, overrides, problems);
  return *std::move(document);
}

// `settings`: the config with its overrides. `of_text`: problems found in the text and in the overrides.
Experiment parse_document(Json settings, ConfigProblems of_text, std::string_view source_name,
                          const std::filesystem::path& folder, std::span<const std::string> overrides) {
  const Json schema = take(settings, "$schema", "");  // only editors read it
  const Json sweep = take(settings, "sweep", Json::object());
  const Json expect = take(settings, "expect", Json::array());
  const Json because = take(settings, "because", Json::object());
  const bool covered = settings.contains("cover");
  const Json given_cover = take(settings, "cover", Json());

  Experiment experiment;
  ConfigProblems of_settings, of_axes, of_values, of_lists, of_runs;
  if (!schema.is_string()) of_axes.push_back({"/$schema", "expected a text, got " + given_text(schema)});
  experiment.axes = read_axes(sweep, settings, covered, of_axes);
  experiment.expectations = read_expectations(expect, settings, of_lists);
  check_reasons(because, settings, of_lists);
  const std::optional<Cover> cover = covered ? read_cover(given_cover, of_lists) : std::nullopt;
  if (!cover) of_settings = problems_of(settings, experiment.axes);
  const bool sound = joined({of_text, of_settings, of_axes, of_lists}).empty();
  if (sound)
    experiment.runs = cover
                          ? expand_cover(settings, folder, experiment.axes, *cover, experiment.cover, of_runs)
                          : expand_sweep(settings, folder, experiment.axes, of_runs);
  // If a run is not valid, values are checked one by one, because the problem of a single value says more
  // than the problems of its combinations.
  if (!covered && !(sound && of_runs.empty())) check_values(settings, experiment.axes, of_values);
  // If no combination of a cover gives a valid run, the settings outside the sweep may be wrong.
  if (cover && experiment.runs.empty()) of_settings = problems_of(settings, experiment.axes);
  if (!of_values.empty() || !of_settings.empty()) of_runs.clear();
  experiment.settings = std::move(settings);
  ConfigProblems problems = joined({of_text, of_settings, of_axes, of_values, of_lists, of_runs});
  // Overrides may reduce the sweep so much that an expectation matches none of its runs.
  if (problems.empty() && overrides.empty()) check_every_where_matches(experiment, problems);
  if (!problems.empty()) throw ConfigError(source_name, std::move(problems));

  const RunSettings& first = experiment.runs.front().settings();
  experiment.name = first.name, experiment.description = first.description, experiment.allow = first.allow;
  check_earlier_scenes(experiment.runs, source_name);
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

Experiment experiment_of(const Json& resolved, std::string_view source_name) {
  ConfigProblems problems;
  Experiment experiment;
  experiment.runs = expand_sweep(resolved, {}, {}, problems);
  if (!problems.empty()) throw ConfigError(std::string(source_name), std::move(problems));
  check_earlier_scenes(experiment.runs, source_name);
  const RunSettings& run = experiment.runs.front().settings();
  experiment.name = run.name, experiment.description = run.description, experiment.allow = run.allow;
  experiment.settings = resolved;
  return experiment;
}

}  // namespace bendlab
