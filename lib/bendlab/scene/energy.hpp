// The energies of a scene's cloth, J.
#pragma once

#include <string>
#include <vector>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

/// The energy of the strain constraints, and of the bending constraints, with the stiffness as stated
/// (without over_time). 0 if their stiffness is k, or their compliance is 0.
double membrane_energy(const SimulationInput& input, const Positions& positions);
/// Directors take the values with the least energy. If `directors` is given, the search starts there (#D by
/// 3, m; empty: at rest) and stores its result there. So the energies of one pose after another are found
/// faster.
double bending_energy(const SimulationInput& input, const Positions& positions,
                      Positions* directors = nullptr);
/// The sum of both.
double elastic_energy(const SimulationInput& input, const Positions& positions,
                      Positions* directors = nullptr);

/// The energy and the forces of one kind of constraint.
struct EnergyPart {
  std::string name;  ///< "strain", "distance", or the name of the kind of elements
  double energy;     ///< J
  Positions forces;  ///< #V by 3, N, on pinned vertices, too
};
/// The parts of the elastic energy at these positions (#V by 3, m), for every kind of constraint that has
/// constraints and a compliance above 0. Directors have the least energy.
std::vector<EnergyPart> energy_parts(const SimulationInput& input, const Positions& positions);

/// Whether the elastic energy depends on more than the pose: on how the cloth moved (internal friction,
/// plastic folds), or on time (over_time). The functions above use the stated stiffness and the rest shape at
/// the start.
bool has_history(const SimulationInput& input);

/// Elastic energy plus the energy in the field of gravity, relative to the start pose. NaN if has_history().
/// `directors`: as for bending_energy().
double potential_energy(const BuiltScene& scene, const Positions& positions, Positions* directors = nullptr);

/// A typical energy: kinetic and elastic energy at the start, plus the cloth's weight (N) times its size (m).
double energy_scale(const BuiltScene& scene);

}  // namespace bendlab
