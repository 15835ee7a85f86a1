#include "bendlab/scene/energy.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "bendlab/constraints/energy.hpp"
#include "bendlab/constraints/yielding.hpp"
#include "bendlab/metrics/motion.hpp"
#include "bendlab/scene/gravity.hpp"
#include "bendlab/solver/elastic_system.hpp"

namespace bendlab {

double membrane_energy(const SimulationInput& input, const Positions& positions) {
  const StrainStiffness& strain = input.strain_stiffness;
  if (strain.kind != StiffnessKind::compliance || !(strain.compliance > 0)) return 0;
  return elastic_energy(input.strain, strain.form, positions, strain.area, strain.softness) /
         strain.compliance;
}

double bending_energy(const SimulationInput& input, const Positions& positions, Positions* directors) {
  const BendingStiffness& bending = input.bending_stiffness;
  if (bending.kind != StiffnessKind::compliance || !(bending.compliance > 0)) return 0;
  const bool begun = directors != nullptr && directors->rows() > 0;
  const Positions found = relaxed_directors(input.directors, input.elements, input.own, positions,
                                            begun ? *directors : input.directors.rest);
  if (directors != nullptr) *directors = found;
  const Positions points = joined(positions, found);
  return (elastic_energy(input.distance, points) + elastic_energy(input.elements, points) +
          elastic_energy(input.own, points)) /
         bending.compliance;
}

double elastic_energy(const SimulationInput& input, const Positions& positions, Positions* directors) {
  return membrane_energy(input, positions) + bending_energy(input, positions, directors);
}

std::vector<EnergyPart> energy_parts(const SimulationInput& input, const Positions& positions) {
  std::vector<EnergyPart> parts;
  const Positions points = input.points_at(positions);
  SimulationInput bare = input;
  bare.strain = {}, bare.edges = {}, bare.distance = {}, bare.elements = {}, bare.own = {};
  std::ranges::fill(bare.is_pinned, 0);
  bare.held.clear();
  const auto add = [&](std::string_view name, const auto& fill) {
    SimulationInput part = bare;
    fill(part);
    const ElasticSystem system(part);
    const Points<double> forces = system.forces(points);
    EnergyPart& result = parts.emplace_back(EnergyPart{std::string(name), system.energy(points), {}});
    result.forces.resize(positions.rows(), 3);
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
      result.forces.row(v) = forces[static_cast<std::size_t>(v)].vector().transpose();
  };
  const auto has_energy = [](const auto& stiffness) {
    return stiffness.kind == StiffnessKind::compliance && stiffness.compliance > 0;
  };
  if (input.strain.size() > 0 && has_energy(input.strain_stiffness))
    add("strain", [&](SimulationInput& part) { part.strain = input.strain; });
  if (!has_energy(input.bending_stiffness)) return parts;
  if (input.distance.size() > 0)
    add("distance", [&](SimulationInput& part) { part.distance = input.distance; });
  if (input.own.size() > 0)
    add(input.own.function->name(), [&](SimulationInput& part) { part.own = input.own; });
  for_each_kind(input.elements, [&]<class Kind>(const ElementList<Kind>& list) {
    if (list.size() > 0)
      add(Kind::name, [&](SimulationInput& part) { std::get<ElementList<Kind>>(part.elements) = list; });
  });
  return parts;
}

bool has_history(const SimulationInput& input) {
  return can_yield(input.elements) || input.strain_schedule.is_given() || input.bending_schedule.is_given();
}

double potential_energy(const BuiltScene& scene, const Positions& positions, Positions* directors) {
  if (has_history(scene.input)) return std::numeric_limits<double>::quiet_NaN();
  const Vector3 gravity = gravity_of(scene.effects);
  double sum = elastic_energy(scene.input, positions, directors);
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
