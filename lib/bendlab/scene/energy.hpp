// The energies of a scene's cloth, J.
#pragma once

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

/// The energy of the strain and bending constraints with a compliance above 0. A stiffness k has no energy.
double elastic_energy(const SimulationInput& input, const Positions& positions);

/// Elastic energy plus the energy in the field of gravity, relative to the start pose.
double potential_energy(const BuiltScene& scene, const Positions& positions);

/// A typical energy: kinetic and elastic energy at the start, plus the cloth's weight (N) times its size (m).
double energy_scale(const BuiltScene& scene);

}  // namespace bendlab
