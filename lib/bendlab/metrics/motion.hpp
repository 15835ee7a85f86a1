// Kinetic energy and momenta of a cloth, treated as a set of point masses.
#pragma once

#include <span>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

struct Motion {
  double kinetic_energy = 0;                   ///< J
  Vector3 linear_momentum = Vector3::Zero();   ///< kg m/s
  Vector3 angular_momentum = Vector3::Zero();  ///< kg m²/s, about the centre of mass
};

/// `mass` #V in kg; positions (m) and velocities (m/s) #V by 3.
Motion motion_of(std::span<const double> mass, const Positions& positions, const Positions& velocities);

/// How far the lowest vertex lies below `level`, m. Heights are measured along `down` (unit length).
double drop_below(double level, const Positions& positions, const Vector3& down);

}  // namespace bendlab
