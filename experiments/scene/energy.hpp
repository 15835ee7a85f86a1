// The energy of a scene's cloth, J: what moves between kinetic, elastic and that of weight.
#pragma once

#include "experiments/scene/scene.hpp"

namespace bendlab {

/// Of strain (normalised form) and bending constraints with a compliance above 0; k has none.
double elastic_energy(const SimulationInput& input, const Positions& positions);

/// Elastic energy and that of weight, which is 0 where the scene starts.
double potential_energy(const Scene& scene, const Positions& positions);

/// The size of the scene's energies: kinetic and elastic energy at the start, and weight times size.
double energy_scale(const Scene& scene);

}  // namespace bendlab
