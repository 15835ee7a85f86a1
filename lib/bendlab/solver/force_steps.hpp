// How much the forces of one time step alone deform the cloth, and how many shorter steps limit this.
#pragma once

#include "bendlab/constraints/batches.hpp"
#include "bendlab/constraints/point.hpp"

namespace bendlab {

/// Every triangle has a gradient of the velocity that its vertices gained since `before`, 1/s: the change of
/// the rate of its deformation gradient. Returns the largest Frobenius norm of these gradients; 0 if all
/// vertices gain the same velocity, or if there are no triangles.
template <class Real>
Real largest_gained_gradient(const Point<Real>* velocities, const Point<Real>* before,
                             const StrainBatch<Real>& batch);

/// In a time step, forces alone change a deformation gradient by `change` (1). Returns into how many equal
/// parts the step has to be cut so that forces change the gradient by at most `limit` in each part. The
/// change grows as the square of a step's length. So the number of parts is the square root of change /
/// limit, rounded up, but at most most_force_steps.
int force_steps(double change, double limit);
inline constexpr int most_force_steps = 1000;

}  // namespace bendlab
