#include "experiments/config/references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

#include "bendlab/parameters/names.hpp"
#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/start_after.hpp"
#include "experiments/config/overrides.hpp"

namespace bendlab {
namespace {

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
  RunSettings changed = read_run(settings, problems);
  if (!problems.empty()) throw ConfigError(std::string(what), std::move(problems));
  return RunConfig(std::move(changed), folder);
}

RunConfig derive_reference(const RunConfig& config, std::span<const std::string> changes) {
  const Accuracy& accuracy = config.settings().accuracy;
  Json settings = config.resolved();
  if (accuracy.start_from_end)
    for (const char* start : {"after", "velocity", "spin"}) settings["initial"].erase(start);
  RunConfig reference = with_changes(std::move(settings), config.folder(), "the reference", changes);
  const MethodKind& method = reference.scene().solver.method.kind();
  if (accuracy.over_time && !method.has_motion)
    throw ConfigError(
        "the reference",
        {{"/solver/method", fmt::format("{} has no motion that could be compared over time", method.name)}});
  // Its folder's name depends on its own settings alone, so that several runs share one reference.
  for (const char* pointer : {"/bending/model", "/mesh/cells", "/solver/method", "/solver/substeps"})
    if (const Json* value = value_at(reference.resolved(), pointer))
      reference.point.emplace_back(pointer, *value);
  return reference;
}

bool same_run(const RunConfig& one, const RunConfig& other) {
  Json settings = one.resolved(), others = other.resolved();
  for (Json* each : {&settings, &others}) each->erase("accuracy");
  return identity_text(settings) == identity_text(others);
}

}  // namespace

std::optional<RunConfig> run_before(const RunConfig& config) {
  if (!config.scene().initial.after) return std::nullopt;
  return config.derived("before", [&] {
    RunSettings settings = config.settings();
    settings.scene = *earlier_scene(config.scene());
    settings.accuracy = {};
    return std::optional(RunConfig(std::move(settings), config.folder()));
  });
}

std::string_view name_of(Against against) {
  return name_in(against_names, against);
}

std::string reference_pointer(Against against, bool coarser) {
  return fmt::format("/accuracy/{}{}", name_of(against), coarser ? "_coarser" : "");
}

std::optional<RunConfig> reference_of(const RunConfig& config, Against against, bool coarser) {
  const Accuracy& accuracy = config.settings().accuracy;
  const bool solver = against == Against::solver;
  const auto& base = solver ? accuracy.solver : accuracy.physical;
  const auto& further = solver ? accuracy.solver_coarser : accuracy.physical_coarser;
  if (!(coarser ? further : base)) return std::nullopt;
  return config.derived(reference_pointer(against, coarser), [&] {
    std::vector<std::string> changes = *base;
    if (coarser) std::ranges::copy(*further, std::back_inserter(changes));
    return std::optional(derive_reference(config, changes));
  });
}

void check_references(const std::vector<RunConfig>& runs, std::string_view source_name) {
  for (const Against against : references)
    for (const bool coarser : {false, true}) {
      std::optional<std::string> wrong;
      bool one_is_right = false;
      for (const RunConfig& run : runs) try {
          const std::optional<RunConfig> reference = reference_of(run, against, coarser);
          const bool itself =
              reference && !run.settings().accuracy.start_from_end && same_run(run, *reference);
          if (itself && !wrong) wrong = "changes nothing: a run differs from itself by 0";
          one_is_right |= reference && !itself;
        } catch (const ConfigError& error) {
          if (!wrong) wrong = error.what();
        }
      if (wrong && !one_is_right)
        throw ConfigError(std::string(source_name), {{reference_pointer(against, coarser), *wrong}});
    }
}

}  // namespace bendlab
