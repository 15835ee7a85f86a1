// How far a pose of a cloth is from a reference pose. If a rigid motion is not an error, align the two poses
// first (alignment.hpp).
#pragma once

#include <span>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Distances between the points of a pose and the same points of the reference, m.
struct ShapeError {
  double rms = 0;      ///< root mean square over the cloth: √(Σ weight |x - x'|² / Σ weight)
  double largest = 0;  ///< largest distance of a point with a positive weight
};

/// `pose` and `reference` are #V by 3, m. `weight` (#V, not negative) is the part of the cloth that each
/// point stands for, for example its lumped area.
ShapeError shape_error(const Positions& pose, const Positions& reference, std::span<const double> weight);

/// Hausdorff distance of two surfaces with any points, m: each vertex has a distance from the nearest
/// triangle of the other surface, and the largest of these distances counts. Vertices in no triangle are
/// ignored. Throws std::invalid_argument if a surface has no triangle.
double hausdorff_distance(const TriangleMesh& first, const TriangleMesh& second);

/// The difference in membrane strain: the root mean square of |E - E'| (Frobenius norm) over the cloth's
/// area. E is the Green strain (FᵀF - 1)/2 in the pose, E' in the reference. Ignores triangles without rest
/// area.
double strain_error(const RestMesh& rest, const Positions& pose, const Positions& reference);

/// The strain error with E' = 0, for a reference that cannot be stretched or sheared.
double strain_error(const RestMesh& rest, const Positions& pose);

}  // namespace bendlab
