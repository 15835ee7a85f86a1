// The dihedral angle as a constraint, as position-based cloth has used it since 2007.
#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_hinges.hpp"

namespace bendlab {
namespace dihedral_model {

constexpr std::array<std::string_view, 2> weights = {"uniform", "area"};

constexpr std::array fields = {
    field<&Dihedral::weight>(
        {.name = "weight",
         .meaning = "weight of a hinge with XPBD: the same for every hinge (energy ½ k (θ - θ0)², flexural "
                    "rigidity √3/2 k on equilateral triangles), or edge² / area of both triangles (flexural "
                    "rigidity k at any resolution)",
         .choices = weights}),
};

BendingConstraints build(const Dihedral& settings, const BendingInput& input) {
  const bool uniform = settings.weight == Dihedral::Weight::uniform;
  BendingConstraints constraints;
  std::get<ElementList<HingeAngle>>(constraints.elements) =
      angle_constraints(rest_hinges(input.rest, input.pins, input.is_flat), HingeAngle::Law::angle,
                        [&](const RestHinge& h) { return uniform ? 1.0 : h.area / (h.edge * h.edge); });
  return constraints;
}

}  // namespace dihedral_model

constinit const BendingKind Dihedral::kind{
    .name = "dihedral",
    .label = "dihedral",
    .summary = "the signed angle between the two triangles of every interior edge",
    .source = "Müller et al. 2007, §3.3; Müller et al. 2014, §3.8; the sign by atan2",
    .limits =
        "with k its stiffness depends on resolution, iterations and time step, and from k = 0.7 on hinges "
        "that share vertices overshoot and shake the sheet; a fold of more than 180 degrees counts as a fold "
        "to the other side; with physical stiffness, a sheet that is bent a little has 0.75 of the stated "
        "rigidity on alternating diagonals and 0.93 on irregular meshes (see /bending/deflection)",
    .compliance = "1 / k, k in N m (energy ½ k (θ - θ0)² per hinge, times the weight)",
    .settings = table_of<Dihedral>(dihedral_model::fields),
    .softness_needs_compliance = true,
    .softens = true,
    .yields = true,
    .is_reference = true,
    .build = erased<dihedral_model::build>,
};
}  // namespace bendlab
