// The energies of a scene's cloth, J.
#pragma once

#include <string>
#include <vector>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

/// The energy of the strain and bending constraints with a compliance above 0. A stiffness k has no energy.
double elastic_energy(const SimulationInput& input, const Positions& positions);

/// The energy and the forces of one kind of constraint.
struct EnergyPart {
  std::string name;  ///< "strain", "distance", or the name of the kind of elements
  double energy;     ///< J
  Positions forces;  ///< #V by 3, N, on pinned vertices, too
};
/// The parts of the elastic energy at these positions (#V by 3, m), for every kind of constraint that has
/// constraints and a compliance above 0. Directors have the least energy.
std::vector<EnergyPart> energy_parts(const SimulationInput& input, const Positions& positions);

/// Elastic energy plus the energy in the field of gravity, relative to the start pose.
double potential_energy(const BuiltScene& scene, const Positions& positions);

/// A typical energy: kinetic and elastic energy at the start, plus the cloth's weight (N) times its size (m).
double energy_scale(const BuiltScene& scene);

}  // namespace bendlab
