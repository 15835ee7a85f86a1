// How much the forces of one time step alone deform the cloth, and how many shorter steps keep that small.
#pragma once

#include "bendlab/constraints/batches.hpp"
#include "bendlab/constraints/point.hpp"

namespace bendlab {

/// The gradient of the velocities gained since `before`, 1/s: its Frobenius norm in the triangle where it is
/// largest. It changes the rate of the triangle's deformation gradient. 0 where all vertices gain the same
/// velocity, and without triangles.
template <class Real>
Real largest_gained_gradient(const Point<Real>* velocities, const Point<Real>* before,
                             const StrainBatch<Real>& batch);

/// The number of equal steps to cut a time step into in which forces alone change a deformation gradient by
/// `change` (1), so that they change it by at most `limit` in each. The change grows as the square of a
/// step's length, so the number is the square root of change / limit, rounded up; at most most_force_steps.
int force_steps(double change, double limit);
inline constexpr int most_force_steps = 1000;

}  // namespace bendlab
