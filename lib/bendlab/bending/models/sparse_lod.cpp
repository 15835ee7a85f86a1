// The paper's level-of-detail ring, thinned to a few evenly spread springs per vertex.
#include "bendlab/bending/thinned_rings.hpp"

namespace bendlab {
namespace {

// Bent to the curvature κ, a span of length l shortens by δ = l³ κ² / 24. If all springs have the same energy
// ½ δ² / α, the sheet is equally stiff in all directions.
BendingConstraints build(const BendingInput& input) {
  return thinned_rings(input, 6);
}

}  // namespace

namespace models {
extern constinit const BendingModel sparse_lod{
    .name = "sparse_lod",
    .label = "sparse LOD",
    .summary =
        "a fixed number of springs per vertex to the vertices t rings away, evenly spread over the "
        "directions",
    .source = "bendlab's own, after Kim, §II.4",
    .limits =
        "no linear bending stiffness (moment ∝ κ³), does not know the fold's direction; wrinkles shorter "
        "than t edges can escape the long springs; with k all springs are alike and short ones bend less",
    .compliance =
        "1 / k of a spring as long as t mean edges, k in N/m; others so that all resist bending alike",
    .parameters = thinned_ring_parameters,
    .springs_only = true,
    .softness_needs_compliance = true,
    .build = build,
    .expect = expected_thinned_rings,
};
}  // namespace models
}  // namespace bendlab
