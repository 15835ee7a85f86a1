// The energies of a scene's cloth in J: kinetic energy, elastic energy, and energy of weight.
#pragma once

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

/// The energy of strain and bending constraints with a compliance above 0; constraints with k have no energy.
double elastic_energy(const SimulationInput& input, const Positions& positions);

/// Elastic energy plus energy of weight, which is 0 in the pose at the start.
double potential_energy(const BuiltScene& scene, const Positions& positions);

/// A scale for the scene's energies: kinetic and elastic energy at the start, plus weight times size.
double energy_scale(const BuiltScene& scene);

}  // namespace bendlab
