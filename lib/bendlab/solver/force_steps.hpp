// How much the forces of one time step alone deform the cloth, and how many shorter steps keep that small.
#pragma once

#include "bendlab/constraints/batches.hpp"
#include "bendlab/constraints/point.hpp"

namespace bendlab {

/// The largest Frobenius norm, over all triangles, of the gradient of the velocity gained since `before`,
/// 1/s. This gradient is the change of the rate of the triangle's deformation gradient. 0 if all vertices
/// gain the same velocity, or if there are no triangles.
template <class Real>
Real largest_gained_gradient(const Point<Real>* velocities, const Point<Real>* before,
                             const StrainBatch<Real>& batch);

/// In a time step, forces alone change a deformation gradient by `change` (1). Returns the number of equal
/// parts to cut the step into so that forces change the gradient by at most `limit` in each part. The change
/// grows as the square of a step's length, so the number is the square root of change / limit, rounded up; at
/// most most_force_steps.
int force_steps(double change, double limit);
inline constexpr int most_force_steps = 1000;

}  // namespace bendlab
