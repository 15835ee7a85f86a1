#include "experiments/run/own_code.hpp"

#include <algorithm>
#include <vector>

#include "bendlab/parameters/input_file.hpp"
#include "experiments/measures/measure.hpp"
#include "experiments/run/run.hpp"

namespace bendlab {
namespace {

bool has_added_kind(const Scene& scene) {
  const auto is_in = [](const auto& added, const auto& kind) {
    return std::ranges::find(added, &kind) != added.end();
  };
  return is_in(added_bending_models(), scene.bending.model.kind()) ||
         is_in(added_methods(), scene.solver.method.kind()) ||
         std::ranges::any_of(scene.effects,
                             [&](const Effect& effect) { return is_in(added_effects(), effect.kind()); });
}

// Whether a measure applies is known only when there is a scene: here it counts if it may.
bool may_have_added_measure(const RunConfig& config) {
  const std::vector<std::string>& asked = config.settings().output.measures;
  return std::ranges::any_of(added_measures(), [&](const Measure* measure) {
    return measure->applies != nullptr || std::ranges::find(asked, measure->name) != asked.end();
  });
}

}  // namespace

std::string own_code_hash(const RunConfig& config) {
  if (!has_added_kind(config.scene()) && !may_have_added_measure(config)) return "";
  static const std::string hash = hex_hash(read_input_file("/proc/self/exe"));
  return hash;
}

}  // namespace bendlab
