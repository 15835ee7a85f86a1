// The curvature of each triangle from the heights of its neighbours above its plane.
#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_faces.hpp"

namespace bendlab {
namespace corotational_face_model {

BendingConstraints build(const CorotationalFace&, const BendingInput& input) {
  BendingConstraints constraints;
  // κ at an edge is the angle over the mean of both heights' halves: X / h_beyond · 2 / (h + h_beyond). In
  // terms of the edge e and the areas it is X e² / ((A + A_beyond) 2 A_beyond).
  std::get<ElementList<FoldBend>>(constraints.elements) =
      fold_constraints(input, FoldBend::Law::height, 1, [](const RestFace& face, std::size_t i) {
        return 2 / ((face.height[i] + face.height_beyond[i]) * face.height_beyond[i]);
      });
  return constraints;
}

}  // namespace corotational_face_model

constinit const BendingKind CorotationalFace::kind{
    .name = "corotational_face",
    .label = "corotational face",
    .summary = "the curvature of each triangle, from the heights of its three neighbours above its plane",
    .source = "Chen, Kaufman and Vouga 2026, corotational hinge with a face stencil",
    .limits =
        "sees no curvature at the border of the sheet; a sheet that is bent a little has less than the "
        "stated rigidity",
    .compliance = "1 / D, D the flexural rigidity in N m of a cylinder",
    .settings = table_of<CorotationalFace>({}),
    .softness_needs_compliance = true,
    .rigidity_by_formula = true,
    .takes_poisson_ratio = true,
    .takes_directions = true,
    .softens = true,
    .yields = true,
    .build = erased<corotational_face_model::build>,
};
}  // namespace bendlab
