// How much free flight deforms the cloth: what a time step has to be short for.
#pragma once

#include "bendlab/constraints/batches.hpp"
#include "bendlab/constraints/point.hpp"

namespace bendlab {

/// The largest gradient over a triangle of what velocities gained since `before`, 1/s: the change of the rate
/// of its deformation gradient, as a Frobenius norm. A gain that all vertices share has no gradient. 0
/// without triangles.
template <class Real>
Real largest_gradient(const Point<Real>* velocities, const Point<Real>* before,
                      const StrainBatch<Real>& batch);

/// Into how many equal parts to cut a time step in which forces alone change a deformation gradient by
/// `flight` (1), so that they change it by at most `limit` in each. The change grows as the square of a
/// part's length, so it takes the square root of flight / limit, rounded up; at most most_parts.
int parts_of_flight(double flight, double limit);
inline constexpr int most_parts = 1000;

}  // namespace bendlab
