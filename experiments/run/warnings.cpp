#include "experiments/run/warnings.hpp"

#include <array>

#include "experiments/run/warning_messages.hpp"

namespace bendlab {
namespace {

constexpr std::array kinds = {
    WarningKind{"inert_seed", "a seed is set or swept, but nothing reads it", true, inert_seed},
    WarningKind{"piece_without_pin", "a piece of the mesh has no pin, but another piece has pins", true,
                piece_without_pin},
    WarningKind{"effect_without_pins", "an effect needs pins, but no vertex is pinned", true,
                effect_without_pins},
    WarningKind{"friction_without_obstacle", "friction is listed, but there is no obstacle", true,
                friction_without_obstacle},
    WarningKind{"mixed_sides", "an effect or the bending model needs triangles that face the same side", true,
                mixed_sides},
    WarningKind{"doubtful_effect", "in this scene, the settings of an effect cannot work as intended", true,
                doubtful_effect},
    WarningKind{"starts_inside", "cloth starts inside an obstacle", true, starts_inside},
    WarningKind{"far_vertex", "a vertex is very far from its neighbours", true, far_vertex},
    WarningKind{"all_pinned", "no vertex can move", true, all_pinned},
    WarningKind{"other_extent", "a shell is smaller or larger than stated", true, other_extent},
    WarningKind{"no_symmetry_plane", "the sheet turns freely about a border that is held across", true,
                no_symmetry_plane},
    WarningKind{"inert_stiffness", "a stiffness is set that the chosen kind of stiffness does not read", true,
                inert_stiffness},
    WarningKind{"inert_setting",
                "a setting is set that the chosen method, bending model or mesh generator does not read",
                true, inert_setting},
    WarningKind{"replaced_setting", "a swept object replaces settings that the config states", true,
                replaced_setting},
    WarningKind{"units", "an extent, gravity, density or stiffness seems to be in another unit", true, units},
    WarningKind{"fabric_without_friction",
                "the run leaves out the internal friction or the softening of the fabric", true,
                fabric_without_friction},
    WarningKind{"membrane_courant", "a membrane with a compliance is less than half as stiff as stated", true,
                membrane_courant},
    WarningKind{"tethers_for_membrane",
                "tethers carry the load that a membrane of a stated stiffness should carry", true,
                tethers_for_membrane},
    WarningKind{"vbd_reach", "vbd has too few iterations for the stiffness of the membrane", true, vbd_reach},
    WarningKind{"k_overshoot", "bending springs with this k stretch the sheet", true, k_overshoot},
    WarningKind{"single_precision",
                "single precision is set, but does not resolve gravity or the membrane's strain", true,
                single_precision},
    WarningKind{"strip_out_of_range", "a strip is too soft or too stiff for its stiffness to be measured",
                true, strip_out_of_range},
    WarningKind{"uneven_stiffness", "a stated flexural rigidity depends on the direction of bending", true,
                uneven_stiffness},
    WarningKind{"other_poisson_ratio", "bending does not have the stated Poisson's ratio", true,
                other_poisson_ratio},
    WarningKind{"weaker_push", "the excess length of prestressed springs is smaller than stated", false,
                weaker_push},
    WarningKind{"pushed_membrane", "prestressed springs stretch the stated membrane", false, pushed_membrane},
    WarningKind{"soft_solver", "the solver gives the cloth less than half of a stated stiffness", false,
                soft_solver},
    WarningKind{"softened_membrane", "the method softened the membrane, as its settings allow", false,
                softened_membrane},
    WarningKind{"lagging", "the iterations of implicit steps do not converge", false, lagging},
    WarningKind{"no_equilibrium", "a run ended before its forces were balanced", false, no_equilibrium},
    WarningKind{"doubtful_stiffness", "two readings of a strip's stiffness disagree, or show no stiffness",
                false, doubtful_stiffness},
    WarningKind{"unconverged", "a membrane that should not stretch stays stretched", false, unconverged},
};

}  // namespace

std::span<const WarningKind> warning_kinds() {
  return kinds;
}

std::vector<Warning> warnings_of(const WarningInput& input) {
  std::vector<Warning> warnings;
  for (const WarningKind& kind : kinds) {
    if (!kind.before && input.summary == nullptr) continue;
    if (Message text = kind.message(input))
      warnings.push_back(
          {std::string(kind.code), std::move(text->message), text->severity, std::move(text->measured)});
  }
  return warnings;
}

}  // namespace bendlab
