// How much free flight deforms the cloth: what a time step has to be short for.
#pragma once

#include "bendlab/constraints/batches.hpp"
#include "bendlab/constraints/point.hpp"

namespace bendlab {

/// The largest gradient over a triangle of what velocities gained since `before`, 1/s: the change of the rate of its deformation
/// gradient, as a Frobenius norm. What all gain alike has none. 0 without triangles.
template <class Real>
Real largest_gradient(const Point<Real>* velocities, const Point<Real>* before,
                      const StrainBatch<Real>& batch);

/// Into how many equal parts to cut a time step in which forces alone change a deformation gradient by `flight` (1), so that
/// they change it by at most `limit` in each: as many as the root of their ratio, since they act for as much shorter on as
/// much shorter a way. At most most_parts.
int parts_of_flight(double flight, double limit);
inline constexpr int most_parts = 1000;

}  // namespace bendlab
