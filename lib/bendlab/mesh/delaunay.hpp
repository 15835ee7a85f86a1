// Delaunay triangulation of points in the plane, by CGAL.
#pragma once

#include <span>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Counter-clockwise triangles of point indices. Each triangle starts with its lowest index; the triangles
/// are sorted. The points have to be finite and distinct.
Triangles delaunay_triangles(std::span<const Vector2> points);

}  // namespace bendlab
