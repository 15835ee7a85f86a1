// The paper's level-of-detail springs: only to the vertices exactly t rings away.
#include "bendlab/bending/models.hpp"

namespace bendlab {
namespace lod_model {

constexpr std::array own_fields = {
    field<&Lod::t>({.name = "t",
                    .unit = "1",
                    .meaning = "LOD level of every vertex, in the paper's range [m, n]; 0: m for free "
                               "vertices and n for pinned vertices",
                    .minimum = 0,
                    .maximum = 1000}),
    field<&Lod::ring_1>(
        {.name = "ring_1",
         .meaning =
             "whether springs to ring 1, the mesh's own edges, are added; the paper names ring t alone"}),
};
constexpr auto fields = joined(own_fields, level_fields<Lod>, ring_rule_fields<Lod>);

RingRule rule_of(const Lod& settings) {
  return ring_rule(settings, settings.ring_1 ? RingFill::ends : RingFill::last);
}

BendingConstraints build(const Lod& settings, const BendingInput& input) {
  const Levels levels = adaptive_levels(input, settings);
  const int t = settings.t;
  BendingConstraints constraints;
  constraints.distance = ring_springs(
      input, level_of_vertices(input.rest, input.pins, settings, t ? t : levels.m, t ? t : levels.n),
      rule_of(settings));
  constraints.facts = facts_of(levels);
  constraints.facts.push_back(
      {"t", static_cast<double>(t),
       "LOD level of every vertex; 0: m for free vertices and n for pinned vertices"});
  return constraints;
}

double springs(const Lod& settings, double size, double mean_edge) {
  return springs_per_vertex(rule_of(settings),
                            settings.t ? settings.t : adaptive_levels(size, mean_edge, settings).m);
}

}  // namespace lod_model

constinit const BendingKind Lod::kind{
    .name = "lod",
    .label = "LOD",
    .summary = "springs only to the vertices exactly t rings away",
    .source = "Kim, §II.4 and Fig. 4",
    .limits =
        "no linear bending stiffness (moment ∝ κ³); does not distinguish the two directions of a fold; the "
        "long springs do not resist wrinkles shorter than t edges",
    .compliance = "1 / k of every spring, k in N/m",
    .settings = table_of<Lod>(lod_model::fields),
    .springs_only = true,
    .build = erased<lod_model::build>,
    .springs_per_vertex = erased<lod_model::springs>,
};
}  // namespace bendlab
