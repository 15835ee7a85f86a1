// Where a surface passes through itself.
#pragma once

#include <array>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Pairs of triangles that intersect, found by CGAL's exact predicates (Polygon Mesh Processing,
/// self_intersections). Shared vertices and edges are not intersections. A pair has the smaller index first;
/// pairs are sorted. A triangle with collinear points forms a pair with itself. Throws std::invalid_argument
/// if a position is not finite, or if the triangles are not an oriented manifold.
std::vector<std::array<int, 2>> self_intersections(const Positions& positions, const Triangles& triangles);

}  // namespace bendlab
