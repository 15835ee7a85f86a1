#include "experiments/run/set_up.hpp"

#include "bendlab/scene/start_after.hpp"
#include "experiments/config/references.hpp"
#include "experiments/config/run_json.hpp"
#include "experiments/run/needs.hpp"
#include "experiments/run/recorder.hpp"
#include "experiments/run/warnings.hpp"

namespace bendlab {
namespace {

// Lets `scene` start after an earlier run whose last pose is not known yet. The start pose of the earlier run
// replaces the last pose, because the two poses have the same mesh.
void start_after_unknown(const RunConfig& config, BuiltScene& scene) {
  const std::optional<RunConfig> before = run_before(config);
  if (!before) return;
  BuiltScene first = build_scene(before->scene());
  start_after_unknown(*before, first);
  simulation_of(first);
  start_from(scene, {first.rest, first.input.positions}, "/initial/after");
}

}  // namespace

std::vector<Warning> set_up(const Experiment& experiment, const RunConfig& config) {
  require_memory(config);
  BuiltScene scene = build_scene(config.scene());
  const Recorder recorder(config, scene);
  simulation_of(scene);
  std::vector<Warning> warnings = warnings_of(WarningInput{experiment, config, scene});
  start_after_unknown(config, scene);
  return warnings;
}

std::string text_of_set_up(const RunConfig& config) {
  RunSettings settings = config.settings();
  settings.output = {.measures = settings.output.measures};
  settings.accuracy = {}, settings.quality = {};
  settings.scene.initial.seed = Initial{}.seed, settings.scene.mesh.seed = Mesh{}.seed;
  return to_json(settings).dump();
}

}  // namespace bendlab
