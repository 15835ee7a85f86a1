#include "bendlab/metrics/motion.hpp"

#include <Eigen/Geometry>

namespace bendlab {

Motion motion_of(std::span<const double> mass, const Positions& positions, const Positions& velocities) {
  double total = 0;
  Vector3 centre = Vector3::Zero();
  for (std::size_t v = 0; v < mass.size(); ++v) {
    total += mass[v];
    centre += mass[v] * positions.row(static_cast<Eigen::Index>(v)).transpose();
  }
  if (total > 0) centre /= total;
  Motion motion;
  for (std::size_t v = 0; v < mass.size(); ++v) {
    const Vector3 x = positions.row(static_cast<Eigen::Index>(v)).transpose() - centre;
    const Vector3 momentum = mass[v] * velocities.row(static_cast<Eigen::Index>(v)).transpose();
    motion.kinetic_energy += 0.5 * momentum.dot(velocities.row(static_cast<Eigen::Index>(v)).transpose());
    motion.linear_momentum += momentum;
    motion.angular_momentum += x.cross(momentum);
  }
  return motion;
}

double drop_below(double level, const Positions& positions, const Vector3& down) {
  return (positions * down).maxCoeff() - level;
}

}  // namespace bendlab
