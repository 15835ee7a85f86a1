// The paper's adaptive springs: levels from the mesh, tight around the pins, loose elsewhere.
#include "bendlab/bending/levels.hpp"
#include "bendlab/bending/ring_springs.hpp"

namespace bendlab {
namespace {

constexpr auto parameters = joined(level_parameters, ring_fill_parameter, ring_rule_parameters);

BendingConstraints build(const BendingInput& input) {
  const Levels levels = adaptive_levels(input.rest, input.parameters);
  RingRule rule = ring_rule(input.parameters);
  rule.fill = ring_fill(input.parameters);
  return {.distance = ring_springs(
              input.rest, input.pins,
              level_of_vertices(input.rest, input.pins, input.parameters, levels.m, levels.n), rule),
          .facts = facts_of(levels)};
}

ExpectedConstraints expect(const ExpectedMesh& mesh, const ParameterValues& values) {
  const Levels levels = adaptive_levels(mesh.size, mesh.mean_edge, values);
  RingRule rule = ring_rule(values);
  rule.fill = ring_fill(values);
  return expected_ring_springs(mesh, rule, levels.m, levels.n);
}

}  // namespace

namespace models {
extern constinit const BendingModel adaptive{
    .name = "adaptive",
    .label = "adaptive",
    .summary =
        "springs to rings 1 … m of free and 1 … n of pinned vertices, levels from the mesh's resolution",
    .source = "Kim, eqs. 6-8 and Fig. 3",
    .limits =
        "no linear bending stiffness (moment ∝ κ³), does not know the fold's direction; with m = 1 (coarse "
        "meshes) free vertices have no bending at all",
    .compliance = "1 / k of every spring, k in N/m",
    .parameters = parameters,
    .springs_only = true,
    .build = build,
    .expect = expect,
};
}  // namespace models
}  // namespace bendlab
