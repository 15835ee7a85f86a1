// How much free flight deforms the cloth: what a time step has to be short for.
#pragma once

#include "bendlab/constraints/batches.hpp"
#include "bendlab/constraints/point.hpp"

namespace bendlab {

/// The largest velocity gradient of a triangle, 1/s: the rate Ḟ of its deformation gradient, as a Frobenius norm. Moving as a
/// whole has none, turning has √2 times the angular velocity. 0 without triangles.
template <class Real>
Real largest_velocity_gradient(const Point<Real>* velocities, const StrainBatch<Real>& batch);

/// Into how many equal parts to cut a time h (s), so that a flight that starts with the velocity gradient `bare` and has `loaded`
/// (1/s) after h under its forces changes no deformation gradient by more than `limit` (1) in the first part; at most `most`.
int parts_of_flight(double h, double bare, double loaded, double limit, int most);

}  // namespace bendlab
