#include "bendlab/scene/energy.hpp"

#include <numeric>

#include "bendlab/constraints/energy.hpp"
#include "bendlab/metrics/motion.hpp"
#include "bendlab/scene/gravity.hpp"

namespace bendlab {

double elastic_energy(const SimulationInput& input, const Positions& positions) {
  double sum = 0;
  const StrainStiffness& strain = input.strain_stiffness;
  const BendingStiffness& bending = input.bending_stiffness;
  if (strain.kind == StiffnessKind::compliance && strain.compliance > 0)
    sum += elastic_energy(input.strain, strain.form, positions) / strain.compliance;
  if (bending.kind == StiffnessKind::compliance && bending.compliance > 0)
    sum += (elastic_energy(input.distance, positions) + elastic_energy(input.elements, positions) +
            elastic_energy(input.own, positions)) /
           bending.compliance;
  return sum;
}

double potential_energy(const BuiltScene& scene, const Positions& positions) {
  const Vector3 gravity = gravity_of(scene.effects);
  double sum = elastic_energy(scene.input, positions);
  for (std::size_t v = 0; v < scene.input.mass.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    sum -= scene.input.mass[v] * (positions.row(row) - scene.input.positions.row(row)).dot(gravity);
  }
  return sum;
}

double energy_scale(const BuiltScene& scene) {
  const SimulationInput& input = scene.input;
  const double mass = std::accumulate(input.mass.begin(), input.mass.end(), 0.0);
  const Positions at_rest = Positions::Zero(input.positions.rows(), 3);
  const Positions& velocities = input.velocities.rows() > 0 ? input.velocities : at_rest;
  return motion_of(input.mass, input.positions, velocities).kinetic_energy +
         elastic_energy(input, input.positions) + mass * gravity_of(scene.effects).norm() * scene.rest.size();
}

}  // namespace bendlab
