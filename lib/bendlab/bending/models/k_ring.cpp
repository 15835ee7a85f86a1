// Springs to a fixed number of rings around every vertex.
#include "bendlab/bending/ring_springs.hpp"

namespace bendlab {
namespace {

constexpr std::array own_parameters = {
    Parameter{.name = "k",
              .type = ParameterType::integer,
              .unit = "1",
              .default_value = 2,
              .meaning = "level of every vertex; 1 joins only the mesh's own edges",
              .minimum = 1,
              .maximum = 1000},
};
constexpr auto parameters = joined(own_parameters, ring_fill_parameter, ring_rule_parameters);

BendingConstraints build(const BendingInput& input) {
  const int k = static_cast<int>(input.parameters.integer("k"));
  RingRule rule = ring_rule(input.parameters);
  rule.fill = ring_fill(input.parameters);
  const std::vector<int> levels(static_cast<std::size_t>(input.rest.vertex_count()), k);
  return {.distance = ring_springs(input.rest, input.pins, levels, rule),
          .facts = {{"k", static_cast<double>(k), "level of every vertex"}}};
}

ExpectedConstraints expect(const ExpectedMesh& mesh, const ParameterValues& values) {
  const int k = static_cast<int>(values.integer("k"));
  RingRule rule = ring_rule(values);
  rule.fill = ring_fill(values);
  return expected_ring_springs(mesh, rule, k, k);
}

}  // namespace

namespace models {
extern constinit const BendingModel k_ring{
    .name = "k_ring",
    .label = "k-ring",
    .summary = "springs from every vertex to its rings 1 … k, or to ring k alone",
    .source = "Kim, Fig. 3, with one fixed level",
    .limits =
        "no linear bending stiffness (moment ∝ κ³), does not know the fold's direction, softer on finer "
        "meshes",
    .compliance = "1 / k of every spring, k in N/m",
    .parameters = parameters,
    .springs_only = true,
    .build = build,
    .expect = expect,
};
}  // namespace models
}  // namespace bendlab
