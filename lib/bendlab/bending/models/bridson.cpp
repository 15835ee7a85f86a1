// The bending element with the elastic force of Bridson, Marino and Fedkiw.
#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_hinges.hpp"

namespace bendlab {
namespace bridson_model {

BendingConstraints build(const Bridson&, const BendingInput& input) {
  BendingConstraints constraints;
  // The force is k_e edge² / (|N1| + |N2|) (sin θ/2 - sin θ0/2) u, where |N| is twice a triangle's area. So
  // the energy is k_e edge² / (2 area) V with V of HingeAngle::Law::half_sine, at rest lengths and areas.
  std::get<ElementList<HingeAngle>>(constraints.elements) =
      angle_constraints(rest_hinges(input.rest, input.pins, input.is_flat), HingeAngle::Law::half_sine,
                        [](const RestHinge& h) { return 2 * h.area / (h.edge * h.edge); });
  return constraints;
}

}  // namespace bridson_model

constinit const BendingKind Bridson::kind{
    .name = "bridson",
    .label = "Bridson",
    .summary = "bending element: moment ∝ sin(θ/2) - sin(θ0/2) over every interior edge",
    .source = "Bridson et al. 2003, §4, elastic part, as XPBD",
    .limits =
        "with k its stiffness depends on resolution, iterations and time step, and from k = 0.7 on it "
        "overshoots as dihedral does; takes the weights from the rest shape, while the paper takes them from "
        "the current shape; with physical stiffness, a sheet that is bent a little has 0.75 of the stated "
        "rigidity on alternating diagonals and 0.93 on irregular meshes (see /bending/deflection)",
    .compliance = "1 / k_e, k_e in N m; flexural rigidity k_e / 4 on equilateral triangles",
    .settings = table_of<Bridson>({}),
    .softness_needs_compliance = true,
    .softens = true,
    .build = erased<bridson_model::build>,
};
}  // namespace bendlab
