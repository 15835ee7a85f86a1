// How far a pose of a cloth is from a reference pose of the same points. If a rigid motion does not count as
// an error, align both poses first (alignment.hpp).
#pragma once

#include <span>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Distances of a pose's points from the same points of the reference, m.
struct ShapeError {
  double rms = 0;      ///< root mean square over the cloth: √(Σ weight |x - x'|² / Σ weight)
  double largest = 0;  ///< largest distance of a point with a positive weight
};

/// Both poses are #V by 3 in m; `weight` (#V, not negative) is each point's share of the cloth, for example
/// its lumped area.
ShapeError shape_error(const Positions& pose, const Positions& reference, std::span<const double> weight);

/// Hausdorff distance of two surfaces, which need not have the same points, m: the largest distance of a
/// vertex of either surface from the nearest triangle of the other surface. Vertices in no triangle don't
/// count. Throws std::invalid_argument if a surface has no triangle.
double hausdorff_distance(const TriangleMesh& first, const TriangleMesh& second);

/// The difference in membrane strain: the root mean square of |E - E'| (Frobenius) over the cloth's area. E
/// is the Green strain (FᵀF - 1)/2 of a triangle of the pose against the rest shape, E' is the Green strain
/// of the reference. Rest triangles without area do not count.
double strain_error(const RestMesh& rest, const Positions& pose, const Positions& reference);

/// The same with E' = 0, as for a cloth that cannot be stretched or sheared.
double strain_error(const RestMesh& rest, const Positions& pose);

}  // namespace bendlab
