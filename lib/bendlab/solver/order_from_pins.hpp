// Constraints nearest to the pins first: what holds the cloth is right before what hangs from it is
// corrected.
#pragma once

#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// Sorts the lists by how many edges a constraint's nearest vertex is from the nearest pinned one, keeping
/// their order at the same distance; without pins nothing changes.
void order_from_pins(SimulationInput& input, const RestMesh& rest);

}  // namespace bendlab
