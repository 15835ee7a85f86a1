// The curvature of each triangle from the mean normals at its edges.
#include "bendlab/bending/models.hpp"
#include "bendlab/bending/rest_faces.hpp"

namespace bendlab {
namespace mid_edge_average_model {

BendingConstraints build(const MidEdgeAverage&, const BendingInput& input) {
  BendingConstraints constraints;
  std::get<ElementList<FoldBend>>(constraints.elements) = fold_constraints(
      input, FoldBend::Law::sine, 0.5,
      [](const RestFace& face, std::size_t i) { return 2 / (face.height[i] * face.height[i]); });
  return constraints;
}

}  // namespace mid_edge_average_model

constinit const BendingKind MidEdgeAverage::kind{
    .name = "mid_edge_average",
    .label = "mid-edge average",
    .summary = "the curvature of each triangle, from the mean of the two triangles' normals at each edge",
    .source = "Gingold et al. 2004; Chen et al. 2018 (libshell), six vertices",
    .limits =
        "sees no curvature at the border of the sheet, and little of some saddles; a sheet that is bent "
        "a little finds shapes without bending energy",
    .compliance = "1 / D, D the flexural rigidity in N m of a cylinder",
    .settings = table_of<MidEdgeAverage>({}),
    .softness_needs_compliance = true,
    .rigidity_by_formula = true,
    .takes_poisson_ratio = true,
    .takes_directions = true,
    .softens = true,
    .yields = true,
    .build = erased<mid_edge_average_model::build>,
};
}  // namespace bendlab
