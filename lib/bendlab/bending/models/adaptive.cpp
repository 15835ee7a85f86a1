// The paper's adaptive springs: levels from the mesh, tight around the pins, loose elsewhere.
#include "bendlab/bending/models.hpp"

namespace bendlab {
namespace {

constexpr auto fields = joined(level_fields<Adaptive>, ring_fill_field<Adaptive>, ring_rule_fields<Adaptive>);

BendingConstraints build(const Adaptive& settings, const BendingInput& input) {
  const Levels levels = adaptive_levels(input.rest, settings);
  return {.distance = ring_springs(input.rest, input.pins,
                                   level_of_vertices(input.rest, input.pins, settings, levels.m, levels.n),
                                   ring_rule(settings, settings.rings)),
          .facts = facts_of(levels)};
}

ExpectedConstraints expect(const Adaptive& settings, const ExpectedMesh& mesh) {
  const Levels levels = adaptive_levels(mesh.size, mesh.mean_edge, settings);
  return expected_ring_springs(mesh, ring_rule(settings, settings.rings), levels.m, levels.n);
}

}  // namespace

constinit const BendingKind Adaptive::kind{
    .name = "adaptive",
    .label = "adaptive",
    .summary =
        "springs to rings 1 … m of free and 1 … n of pinned vertices, levels from the mesh's resolution",
    .source = "Kim, eqs. 6-8 and Fig. 3",
    .limits =
        "no linear bending stiffness (moment ∝ κ³), does not know the fold's direction; with m = 1 (coarse "
        "meshes) free vertices have no bending at all",
    .compliance = "1 / k of every spring, k in N/m",
    .settings = table_of<Adaptive>(fields),
    .springs_only = true,
    .build = erased<build>,
    .expect = erased<expect>,
};
}  // namespace bendlab
