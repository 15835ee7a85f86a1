// The paper's level-of-detail ring, thinned to a few evenly spread springs per vertex.
#include "bendlab/bending/models.hpp"

namespace bendlab {
namespace sparse_lod_model {

// In a sheet that is bent to the curvature κ, a spring of length l shortens by δ = l³ κ² / 24. If all springs
// have the same energy ½ δ² / α, the sheet is equally stiff in all directions.
BendingConstraints build(const SparseLod& settings, const BendingInput& input) {
  return thinned_rings(settings, input, 6);
}

}  // namespace sparse_lod_model

constinit const BendingKind SparseLod::kind{
    .name = "sparse_lod",
    .label = "sparse LOD",
    .summary =
        "a fixed number of springs per vertex to the vertices t rings away, evenly spread over the "
        "directions",
    .source = "bendlab's own, after Kim, §II.4",
    .limits =
        "no linear bending stiffness (moment ∝ κ³); does not distinguish the two directions of a fold; the "
        "long springs do not resist wrinkles shorter than t edges; with k all springs have the same weight, "
        "so short springs resist bending less",
    .compliance =
        "1 / k of a spring as long as t mean edges, k in N/m; springs of other lengths are weighted so that "
        "all springs resist bending alike",
    .settings = table_of<SparseLod>(thinned_ring_fields<SparseLod>),
    .springs_only = true,
    .softness_needs_compliance = true,
    .build = erased<sparse_lod_model::build>,
};
}  // namespace bendlab
