// The hinge of the corotational formulation: moment ∝ sin θ.
#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_hinges.hpp"

namespace bendlab {
namespace corotational_edge_model {

BendingConstraints build(const CorotationalEdge&, const BendingInput& input) {
  BendingConstraints constraints;
  // κ is the sum of both opposite vertices' heights above the plane of the mean normal, divided by their
  // heights in the rest shape: 2 sin(θ/2) edge / area. The energy is ½ D area κ².
  std::get<ElementList<HingeAngle>>(constraints.elements) =
      angle_constraints(rest_hinges(input.rest, input.pins, input.is_flat), HingeAngle::Law::sine,
                        [](const RestHinge& h) { return h.area / (h.edge * h.edge); });
  return constraints;
}

}  // namespace corotational_edge_model

constinit const BendingKind CorotationalEdge::kind{
    .name = "corotational_edge",
    .label = "corotational edge",
    .summary = "hinge energy ∝ (2 sin(θ/2))² edge² / area over every interior edge",
    .source = "Chen, Kaufman and Vouga 2026, corotational hinge with an edge stencil, at rest heights",
    .limits =
        "as discrete_shells; its moment falls beyond a right angle, so it hardly opens a closed "
        "fold; with k it does not act beyond 134 degrees",
    .compliance =
        "1 / D, D the flexural rigidity in N m on equilateral triangles, as that of discrete_shells",
    .settings = table_of<CorotationalEdge>({}),
    .softness_needs_compliance = true,
    .softens = true,
    .build = erased<corotational_edge_model::build>,
};
}  // namespace bendlab
