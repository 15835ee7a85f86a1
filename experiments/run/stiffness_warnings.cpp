// Warnings about a stiffness that is not what was stated.
#include "bendlab/bending/push_bound.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/measures/strip_doubts.hpp"
#include "experiments/run/warning_messages.hpp"

namespace bendlab {

Message strip_out_of_range(const WarningInput& input) {
  return unreadable_strip(input.config, input.scene);
}

// A strip that cannot be read was told before the run.
Message doubtful_stiffness(const WarningInput& input) {
  if (unreadable_strip(input.config, input.scene)) return std::nullopt;
  return doubtful_reading(input.config, input.scene, *input.summary);
}

// With pbd the springs' excess is lowered instead (weaker_push).
Message pushed_membrane(const WarningInput& input) {
  const SimulationInput& scene = input.scene.input;
  if (scene.method->projects || scene.strain.size() == 0 ||
      scene.strain_stiffness.kind != StiffnessKind::compliance)
    return std::nullopt;
  return push_on_membrane_warning(scene.push_tension, scene.strain_stiffness.compliance);
}

}  // namespace bendlab
