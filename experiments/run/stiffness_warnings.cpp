// Warnings about a stiffness that differs from the stated stiffness.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bendlab/bending/push_bound.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/measures/strip_doubts.hpp"
#include "experiments/run/warning_messages.hpp"

namespace bendlab {

Message strip_out_of_range(const WarningInput& input) {
  return unreadable_strip(input.config, input.scene);
}

// A strip whose stiffness cannot be read gets another warning, strip_out_of_range.
Message doubtful_stiffness(const WarningInput& input) {
  if (unreadable_strip(input.config, input.scene)) return std::nullopt;
  return doubtful_reading(input.config, input.scene, *input.summary);
}

namespace {

std::optional<double> fact(const WarningInput& input, const std::string& name) {
  const auto& facts = input.scene.bending_facts;
  const auto match = std::ranges::find(facts, name, &BendingFact::name);
  return match == facts.end() ? std::nullopt : std::optional(match->value);
}

}  // namespace

// If all diagonals point the same way, hinges resist bending across the diagonals more than along them,
// whatever the weights of the hinges are. On grids with the diagonal "same" the sheet has 0.47 to 2.0 times
// the stated rigidity, with alternating diagonals 0.99 to 1.02 times, and on Delaunay meshes 0.98 to 1.01
// times.
Message uneven_stiffness(const WarningInput& input) {
  if (!is_chosen(input, "/bending/flexural_rigidity")) return std::nullopt;
  constexpr double even = 0.45;  // between 0.8 and 1.25 times the stated rigidity
  const std::optional<double> spread = fact(input, "linear_anisotropy");
  if (!spread || !(*spread > even)) return std::nullopt;
  const auto least = fact(input, "large_deflection_least"), most = fact(input, "large_deflection_most");
  return WarningText(
      fmt::format(
          "the sheet's flexural rigidity depends on the direction of bending: it varies by {:.2g} times the "
          "stated rigidity{}, because all triangles point the same way. \"generator\": \"equilateral\" or "
          "\"diagonal\": \"alternating\" in /mesh reduces this variation to 0.01 to 0.13 times",
          *spread, least && most ? fmt::format(" (from {:.2g} to {:.2g} times)", *least, *most) : ""),
      *spread, fmt::format("{:.2g} times the stated rigidity", *spread));
}

// A sheet of hinges or springs has a Poisson's ratio that follows from its mesh.
Message other_poisson_ratio(const WarningInput& input) {
  const double stated = input.config.scene().material.poisson_ratio;
  const BendingKind& model = input.config.scene().bending.model.kind();
  if (model.takes_poisson_ratio || !model.bends || stated == 0 ||
      input.config.scene().material.strain.form != StrainForm::stvk)
    return std::nullopt;  // without stvk nothing reads the ratio, and inert_setting says so
  std::vector<std::string_view> with_ratio;
  for (const BendingKind* kind : bending_models())
    if (kind->takes_poisson_ratio) with_ratio.push_back(kind->name);
  const std::optional<double> own = fact(input, "poisson_ratio");
  return WarningText(
      fmt::format(
          "the membrane has the stated Poisson's ratio of {:.3g}, but the bending model {} has {}. To bend "
          "with the stated ratio, choose one of the models {}",
          stated, model.name,
          own ? fmt::format("a ratio of {:.2g} on this mesh", *own) : std::string("a ratio of its own"),
          fmt::join(with_ratio, ", ")),
      own ? std::abs(*own - stated) : 0, own ? fmt::format("{:.2g} instead of {:.3g}", *own, stated) : "");
}

// This warning is not for pbd, because pbd lowers the excess length of the springs instead (see weaker_push).
Message pushed_membrane(const WarningInput& input) {
  const SimulationInput& scene = input.scene.input;
  if (scene.method.kind().projects || scene.strain.size() == 0 ||
      scene.strain_stiffness.kind != StiffnessKind::compliance)
    return std::nullopt;
  return push_on_membrane_warning(scene.push_tension, scene.strain_stiffness.compliance);
}

}  // namespace bendlab
