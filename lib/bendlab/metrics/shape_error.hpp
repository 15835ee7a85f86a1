// How far a pose of a cloth is from a reference pose of the same points. Bring the reference over the pose
// first where a rigid motion is no error (alignment.hpp).
#pragma once

#include <span>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Of a pose's points from the same points of the reference, m.
struct ShapeError {
  double rms = 0;      ///< root mean square over the cloth: √(Σ weight |x - x'|² / Σ weight)
  double largest = 0;  ///< of the points with a weight
};

/// Both #V by 3 in m; `weight` #V, each point's share of the cloth (its lumped area, for example), not
/// negative.
ShapeError shape_error(const Positions& pose, const Positions& reference, std::span<const double> weight);

/// Hausdorff distance of two surfaces, which need not have the same points, m: the farthest that a vertex of
/// one is from the other's nearest triangle, both ways. Vertices in no triangle don't count. Throws
/// std::invalid_argument where one has no triangle.
double hausdorff_distance(const TriangleMesh& one, const TriangleMesh& other);

/// Root mean square over the cloth's area of |E - E'|: E the Green strain (FᵀF - 1)/2 of a triangle of the
/// pose against the rest shape, E' that of the reference, |·| Frobenius'. What the membrane does differently.
/// A rest triangle without area has no strain.
double strain_error(const RestMesh& rest, const Positions& pose, const Positions& reference);

/// The same against E' = 0: how far the pose is from a cloth that cannot be stretched or sheared.
double strain_error(const RestMesh& rest, const Positions& pose);

}  // namespace bendlab
