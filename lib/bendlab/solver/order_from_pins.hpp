// Orders constraints by their distance from the pins, so that those that hold the cloth are met before those
// that hang from them.
#pragma once

#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// Sorts the lists by the number of edges between a constraint's nearest vertex and the nearest pin. At equal
/// distance the order stays; without pins nothing changes.
void order_from_pins(SimulationInput& input, const RestMesh& rest);

}  // namespace bendlab
