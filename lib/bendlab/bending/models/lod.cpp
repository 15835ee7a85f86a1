// The paper's level-of-detail springs: only to the vertices exactly t rings away.
#include "bendlab/bending/levels.hpp"
#include "bendlab/bending/ring_springs.hpp"

namespace bendlab {
namespace {

constexpr std::array own_parameters = {
    Parameter{
        .name = "t",
        .type = ParameterType::integer,
        .unit = "1",
        .default_value = 0,
        .meaning =
            "target level, for every vertex; the paper wants it in [m, n]; 0 takes m for free and n for "
            "pinned vertices",
        .minimum = 0,
        .maximum = 1000},
    Parameter{.name = "ring_1",
              .type = ParameterType::boolean,
              .default_value = false,
              .meaning = "also springs to ring 1, the mesh's own edges; the paper names ring t alone"},
};
constexpr auto parameters = joined(own_parameters, level_parameters, ring_rule_parameters);

BendingConstraints build(const BendingInput& input) {
  const Levels levels = adaptive_levels(input.rest, input.parameters);
  const int t = static_cast<int>(input.parameters.integer("t"));
  RingRule rule = ring_rule(input.parameters);
  rule.fill = input.parameters.boolean("ring_1") ? RingFill::ends : RingFill::last;
  BendingConstraints constraints;
  constraints.distance = ring_springs(
      input.rest, input.pins,
      level_of_vertices(input.rest, input.pins, input.parameters, t ? t : levels.m, t ? t : levels.n), rule);
  constraints.facts = facts_of(levels);
  constraints.facts.push_back(
      {"t", static_cast<double>(t), "fixed target level; 0: m for free, n for pinned vertices"});
  return constraints;
}

ExpectedConstraints expect(const ExpectedMesh& mesh, const ParameterValues& values) {
  const Levels levels = adaptive_levels(mesh.size, mesh.mean_edge, values);
  const int t = static_cast<int>(values.integer("t"));
  RingRule rule = ring_rule(values);
  rule.fill = values.boolean("ring_1") ? RingFill::ends : RingFill::last;
  return expected_ring_springs(mesh, rule, t ? t : levels.m, t ? t : levels.n);
}

}  // namespace

namespace models {
extern constinit const BendingModel lod{
    .name = "lod",
    .label = "LOD",
    .summary = "springs only to the vertices exactly t rings away",
    .source = "Kim, §II.4 and Fig. 4",
    .limits =
        "no linear bending stiffness (moment ∝ κ³), does not know the fold's direction; wrinkles shorter "
        "than t edges can escape the long springs",
    .compliance = "1 / k of every spring, k in N/m",
    .parameters = parameters,
    .springs_only = true,
    .build = build,
    .expect = expect,
};
}  // namespace models
}  // namespace bendlab
