// Warnings about the solver.
#include "experiments/run/warning_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bendlab/scene/counted.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/scene/membrane.hpp"
#include "bendlab/scene/precision.hpp"
#include "bendlab/solver/coarse_levels.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/settings_by_pointer.hpp"
#include "experiments/measures/effective_stiffness.hpp"
#include "experiments/run/remedies.hpp"

namespace bendlab {

// ---- unconverged

namespace {

// Mean strain over the last second. A rigid membrane should have no strain, and woven cloth under its own
// weight has less than 0.01. Strain from too few iterations makes the sheet too long. A sheet of 24 cells
// pinned at its centre, without bending, keeps a strain of 0.056 with 1 substep × 10 iterations, 0.012 with
// 10 × 1, and 0.006 with 4 × 10. A sheet of 20 cells pinned at two corners keeps a strain of 0.072 with 1
// substep × 10 iterations, and 0.007 with 4 × 10. The paper's sheet on 16 cells has a strain of 0.036, and
// hangs like finer sheets.
constexpr double unconverged_strain = 0.05;
// Stretch of the most stretched triangle. Triangles at a pin may be stretched far while the mean strain is
// small. A tube pinned at its rim (24 cells, strain form green) has a stretch of 1.36 with 1 substep × 10
// iterations, and hangs too far by a tenth of its size. With 10 × 1, the stretch is 1.10.
constexpr double unconverged_stretch = 1.25;

}  // namespace

Message unconverged(const WarningInput& input) {
  const StrainStiffness& strain = input.scene.input.strain_stiffness;
  const bool rigid = strain.kind == StiffnessKind::compliance ? strain.compliance == 0
                                                              : strain.warp == 1 && strain.weft == 1;
  const auto number = [&](const char* name) {
    const auto metric = input.summary->find(name);
    return metric == input.summary->end() ? 0.0 : metric->second;
  };
  // In a run of less than a second, cloth may begin to stretch at the end, which medians do not show.
  const double mean = std::max(number("mean_strain"), number("mean_strain_last")),
               most = std::max(number("max_stretch"), number("max_stretch_last"));
  if (!rigid || !input.scene.input.method.kind().projects ||
      !(mean > unconverged_strain || most > unconverged_stretch))
    return std::nullopt;
  return WarningText(
      fmt::format("the membrane should not stretch, but its mean strain is {:.2g} and a triangle is {:.3g} "
                  "times as long as at rest: {} × {} do not converge. In tests, this helped: {}",
                  mean, most, counted(input.scene.input.settings.substeps, "substep"),
                  counted(input.scene.input.settings.iterations, "iteration"),
                  remedies_for("unconverged", input.scene)),
      most, fmt::format("{:.3g} times", most));
}

// ---- membrane_courant

namespace {

// excess_stretch() has the measurements without coarse levels. With 8 substeps × 1 iteration, coarse levels
// reduced the softening from 17 to 6.6, from 64 to 11, from 165 to 16, and from 637 to 29. The formula 1 +
// 1.6 (C²/n)^0.44 fits these values within 3 %.
constexpr double softened = 1;  // C²/n at which the membrane is half as stiff as stated

double softening_by(double excess, bool levels) {
  return 1 + (levels ? std::min(excess, 1.6 * std::pow(excess, 0.44)) : excess);
}

// Whether a projected membrane needs tethers to hold the cloth, and the scene has them.
bool has_tethers(const BuiltScene& scene) {
  return !scene.pins.all.empty() && !membrane_needs_no_tethers(scene) &&
         std::ranges::any_of(scene.effects,
                             [](const Effect& effect) { return effect.kind().helps_projection; });
}

// Whether pins or obstacles hold the cloth. In free fall, no load stretches the membrane.
bool is_held(const BuiltScene& scene) {
  return !scene.pins.all.empty() || !scene.pins.held.empty() || has_obstacle(scene);
}

// Whether nothing but pins on one line holds the cloth.
bool turns_about_pins(const BuiltScene& scene) {
  const std::vector<int>& pins = scene.pins.all;
  if (pins.empty() || !scene.pins.held.empty() || has_obstacle(scene)) return false;
  const auto from_first = [&](int v) -> Vector3 {
    return scene.rest.position(v) - scene.rest.position(pins.front());
  };
  const Vector3 along = from_first(*std::ranges::max_element(pins, {}, [&](int v) {
                          return from_first(v).norm();
                        })).normalized();
  constexpr double on_line = 1e-6;  // sizes of the mesh
  return std::ranges::all_of(
      pins, [&](int v) { return from_first(v).cross(along).norm() <= on_line * scene.rest.size(); });
}

// Whether the membrane stretches, but its stiffness was not measured (in a run with coarse levels, the
// stiffness is not measured).
bool stretches_unmeasured(const std::map<std::string, double>& summary) {
  constexpr double stretched = 0.01;  // mean strain, as for soft_solver
  const auto strain = summary.find("mean_strain");
  return !summary.contains("effective_membrane_stiffness") && strain != summary.end() &&
         strain->second > stretched;
}

}  // namespace

// Before a run. After the run, soft_solver states the measured stiffness.
Message membrane_courant(const WarningInput& input) {
  const SimulationInput& scene = input.scene.input;
  const SolverSettings& solver = scene.settings;
  const double compliance = scene.strain_stiffness.compliance;
  if (!scene.method.kind().projects || scene.strain_stiffness.kind != StiffnessKind::compliance ||
      compliance == 0 || !is_held(input.scene) || has_tethers(input.scene) ||
      (input.summary && !stretches_unmeasured(*input.summary)))
    return std::nullopt;
  const double courant = courant_number(input.scene), excess = excess_stretch(input.scene);
  if (!(excess > softened)) return std::nullopt;
  const bool reach = levels_are_worthwhile(scene),
             levels = reach && scene.method.kind().carries_stretch(scene.method.settings());
  constexpr double wanted = 0.1;
  const double softening = softening_by(excess, levels);
  return WarningText(
      fmt::format("with {} in a substep, during which a wave of stretch crosses {:.2g} cells (the membrane's "
                  "Courant number), the membrane stretches about {:.2g} times as far as stated. About {} "
                  "/solver/substeps reduce this factor to 1.1{}",
                  counted(projections_per_substep(input.scene.input), "projection"), courant, softening,
                  static_cast<long>(std::ceil(solver.substeps * std::sqrt(excess / wanted))),
                  reach && !levels && softening_by(excess, true) < 0.5 * softening
                      ? fmt::format(", and /solver/levels: 12 to about {:.2g}", softening_by(excess, true))
                      : ""),
      softening, fmt::format("{:.2g} times", softening));
}

// ---- tethers_for_membrane

Message tethers_for_membrane(const WarningInput& input) {
  const BuiltScene& scene = input.scene;
  const double excess = excess_stretch(scene);
  if (!(excess > 0) || !has_tethers(scene)) return std::nullopt;
  const SolverSettings& solver = scene.input.settings;
  return WarningText(
      fmt::format("tethers carry the load that the membrane, with its stated {:.3g} N/m, should carry. So "
                  "the cloth hangs from its pins without the stated stretch. Without tethers, the membrane "
                  "would stretch about {:.2g} times as far as stated, with {} in a substep. With {} "
                  "/solver/substeps the membrane carries the load, and tethers do nothing. \"method\": "
                  "\"quasi_newton\", \"membrane\": \"stated\" in /solver need no tethers",
                  1 / scene.input.strain_stiffness.compliance, 1 + excess,
                  counted(projections_per_substep(input.scene.input), "projection"),
                  static_cast<long>(std::ceil(solver.substeps * std::sqrt(excess)))),
      1 + excess, fmt::format("{:.2g} times", 1 + excess));
}

// ---- vbd_reach

Message vbd_reach(const WarningInput& input) {
  const SimulationInput& scene = input.scene.input;
  const double share = scene.method.kind().iterations_per_courant;
  if (share == 0 || scene.strain.size() == 0) return std::nullopt;
  const double courant = courant_number(input.scene), needed = std::ceil(share * courant * courant);
  if (!(scene.settings.iterations < needed)) return std::nullopt;
  return WarningText(
      fmt::format("a wave of stretch crosses {:.2g} cells in a substep (the membrane's Courant number C): {} "
                  "then needs about {:.2g} C² = {:.2g} iterations to follow the motion, but has {}. With "
                  "fewer iterations the cloth is too slow. The methods quasi_newton and newton need few",
                  courant, scene.method.name(), share, needed, scene.settings.iterations),
      needed / scene.settings.iterations, fmt::format("{:.2g} iterations needed", needed));
}

// ---- k_overshoot

// With k from 0.01 to 1, the models dihedral, isometric, choi_ko, crossover, k_ring (1, 4 and 8 rings),
// adaptive and lod do not increase the strain of a sheet (20 cells, pinned at two corners, 4 × 10 and 1 ×
// 10).
Message k_overshoot(const WarningInput& input) {
  const Bending& bending = input.config.scene().bending;
  if (bending.stiffness != Stiffness::k && bending.stiffness != Stiffness::k_per_step) return std::nullopt;
  const BendingKind& model = bending.model.kind();
  if (model.strain_of_k == nullptr) return std::nullopt;
  const double strain = model.strain_of_k(bending.model.settings(), bending.k);
  if (!(strain > unconverged_strain)) return std::nullopt;
  return WarningText(
      fmt::format(
          "with k = {:.2g} the springs of {} stretch the sheet to a mean strain of about {:.2g}, which its "
          "membrane cannot undo. {}",
          bending.k, model.name, strain, model.strain_of_k_remedy),
      strain, fmt::format("a strain of {:.2g}", strain));
}

// ---- single_precision

// Based on measurements in single precision: a sheet on tethers, and a sheet on a plane. See precision.cpp.
Message single_precision(const WarningInput& input) {
  if (input.config.scene().solver.precision != ChosenPrecision::single_precision) return std::nullopt;
  const RoundingStrain strain = rounding_strain(input.scene);
  if (!strain.single_suffices())
    return fmt::format(
        "the membrane is so stiff that the cloth's weight strains it by only {:.2g}, but rounding a position "
        "in single precision strains it by {:.2g}. Set /solver/precision to auto, which chooses double here",
        strain.of_weight, strain.rounded);
  const RoundingSpeed speed = rounding_speed(input.scene);
  if (speed.single_suffices()) return std::nullopt;
  return fmt::format(
      "an effect moves vertices to positions that single precision rounds: in a substep, rounding changes a "
      "speed by {:.2g} m/s, and gravity changes it by {:.2g} m/s. Set /solver/precision to auto, which "
      "chooses double here",
      speed.rounded, speed.gained);
}

// ---- weaker_push

Message weaker_push(const WarningInput& input) {
  return input.scene.push ? push_warning(*input.scene.push) : std::nullopt;
}

// ---- soft_solver

Message soft_solver(const WarningInput& input) {
  const std::optional<SoftSolver> soft = soft_solver_warning(*input.summary);
  if (!soft) return std::nullopt;
  return WarningText(soft->message, -soft->share, share_text(soft->share));
}

// ---- softened_membrane

Message softened_membrane(const WarningInput& input) {
  const auto softness = input.summary->find("membrane_softness");
  if (softness == input.summary->end() || !(softness->second > 1)) return std::nullopt;
  if (!is_chosen(input, "/material/strain/membrane_stiffness") &&
      !is_chosen(input, "/material/strain/compliance"))
    return std::nullopt;  // no warning: the config states no stiffness
  const Method& method = input.scene.input.method;
  return WarningText(
      fmt::format("/solver/membrane is auto: away from pins the membrane is up to {:.3g} times as soft as "
                  "stated ({:.3g} N/m), which moves the cloth at rest by at most {:.2g} of its size. Set "
                  "/solver/membrane to \"stated\" to keep the stated stiffness",
                  softness->second, 1 / (softness->second * input.scene.input.strain_stiffness.compliance),
                  method.kind().membrane_error(method.settings())),
      softness->second, fmt::format("{:.3g} times as soft", softness->second));
}

// ---- lagging

namespace {

// How far sheets lag behind the converged motion, in sizes of the sheet (RMS over vertices, mean over time),
// depending on the mean step_residual over time. The median would hide the lag, because newton leaves no
// residual once the cloth rests. Measured for 2 s, on sheets of 16 cells with hinges, under gravity, pinned
// at two corners or at the top, with a membrane stiffness of 10³ to 10⁷ N/m and 1 to 100 iterations.
//
//   step_residual   below 0.5     0.5 to 2      2 to 5        5 to 20       20 to 100   more
//   newton          0-0.0003      0.001-0.046   none          0.025-0.051   0.03-0.07   0.05-0.49
//   quasi_newton    0.001-0.006   0.004-0.044   0.012-0.090   0.026-0.21    0.06-0.48   0.11-0.54
//   vbd             none          0.030         0.034-0.12    0.19-0.50     0.51        none
//
// On obstacles smaller residuals matter: at a step_residual of 0.3 to 1.1, cloth with quasi_newton slid 0.05
// to 0.11 m instead of 0.02 m. The methods state which residual is too large (MethodKind::residual_of_lag).
double most_residual(const WarningInput& input) {
  const MethodKind& method = input.scene.input.method.kind();
  return has_obstacle(input.scene) ? method.residual_of_lag_on_obstacle : method.residual_of_lag;
}

}  // namespace

Message lagging(const WarningInput& input) {
  const auto found = input.summary->find("step_residual");
  if (found == input.summary->end() || !(found->second > most_residual(input))) return std::nullopt;
  const SimulationInput& scene = input.scene.input;
  return WarningText(
      fmt::format(
          "the forces that steps leave unbalanced are {:.2g} times the forces of the effects (without "
          "effects: of inertia): {} × {} do not converge, and the cloth lags behind the exact motion{}. In "
          "tests, this helped: {}",
          found->second, counted(scene.settings.substeps, "substep"),
          counted(scene.settings.iterations, "iteration"),
          found->second > scene.method.kind().residual_of_lag
              ? ", in tests by up to half of its size"
              : ". Cloth that friction moves then stops too early, or slides too far",
          remedies_for("lagging", input.scene)),
      found->second, fmt::format("{:.2g} times", found->second));
}

// ---- no_equilibrium

Message no_equilibrium(const WarningInput& input) {
  const auto found = input.summary->find("unbalanced");
  const bool ended = input.status == RunStatus::complete || input.status == RunStatus::implausible;
  if (!ended || found == input.summary->end() || input.summary->contains("settled_at")) return std::nullopt;
  const bool blows = std::ranges::any_of(
      input.scene.effects, [](const Effect& effect) { return effect.kind().force_follows_pose; });
  const std::string_view remedy =
      !is_held(input.scene) ? "Nothing holds the cloth: pin vertices, or let it fall with another method"
      : blows && turns_about_pins(input.scene)
          ? "All pins are on one line, and the cloth can turn about this line: pin the next row of vertices, "
            "too (\"ring\": 1 in /pins)"
      : blows ? "The force of an effect may change with the pose, and Newton's method ignores this change: "
                "let the cloth come to rest with the method newton and viscous_drag, as in "
                "configs/verification/end_moment.json"
              : "A longer /duration allows more steps";
  return WarningText(fmt::format("no equilibrium was found: in the end, the unbalanced forces are {:.2g} "
                                 "times the loads. The metrics of this run describe its last steps. {}",
                                 found->second, remedy),
                     found->second, fmt::format("{:.2g} times", found->second));
}

}  // namespace bendlab
