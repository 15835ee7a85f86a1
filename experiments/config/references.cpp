#include "experiments/config/references.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

#include "bendlab/scene/pointers.hpp"
#include "bendlab/scene/start_after.hpp"
#include "bendlab/settings/names.hpp"
#include "experiments/config/overrides.hpp"
#include "experiments/config/run_json.hpp"

namespace bendlab {
namespace {

// Makes the reference of a run with `changes`: a single run, whose own errors are not measured.
RunConfig derive_reference(const RunConfig& config, std::span<const std::string> changes) {
  const std::string what = "the reference";
  for (const std::string& change : changes)
    for (const char* section : {"/sweep", "/expect", "/accuracy"})
      if (lies_within(change.substr(0, change.find('=')), section))
        throw ConfigError(what, {{section, fmt::format("cannot be changed: {} is a single run without sweep, "
                                                       "expectations and /accuracy; remove \"{}\"",
                                                       what, change)}});
  const Accuracy& accuracy = config.settings().accuracy;
  RunSettings run = config.settings();
  run.accuracy = {};
  if (Initial& initial = run.scene.initial; accuracy.start_from_end)
    initial.after.reset(), initial.velocity = Initial{}.velocity, initial.spin = Initial{}.spin;
  Json settings = to_json(run);
  settings["name"] = "changed";
  ConfigProblems problems;
  apply_overrides(settings, changes, problems);
  RunSettings changed = read_run(settings, problems);
  if (!problems.empty()) throw ConfigError(what, std::move(problems));
  RunConfig reference(std::move(changed), config.folder());
  const MethodKind& method = reference.scene().solver.method.kind();
  if (accuracy.over_time && !method.has_motion)
    throw ConfigError(
        what, {{"/solver/method",
                fmt::format("{} computes no motion, so nothing can be compared over time", method.name)}});
  // The name of the folder depends only on the reference's settings, so that runs can share a reference.
  for (const char* pointer : {"/bending/model", "/mesh/cells", "/solver/method", "/solver/substeps"})
    if (const Json* value = value_at(reference.resolved(), pointer))
      reference.point.emplace_back(pointer, *value);
  return reference;
}

// The settings that decide the result of the run, without /accuracy.
std::string identity_of(const RunConfig& config) {
  RunSettings settings = config.settings();
  settings.accuracy = {};
  return identity_text(to_json(settings));
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
          const bool itself = reference && !run.settings().accuracy.start_from_end &&
                              identity_of(run) == identity_of(*reference);
          if (itself && !wrong)
            wrong = "changes nothing: the reference is the run itself, so that every error is 0";
          one_is_right |= reference && !itself;
        } catch (const ConfigError& error) {
          if (!wrong) wrong = error.what();
        }
      if (wrong && !one_is_right)
        throw ConfigError(std::string(source_name), {{reference_pointer(against, coarser), *wrong}});
    }
}

}  // namespace bendlab
