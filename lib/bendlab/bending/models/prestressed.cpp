// Springs that push already in the flat sheet: distance springs with a linear bending stiffness.
//
// A spring of rest length L (1 + e) between points L apart has the energy ½ (e L + δ)² / α once bending has
// shortened it by δ = κ² L³ / 24. The part e L δ / α, which is linear in δ, is quadratic in κ: it gives a
// moment B κ. A spring at rest has only the part ½ δ² / α and the moment C κ³. The two parts are equal at κ L
// = sqrt(48 e). The membrane must resist the push. If the membrane gives way, the sheet grows. If strain is
// projected with k, the sheet grows by about the share e.
#include "bendlab/bending/models.hpp"

namespace bendlab {
namespace prestressed_model {

constexpr std::array own_fields = {
    field<&Prestressed::excess>(
        {.name = "excess",
         .unit = "1",
         .meaning = "how much longer a spring is at rest than the distance of its vertices, relative to that "
                    "distance; the moment is linear up to curvatures of about sqrt(48 excess) / the springs' "
                    "length, and cubic beyond",
         .minimum = 1e-6,
         .maximum = 100}),
};
constexpr auto fields = joined(own_fields, thinned_ring_fields<Prestressed>);

BendingConstraints build(const Prestressed& settings, const BendingInput& input) {
  BendingConstraints constraints = thinned_rings(settings, input, 4);
  constraints.distance.store_rest_lengths();
  for (double& length : constraints.distance.rest_length) length *= 1 + settings.excess;
  return constraints;
}

// With k, springs that are longer at rest by the share e stretch the sheet. Mean strain of a sheet of 20
// cells pinned at two corners, with 4 substeps × 10 iterations (without bending 0.007):
//
//   e              0.02    0.05    0.1     0.2     0.5
//   k = 0.1        0.016   0.032   0.060   0.117   0.293
//   k = 0.5        0.028   0.060   0.114   0.227   0.627
//   k = 1          0.031   0.068   0.129   0.257   0.684
double strain_of_k(const Prestressed& settings, double k) {
  // Mean strain divided by e, from the rows of the table.
  constexpr double weak = 0.3, share_of_weak = 0.6, share = 1.2;
  return settings.excess * (k == 0 ? 0 : k < weak ? share_of_weak : share);
}

}  // namespace prestressed_model

constinit const BendingKind Prestressed::kind{
    .name = "prestressed",
    .label = "prestressed",
    .summary =
        "the springs of sparse_lod, but longer at rest than the distance of their vertices, so that they "
        "push in the flat sheet",
    .source = "bendlab's own",
    .limits =
        "the sheet grows if the membrane gives way (with k by about the excess); does not distinguish the "
        "two directions of a fold; the long springs do not resist wrinkles shorter than t edges; with "
        "physical stiffness, an excess that is too large for the solver is lowered (see excess_taken)",
    .compliance =
        "1 / k of a spring as long as t mean edges, k in N/m; springs of other lengths are weighted so that "
        "all springs resist bending alike",
    .settings = table_of<Prestressed>(prestressed_model::fields),
    .springs_only = true,
    .prestressed = true,
    .softness_needs_compliance = true,
    .strain_of_k = erased<prestressed_model::strain_of_k>,
    .strain_of_k_remedy = "A smaller /bending/prestressed/excess helps",
    .build = erased<prestressed_model::build>,
};
}  // namespace bendlab
