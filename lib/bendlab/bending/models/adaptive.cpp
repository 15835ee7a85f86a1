// The paper's adaptive springs: long springs around the pins, shorter springs elsewhere.
#include "bendlab/bending/models.hpp"

namespace bendlab {
namespace adaptive_model {

constexpr auto fields = joined(level_fields<Adaptive>, ring_fill_field<Adaptive>, ring_rule_fields<Adaptive>);

BendingConstraints build(const Adaptive& settings, const BendingInput& input) {
  const Levels levels = adaptive_levels(input, settings);
  return {
      .distance = ring_springs(input, level_of_vertices(input.rest, input.pins, settings, levels.m, levels.n),
                               ring_rule(settings, settings.rings)),
      .facts = facts_of(levels)};
}

double springs(const Adaptive& settings, double size, double mean_edge) {
  return springs_per_vertex(ring_rule(settings, settings.rings),
                            adaptive_levels(size, mean_edge, settings).m);
}

}  // namespace adaptive_model

constinit const BendingKind Adaptive::kind{
    .name = "adaptive",
    .label = "adaptive",
    .summary =
        "springs to rings 1 … m of free vertices and 1 … n of pinned vertices; m and n follow from the "
        "mesh's resolution",
    .source = "Kim, eqs. 6-8 and Fig. 3",
    .limits =
        "no linear bending stiffness (moment ∝ κ³); does not distinguish the two directions of a fold; with "
        "m = 1 (coarse meshes) free vertices do not resist bending at all",
    .compliance = "1 / k of every spring, k in N/m",
    .settings = table_of<Adaptive>(adaptive_model::fields),
    .springs_only = true,
    .build = erased<adaptive_model::build>,
    .springs_per_vertex = erased<adaptive_model::springs>,
};
}  // namespace bendlab
