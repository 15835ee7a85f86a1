// The hinge energy of discrete shells.
#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_hinges.hpp"

namespace bendlab {
namespace discrete_shells_model {

constexpr std::array<std::string_view, 2> measures = {"theta", "tan"};

constexpr std::array fields = {
    field<&DiscreteShells::measure>(
        {.name = "measure",
         .meaning = "theta: the energy of a hinge is ∝ (θ - θ0)²; tan: ∝ (2 tan(θ/2) - 2 tan(θ0/2))², which "
                    "grows without bound as a fold closes",
         .choices = measures}),
};

BendingConstraints build(const DiscreteShells& settings, const BendingInput& input) {
  BendingConstraints constraints;
  // E = K (θ - θ0)² edge / height, where height is a third of the mean height of both triangles, so E = K · 3
  // edge² / area (θ - θ0)². The flexural rigidity on equilateral triangles is D = 6 K.
  std::get<ElementList<HingeAngle>>(constraints.elements) =
      angle_constraints(rest_hinges(input.rest, input.pins, input.is_flat),
                        settings.measure == DiscreteShells::Measure::tangent ? HingeAngle::Law::tangent
                                                                             : HingeAngle::Law::angle,
                        [](const RestHinge& h) { return h.area / (h.edge * h.edge); });
  return constraints;
}

}  // namespace discrete_shells_model

constinit const BendingKind DiscreteShells::kind{
    .name = "discrete_shells",
    .label = "discrete shells",
    .summary = "hinge energy ∝ (θ - θ0)² edge² / area over every interior edge",
    .source = "Grinspun et al. 2003, eq. 3, as XPBD (Macklin et al. 2016); tan: Gingold et al. 2004",
    .limits =
        "its flexural rigidity depends on the mesh (1.3 to 1.7 times the stated rigidity on irregular "
        "meshes); with k the weights have no effect, and from k = 0.7 on it overshoots as dihedral does; "
        "with physical stiffness, a sheet that is bent a little has 0.75 of the stated rigidity on "
        "alternating diagonals and 0.93 on irregular meshes (see /bending/deflection)",
    .compliance =
        "1 / D, D the flexural rigidity in N m on equilateral triangles (6 times Grinspun's constant)",
    .settings = table_of<DiscreteShells>(discrete_shells_model::fields),
    .softness_needs_compliance = true,
    .softens = true,
    .yields = true,
    .build = erased<discrete_shells_model::build>,
};
}  // namespace bendlab
