// Delaunay triangulation of points in the plane; CGAL is behind it.
#pragma once

#include <span>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Counter-clockwise triangles over the points' indices, each from its lowest index, sorted.
/// The points have to be finite and distinct.
Triangles delaunay_triangles(std::span<const Vector2> points);

}  // namespace bendlab
