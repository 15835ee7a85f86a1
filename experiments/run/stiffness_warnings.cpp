// Warnings about a stiffness that is not what was stated.
#include <fmt/format.h>

#include <algorithm>

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

// Hinges on diagonals of one direction resist bending across the diagonals more than along them, and no
// weights change that: on grids with the diagonal "same" the sheet has 0.47 to 2.0 times the stated rigidity.
// Alternating diagonals have 0.99 to 1.02, and Delaunay meshes 0.98 to 1.01.
Message uneven_stiffness(const WarningInput& input) {
  if (!is_chosen(input, "/bending/flexural_rigidity")) return std::nullopt;
  constexpr double even = 0.45;  // 0.8 to 1.25
  const auto fact = [&](const std::string& name) -> std::optional<double> {
    const auto& facts = input.scene.bending_facts;
    const auto found = std::ranges::find(facts, name, &BendingFact::name);
    return found == facts.end() ? std::nullopt : std::optional(found->value);
  };
  const std::optional<double> spread = fact("linear_anisotropy");
  if (!spread || !(*spread > even)) return std::nullopt;
  const auto least = fact("large_deflection_least"), most = fact("large_deflection_most");
  return WarningText(
      fmt::format("between directions of bending the sheet's flexural rigidity differs by {:.2g} times the "
                  "stated one{}, because its triangles point one way. \"generator\": \"equilateral\" or "
                  "\"diagonal\": \"alternating\" in /mesh makes that 0.01 to 0.13 times",
                  *spread,
                  least && most ? fmt::format(" (it is {:.2g} to {:.2g} times it)", *least, *most) : ""),
      *spread, fmt::format("{:.2g} times the stated rigidity", *spread));
}

// With pbd the springs' excess is lowered instead (weaker_push).
Message pushed_membrane(const WarningInput& input) {
  const SimulationInput& scene = input.scene.input;
  if (scene.method.kind().projects || scene.strain.size() == 0 ||
      scene.strain_stiffness.kind != StiffnessKind::compliance)
    return std::nullopt;
  return push_on_membrane_warning(scene.push_tension, scene.strain_stiffness.compliance);
}

}  // namespace bendlab
