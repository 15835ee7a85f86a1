// Sorts constraints by their distance from the pins, so that constraints near pins are projected first.
#pragma once

#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// Sorts the lists by the number of edges between a constraint's nearest vertex and the nearest pin.
/// Constraints at equal distances keep their order. Without pins nothing changes.
void order_from_pins(SimulationInput& input, const RestMesh& rest);

}  // namespace bendlab
