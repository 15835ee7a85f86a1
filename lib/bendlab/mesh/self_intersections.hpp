// Where a surface passes through itself.
#pragma once

#include <array>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Pairs of triangles that intersect outside of the vertices or the edge that they share, by CGAL's exact
/// predicates (Polygon Mesh Processing, self_intersections). Each pair is ascending, and so is the list. A
/// triangle with collinear points is paired with itself. Throws std::invalid_argument for positions that are
/// not finite and for triangles that are no oriented manifold.
std::vector<std::array<int, 2>> self_intersections(const Positions& positions, const Triangles& triangles);

}  // namespace bendlab
