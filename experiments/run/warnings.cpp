#include "experiments/run/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/connected_parts.hpp"
#include "bendlab/solver/coarse_levels.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/counted.hpp"
#include "experiments/config/defaults.hpp"
#include "experiments/config/pointers.hpp"
#include "experiments/config/stiffness_settings.hpp"
#include "experiments/measures/effective_stiffness.hpp"
#include "experiments/scene/gravity.hpp"
#include "experiments/scene/obstacles.hpp"
#include "experiments/scene/precision.hpp"

namespace bendlab {
namespace {

using Message = std::optional<std::string>;

// ---- unconverged

// Mean strain over the last second. A rigid membrane has none, woven cloth under its own weight less than
// 0.01; strain that iterations leave makes the sheet longer. A sheet of 24 cells pinned at its centre,
// without bending, is left with 0.056 by 1 substep × 10 iterations, 0.012 by 10 × 1, and 0.006 by 4 × 10;
// pinned at two corners, 20 cells, with 0.072 by 1 × 10 and 0.007 by 4 × 10. The paper's sheet on 16 cells,
// which hangs as finer ones do, has 0.036.
constexpr double unconverged_strain = 0.05;
// Stretch of the most stretched triangle, for necks at pins that the mean does not show: a tube pinned at
// its rim (24 cells, green form) has 1.36 with 1 × 10, and hangs too far by a tenth of its size; with 10 ×
// 1 it has 1.10.
constexpr double unconverged_stretch = 1.25;

// A sheet of 24 cells pinned at its centre, without bending: mean strain, and the most stretched triangle.
//
//   substeps × iterations    1 × 10         5 × 1          10 × 1          20 × 1
//   alone                    0.049  1.59    0.025  1.30    0.0075  1.08    0.0022  1.03
//   with tethers             0.024  1.22    0.018  1.14    0.0068  1.05    0.0024  1.03
std::string remedy_of_unconverged(const WarningInput& input) {
  const SolverSettings& solver = input.scene.input.settings;
  std::string remedy =
      solver.iterations > 1
          ? fmt::format(
                "{} × 1 project as often and leave less: in tests 10 × 1 left a triangle 1.08 times as long "
                "where 1 × 10 left 1.59",
                counted(solver.substeps * solver.iterations, "/solver/substep"))
          : std::string("Twice the /solver/substeps leave about a third of the strain, as tests have shown");
  const Json* const effects = value_at(input.config.resolved(), "/effects");
  const bool tethered =
      std::ranges::any_of(*effects, [](const Json& effect) { return effect.value("type", "") == "tethers"; });
  if (!tethered && !input.scene.pins.all.empty())
    remedy += ". The effect tethers holds what hangs from pins: 1 × 10 then left 1.22";
  return remedy;
}

Message unconverged(const WarningInput& input) {
  const StrainStiffness& strain = input.scene.input.strain_stiffness;
  const bool rigid = strain.kind == StiffnessKind::compliance ? strain.compliance == 0
                                                              : strain.warp == 1 && strain.weft == 1;
  const auto number = [&](const char* name) {
    const auto found = input.summary->find(name);
    return found == input.summary->end() ? 0.0 : found->second;
  };
  // A run of less than a second may end when it only begins to stretch, which medians do not show.
  const double mean = std::max(number("mean_strain"), number("mean_strain_last")),
               most = std::max(number("max_stretch"), number("max_stretch_last"));
  if (!rigid || !input.scene.input.method->projects ||
      !(mean > unconverged_strain || most > unconverged_stretch))
    return std::nullopt;
  return fmt::format(
      "the membrane should not stretch, but it has mean strain {:.2g} and a triangle {:.3g} times as long as "
      "at rest: {} × {} do not converge. {}",
      mean, most, counted(input.scene.input.settings.substeps, "substep"),
      counted(input.scene.input.settings.iterations, "iteration"), remedy_of_unconverged(input));
}

// ---- inert_seed

// null is the default, and chooses nothing.
bool gives(const Json& settings, const std::string& pointer) {
  const Json* const value = value_at(settings, pointer);
  return value != nullptr && !value->is_null();
}

// Whether the config gives a value for `pointer`: sets it, or sweeps it or an object that holds it.
bool is_chosen(const WarningInput& input, const std::string& pointer) {
  if (gives(input.experiment.settings, pointer)) return true;
  for (const auto& [swept, value] : input.config.point) {
    if (swept == pointer && !value.is_null()) return true;
    if (lies_within(pointer, swept) && gives(value, pointer.substr(swept.size()))) return true;
  }
  return false;
}

Message inert_seed(const WarningInput& input) {
  const ParameterValues initial = input.config.section("/initial"), mesh = input.config.section("/mesh");
  const bool initial_used = initial.number("perturbation") > 0 || initial.number("random") > 0,
             mesh_used = input.config.mesh_file().empty() && mesh.text("generator") == "delaunay";
  std::string inert;
  if (!initial_used && is_chosen(input, "/initial/seed")) inert = "/initial/seed";
  if (!mesh_used && is_chosen(input, "/mesh/seed")) inert = "/mesh/seed";
  if (inert.empty()) return std::nullopt;
  return fmt::format(
      "{} changes nothing here: runs that differ in it alone are equal, and their spread is 0. {}", inert,
      inert == "/mesh/seed" ? "Only /mesh/generator: delaunay uses it"
                            : "Set /initial/perturbation, to 1e-6 for example, or remove the seed");
}

// ---- piece_without_pin

Message piece_without_pin(const WarningInput& input) {
  const RestMesh& rest = input.scene.rest;
  if (input.scene.pins.all.empty()) return std::nullopt;
  std::size_t loose = 0;
  int first = 0;
  for (const std::vector<int>& part : connected_parts(rest.one_ring())) {
    if (std::ranges::any_of(part, [&](int v) { return input.scene.pins.pinned(v); })) continue;
    if (loose == 0) first = part.front();
    loose += part.size();
  }
  if (loose == 0) return std::nullopt;
  return fmt::format(
      "pieces of the mesh with {} of its {} vertices (the first is vertex {}) have no pin, while others "
      "have: they will fall away. Pin each piece, or join them ('bendlab mesh FILE' counts the pieces)",
      loose, rest.vertex_count(), first);
}

// ---- effect_without_pins

// Tethers are a default, and then nobody has asked for them.
Message effect_without_pins(const WarningInput& input) {
  if (!input.scene.pins.all.empty()) return std::nullopt;
  const Json* const effects = value_at(input.experiment.settings, "/effects");
  const bool by_default = effects == nullptr || *effects == default_effects(input.experiment.settings);
  for (std::size_t index = 0; index < input.scene.effects.size(); ++index) {
    const std::string& type = input.scene.effects[index].type;
    if (type == "moving_pins" || (type == "tethers" && !by_default))
      return fmt::format(
          "/effects/{} ({}) does nothing, because no vertex is pinned. Name pins in /pins/vertices or "
          "/pins/indices, or remove the effect",
          index, type);
  }
  return std::nullopt;
}

// ---- far_vertex

// Edges of cloth that was made finer in places differ by some tens; a vertex that a slip of the mouse or a
// wrong digit moved away is much farther.
constexpr double far = 200;  // times the median edge

Message far_vertex(const WarningInput& input) {
  const RestMesh& rest = input.scene.rest;
  const auto& positions = rest.positions();
  std::vector<double> lengths;
  const Adjacency& neighbours = rest.one_ring();
  const auto length = [&](int from, int to) { return (positions.row(from) - positions.row(to)).norm(); };
  double longest = 0;
  int vertex = -1, other = -1;
  for (int from = 0; from < rest.vertex_count(); ++from)
    for (const int to : neighbours[static_cast<std::size_t>(from)])
      if (from < to) {
        lengths.push_back(length(from, to));
        if (lengths.back() > longest) longest = lengths.back(), vertex = from, other = to;
      }
  if (lengths.empty()) return std::nullopt;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::ranges::nth_element(lengths, middle);
  if (!(longest > far * *middle)) return std::nullopt;
  // Of the two the one that is farther from all.
  const auto from_centre = [&](int v) { return (positions.row(v).transpose() - rest.centre()).norm(); };
  if (from_centre(other) > from_centre(vertex)) std::swap(vertex, other);
  return fmt::format(
      "vertex {} lies {:.3g} m from its neighbour {}, {:.2g} times as far as the median edge is long: is it "
      "where it should be? 'bendlab mesh FILE' tells about the mesh",
      vertex, longest, other, longest / *middle);
}

// ---- all_pinned

Message all_pinned(const WarningInput& input) {
  const auto vertices = static_cast<std::size_t>(input.scene.rest.vertex_count());
  if (input.scene.pins.all.size() != vertices) return std::nullopt;
  return fmt::format(
      "all {} vertices are pinned, so that nothing can move. /pins/vertices names places in the x-y plane of "
      "the mesh's box: for a mesh that stands upright choose others, or use /pins/indices. A smaller "
      "/pins/ring or /pins/distance pins fewer",
      vertices);
}

// ---- inert_stiffness

// A number that the config's kind of stiffness does not use.
Message inert_stiffness(const WarningInput& input) {
  for (const StiffnessSetting& setting : stiffness_settings) {
    const auto chooses_the_kind = [&](const auto& axis) {  // other runs of the sweep may use the number
      return lies_within(setting.stiffness, axis.first);
    };
    const Json* const kind = value_at(input.config.resolved(), std::string(setting.stiffness));
    if (kind == nullptr || !kind->is_string() || std::ranges::any_of(input.experiment.axes, chooses_the_kind))
      continue;
    const auto& name = kind->get_ref<const std::string&>();
    if (!setting.used_by(name) && is_chosen(input, std::string(setting.pointer)))
      return fmt::format("{} changes nothing here, because {} is {}. Set that to {}, or remove the number",
                         setting.pointer, setting.stiffness, name, setting.kinds_text());
  }
  return std::nullopt;
}

// ---- units

// Under gravity a cloth of length L falls and swings within a time of √(L / g): 0.03 s for 1 cm, 0.8 s for
// 6 m. Clothes and curtains lie between; a mesh in mm or cm that is read in m does not. Gravity weaker than
// the Earth's is a choice, and says nothing about units.
constexpr double shortest_time = 0.03, longest_time = 0.8;  // s
constexpr double weakest_gravity = 9;                       // m/s²

Message units(const WarningInput& input) {
  const RestMesh& rest = input.scene.rest;
  const double g = gravity_of(input.scene.effects).norm();
  const double extent = (rest.box_max() - rest.box_min()).maxCoeff();
  // kg/m²: gauze has 0.02, a heavy carpet 4.
  constexpr double heaviest = 10;
  if (const double density = input.config.section("/material").number("density"); density > heaviest)
    return fmt::format(
        "a density of {:.3g} kg/m² is more than any cloth has: is it in g/m²? 200 g/m² is 0.2 kg/m²",
        density);
  if (!(g >= weakest_gravity)) return std::nullopt;
  const double time = std::sqrt(extent / g);
  if (time >= shortest_time && time <= longest_time) return std::nullopt;
  return fmt::format(
      "the cloth is {:.3g} m long, {}, under a gravity of {:.3g} m/s²: is the mesh in other units? "
      "/mesh/scale converts them to metres (0.001 for millimetres, 0.01 for centimetres)",
      extent, time > longest_time ? "as much as a theatre's curtain or more" : "less than a fingertip", g);
}

// ---- membrane_courant

// The Courant number C of a membrane with the stiffness Y = 1 / compliance (N/m) and the mass ρ per area:
// how many cells a wave of stretch, whose speed is √(Y/ρ), crosses in a substep h. An iteration carries
// it on by about a cell. A strip of 1 m that hangs by its end (double precision) is elongated by the stated
// ρ g L²/2Y times 1 + C²/n with n projections per substep, within a third, for 20 to 10⁴ N/m, 8 and 16
// cells across a width of 0.25 m, and 1 to 64 substeps × 1 to 40 iterations:
//
//   C²/n                 0.035 0.14  0.22  0.56  0.89  1.4   2.2   3.6   5.6   14    57    360   1420   5690
//   elongation / stated  1.00  0.99  0.96  1.16  1.39  2.1   2.9   4.1   6.9   15    61    390   1510   6050
//
// With coarse levels, 8 substeps × 1: 17 became 6.6, 64 became 11, 165 became 16 and 637 became 29, which
// 1 + 1.6 (C²/n)^0.44 fits within 3 %.
constexpr double softened = 1;  // C²/n at which the membrane is half as stiff as stated

double softening_by(double excess, bool levels) {
  return 1 + (levels ? std::min(excess, 1.6 * std::pow(excess, 0.44)) : excess);
}

// Cloth in free fall loads no membrane.
bool is_held(const Scene& scene) {
  return !scene.pins.all.empty() || std::ranges::any_of(scene.effects, &is_obstacle, &EffectSettings::type);
}

// A forecast: after a run soft_solver tells what was measured.
Message membrane_courant(const WarningInput& input) {
  const SimulationInput& scene = input.scene.input;
  const SolverSettings& solver = scene.settings;
  const double compliance = scene.strain_stiffness.compliance;
  if (!scene.method->projects || scene.strain_stiffness.kind != StiffnessKind::compliance ||
      compliance == 0 || !is_held(input.scene) || input.summary)
    return std::nullopt;
  const std::vector<double>& areas = input.scene.rest.areas();
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double density = std::accumulate(scene.mass.begin(), scene.mass.end(), 0.0) / area;
  // The legs of a right triangle.
  const double cell = std::sqrt(2 * area / static_cast<double>(areas.size()));
  const double courant = std::sqrt(1 / (compliance * density)) * solver.dt / solver.substeps / cell;
  const double excess = courant * courant / solver.projections_per_substep();
  if (!(excess > softened)) return std::nullopt;
  const bool reach = levels_are_worthwhile(scene),
             levels = reach && own_settings(scene).integer("levels") > 0;
  constexpr double wanted = 0.1;
  return fmt::format(
      "the membrane needs about {:.2g} projections in each substep (its Courant number) and has {}: it "
      "stretches about {:.2g} times as far as stated. About {} /solver/substeps make that 1.1 times{}",
      courant, solver.projections_per_substep(), softening_by(excess, levels),
      static_cast<long>(std::ceil(solver.substeps * std::sqrt(excess / wanted))),
      reach && !levels && softening_by(excess, true) < 0.5 * softening_by(excess, false)
          ? fmt::format(", /solver/levels: 12 makes it about {:.2g}", softening_by(excess, true))
          : "");
}

// ---- k_overshoot

// With k only prestressed pushes a sound sheet out of its shape: its springs, longer than at rest by an
// excess e, stretch it. Mean strain of a sheet of 20 cells pinned at two corners, 4 × 10 (without bending
// 0.007):
//
//   e              0.02    0.05    0.1     0.2     0.5
//   k = 0.1        0.016   0.032   0.060   0.117   0.293
//   k = 0.5        0.028   0.060   0.114   0.227   0.627
//   k = 1          0.031   0.068   0.129   0.257   0.684
//
// dihedral, isometric, choi_ko, crossover, k_ring (1, 4 and 8 rings), adaptive and lod at k of 0.01 to 1
// leave it as it is or less strained, at 4 × 10 and at 1 × 10.
Message k_overshoot(const WarningInput& input) {
  if (input.config.bending_model() != "prestressed") return std::nullopt;
  const ParameterValues bending = input.config.section("/bending");
  const std::string& stiffness = bending.text("stiffness");
  if (stiffness != "k" && stiffness != "k_per_step") return std::nullopt;
  const double k = bending.number("k"), excess = input.config.bending_parameters().number("excess");
  constexpr double weak = 0.3, share_of_weak = 0.6, share = 1.2;  // of the excess: the columns of the table
  const double strain = excess * (k == 0 ? 0 : k < weak ? share_of_weak : share);
  if (!(strain > unconverged_strain)) return std::nullopt;
  return fmt::format(
      "the springs of prestressed, with an excess of {:.2g} and k = {:.2g}, stretch the sheet to a mean "
      "strain of about {:.2g}, which its membrane cannot undo. A smaller /bending/prestressed/excess helps: "
      "in tests 0.02 left a mean strain of 0.03",
      excess, k, strain);
}

// ---- soft_solver

Message soft_solver(const WarningInput& input) {
  return soft_solver_warning(*input.summary);
}

// ---- weaker_push

Message weaker_push(const WarningInput& input) {
  return input.scene.push ? push_warning(*input.scene.push) : std::nullopt;
}

// ---- single_precision

// A sheet on tethers, or on a plane, in single precision: see precision.cpp.
Message single_precision(const WarningInput& input) {
  if (input.config.section("/solver").text("precision") != "single") return std::nullopt;
  const RoundingStrain strain = rounding_strain(input.scene);
  if (!strain.single_suffices())
    return fmt::format(
        "the membrane is so stiff that its weight strains it by {:.2g}, and each rounding of a position in "
        "single precision by {:.2g}. Set /solver/precision to auto, which takes double here",
        strain.of_weight, strain.rounded);
  const RoundingSpeed speed = rounding_speed(input.scene);
  if (speed.single_suffices()) return std::nullopt;
  return fmt::format(
      "an effect moves vertices to positions that single precision rounds: in a substep each rounding "
      "changes a speed by {:.2g} m/s, and gravity by {:.2g} m/s. Set /solver/precision to auto, which takes "
      "double here",
      speed.rounded, speed.gained);
}

// ---- softened_membrane

Message softened_membrane(const WarningInput& input) {
  const auto found = input.summary->find("membrane_softness");
  if (found == input.summary->end() || !(found->second > 1)) return std::nullopt;
  return fmt::format(
      "/solver/membrane is auto: the membrane is {:.3g} times as soft as stated, {:.3g} N/m, which moves the "
      "cloth at rest by at most {:.2g} of its size. \"stated\" keeps the stiffness",
      found->second, 1 / (found->second * input.scene.input.strain_stiffness.compliance),
      input.config.section("/solver").number("membrane_error"));
}

// ---- lagging

// Sheets of 16 cells, hinges, pinned at two corners or at the top, Y = 10³ to 10⁷ N/m, 1 to 100 iterations,
// 2 s: how far they are from the converged motion (RMS over vertices, mean over time), in sizes, by what
// their steps leave in the mean over time. The median would not show it: newton leaves nothing once the cloth
// rests.
//
//   step_residual   below 0.5     0.5 to 2      2 to 5        5 to 20       20 to 100   more
//   newton          0-0.0003      0.001-0.046   none          0.025-0.051   0.03-0.07   0.05-0.49
//   quasi_newton    0.001-0.006   0.004-0.044   0.012-0.090   0.026-0.21    0.06-0.48   0.11-0.54
//   vbd             none          0.030         0.034-0.12    0.19-0.50     0.51        none
constexpr double residual_of_lag = 2;

// The numbers are of the same sheets.
std::string remedy_of_lagging(const WarningInput& input) {
  const SimulationInput& scene = input.scene.input;
  if (scene.method->name == "newton")
    return "More /solver/iterations help: at a stiffness of 10⁵ N/m 3 left 32, and 10 left 0.01";
  if (scene.method->name != "quasi_newton")
    return "More /solver/iterations help, and quasi_newton needs fewer";
  const Json& solver = *value_at(input.config.resolved(), "/solver");
  if (solver.value("membrane", "") == "stated" && scene.strain.size() > 0)
    return "10 /solver/iterations with /solver/membrane: auto left at most 1.3. With the stated membrane "
           "take "
           "more of them: 10 left 9, and 40 left 1.6 at a stiffness of 10⁴ N/m";
  return "More /solver/iterations help: 2 left 4.3, and 20 left 0.43";
}

Message lagging(const WarningInput& input) {
  const auto found = input.summary->find("step_residual");
  if (found == input.summary->end() || !(found->second > residual_of_lag)) return std::nullopt;
  const SimulationInput& scene = input.scene.input;
  return fmt::format(
      "the steps leave forces unbalanced that are {:.2g} times those of the effects, in the mean over the "
      "frames: {} × {} do not converge, and the cloth lags behind. In tests it was behind by 1 to 12 % of "
      "its "
      "size at 2 to 5 times, by 3 to 50 % at 5 to 20. {}",
      found->second, counted(scene.settings.substeps, "substep"),
      counted(scene.settings.iterations, "iteration"), remedy_of_lagging(input));
}

// ---- no_equilibrium

Message no_equilibrium(const WarningInput& input) {
  const auto found = input.summary->find("unbalanced");
  const bool ended = input.status == RunStatus::complete || input.status == RunStatus::implausible;
  if (!ended || found == input.summary->end() || input.summary->contains("settled_at")) return std::nullopt;
  return fmt::format(
      "no equilibrium was found: the unbalanced forces are {:.2g} times the loads in the end. The numbers of "
      "this run are those of its last steps. A longer /duration allows more steps",
      found->second);
}

constexpr std::array kinds = {
    WarningKind{"inert_seed", "a seed is set or swept that nothing uses", true, inert_seed},
    WarningKind{"piece_without_pin", "a piece of the mesh has no pin while others have some", true,
                piece_without_pin},
    WarningKind{"effect_without_pins", "an effect is listed that needs pins, and there are none", true,
                effect_without_pins},
    WarningKind{"far_vertex", "a vertex is very far from its neighbours", true, far_vertex},
    WarningKind{"all_pinned", "no vertex can move", true, all_pinned},
    WarningKind{"inert_stiffness", "a number is given that the kind of stiffness does not use", true,
                inert_stiffness},
    WarningKind{"units", "the extent of the mesh, under gravity, looks like other units", true, units},
    WarningKind{"membrane_courant", "a membrane with a compliance is less than half as stiff as stated", true,
                membrane_courant},
    WarningKind{"k_overshoot", "bending springs with this k stretch the sheet", true, k_overshoot},
    WarningKind{"single_precision",
                "single precision is asked for where it does not resolve gravity or the membrane's strain",
                true, single_precision},
    WarningKind{"weaker_push", "prestressed springs push with a smaller excess than stated", false,
                weaker_push},
    WarningKind{"soft_solver", "the solver gives the cloth less than half of the stated stiffness", false,
                soft_solver},
    WarningKind{"softened_membrane", "a method was allowed to soften the membrane, and did", false,
                softened_membrane},
    WarningKind{"lagging", "the iterations of implicit steps do not converge", false, lagging},
    WarningKind{"no_equilibrium", "a run ended before its forces were balanced", false, no_equilibrium},
    WarningKind{"unconverged", "a membrane that should not stretch is left stretched", false, unconverged},
};

}  // namespace

std::span<const WarningKind> warning_kinds() {
  return kinds;
}

std::vector<Warning> warnings_of(const WarningInput& input) {
  std::vector<Warning> warnings;
  for (const WarningKind& kind : kinds) {
    if (!kind.before && input.summary == nullptr) continue;
    if (Message message = kind.message(input))
      warnings.push_back({std::string(kind.code), *std::move(message)});
  }
  return warnings;
}

std::vector<Warning> warnings_before(const Experiment& experiment, const RunConfig& config) {
  Json bare = config.resolved();
  bare["bending"] = {{"model", "none"}, {"stiffness", "k"}, {"k", 0.0}, {"compliance", 0.0}};
  const Scene scene = build_scene(RunConfig(std::move(bare), config.folder()));
  return warnings_of(WarningInput{experiment, config, scene});
}

std::string text_of_what_warns_before(const RunConfig& config) {
  Json settings = config.resolved();
  for (const char* unused : {"output", "accuracy", "quality"}) settings.erase(unused);
  for (const char* seeded : {"initial", "mesh"}) settings[seeded].erase("seed");
  return settings.dump();
}

Json to_json(const std::vector<Warning>& warnings) {
  Json json = Json::array();
  for (const Warning& warning : warnings)
    json.push_back({{"code", warning.code}, {"message", warning.message}});
  return json;
}

std::vector<Warning> warnings_of(const Json& json) {
  std::vector<Warning> warnings;
  if (!json.is_array()) return warnings;
  for (const Json& each : json)
    if (each.is_object() && each.contains("code") && each.contains("message") && each["code"].is_string() &&
        each["message"].is_string())
      warnings.push_back({each["code"], each["message"]});
  return warnings;
}

}  // namespace bendlab
