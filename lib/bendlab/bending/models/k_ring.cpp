// Springs to a fixed number of rings around every vertex.
#include "bendlab/bending/models.hpp"

namespace bendlab {
namespace k_ring_model {

constexpr std::array own_fields = {
    field<&KRing::k>(
        {.name = "k",
         .unit = "1",
         .meaning =
             "the farthest ring that springs of a vertex reach; with 1, springs lie only on the mesh's edges",
         .minimum = 1,
         .maximum = 1000}),
};
constexpr auto fields = joined(own_fields, ring_fill_field<KRing>, ring_rule_fields<KRing>);

BendingConstraints build(const KRing& settings, const BendingInput& input) {
  const std::vector<int> levels(static_cast<std::size_t>(input.rest.vertex_count()), settings.k);
  return {
      .distance = ring_springs(input, levels, ring_rule(settings, settings.rings)),
      .facts = {{"k", static_cast<double>(settings.k), "the farthest ring that springs of a vertex reach"}}};
}

double springs(const KRing& settings, double /*size*/, double /*mean_edge*/) {
  return springs_per_vertex(ring_rule(settings, settings.rings), settings.k);
}

}  // namespace k_ring_model

constinit const BendingKind KRing::kind{
    .name = "k_ring",
    .label = "k-ring",
    .summary = "springs from every vertex to its rings 1 … k, or to ring k alone",
    .source = "Kim, Fig. 3, with one fixed level",
    .limits =
        "no linear bending stiffness (moment ∝ κ³); does not distinguish the two directions of a fold; "
        "softer on finer meshes",
    .compliance = "1 / k of every spring, k in N/m",
    .settings = table_of<KRing>(k_ring_model::fields),
    .springs_only = true,
    .build = erased<k_ring_model::build>,
    .springs_per_vertex = erased<k_ring_model::springs>,
};
}  // namespace bendlab
