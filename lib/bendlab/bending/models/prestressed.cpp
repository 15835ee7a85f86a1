// Springs that push already in the flat sheet: distance springs with a linear bending stiffness.
//
// A spring of rest length L (1 + e) between points L apart has the energy ½ (e L + δ)² / α once bending has
// shortened it by δ = κ² L³ / 24. Its part that is linear in δ, e L δ / α, is quadratic in κ: a moment B κ. A
// spring at rest has only ½ δ² / α and the moment C κ³. The two are equal at κ L = sqrt(48 e). The membrane
// holds the sheet against the push. As far as it gives way, the sheet grows: by about the share e if strain
// is projected with k.
#include "bendlab/bending/thinned_rings.hpp"

namespace bendlab {
namespace {

constexpr std::array own_parameters = {
    Parameter{
        .name = "excess",
        .type = ParameterType::number,
        .unit = "1",
        .default_value = 0.02,
        .meaning =
            "how much longer than its pair's distance a spring is at rest, relative to it: the moment is "
            "linear up to curvatures of about sqrt(48 excess) / the springs' length, cubic beyond",
        .minimum = 1e-6,
        .maximum = 100},
};
constexpr auto parameters = joined(own_parameters, thinned_ring_parameters);

BendingConstraints build(const BendingInput& input) {
  BendingConstraints constraints = thinned_rings(input, 4);
  const double excess = input.parameters.number("excess");
  constraints.distance.store_rest_lengths();
  for (double& length : constraints.distance.rest_length) length *= 1 + excess;
  return constraints;
}

}  // namespace

namespace models {
extern constinit const BendingModel prestressed{
    .name = "prestressed",
    .label = "prestressed",
    .summary =
        "the springs of sparse_lod, longer at rest than their pairs are apart: they push in the flat sheet",
    .source = "bendlab's own",
    .limits =
        "the sheet grows as far as the membrane gives way (with k by about the excess); does not know the "
        "fold's direction; wrinkles shorter than t edges can escape the long springs; physical: an excess "
        "that the solver cannot hold is lowered, see excess_taken",
    .compliance =
        "1 / k of a spring as long as t mean edges, k in N/m; others so that all resist bending alike",
    .parameters = parameters,
    .springs_only = true,
    .prestressed = true,
    .softness_needs_compliance = true,
    .build = build,
    .expect = expected_thinned_rings,
};
}  // namespace models
}  // namespace bendlab
