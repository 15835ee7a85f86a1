// Which triangles have to be turned over so that neighbours face the same side.
#pragma once

#include <array>
#include <vector>

#include "bendlab/mesh/soup.hpp"

namespace bendlab {

/// An edge of exactly two triangles.
struct SharedEdge {
  std::array<std::int64_t, 2> ends;
  std::array<std::size_t, 2> triangles;
  bool alike;  ///< both triangles face the same side: they run along the edge in opposite directions
};

/// All edges of exactly two triangles. The vertices of a triangle have to differ.
std::vector<SharedEdge> shared_edges(const std::vector<std::array<std::int64_t, 3>>& triangles);

/// How to turn the triangles of a surface so that neighbours face the same side.
struct Orientation {
  /// #T: 1 if the triangle has to be turned, else 0. In each part of the mesh that shared edges connect, the
  /// smaller group of triangles is turned. If both groups are equally large, the group that does not face
  /// like the first triangle is turned.
  std::vector<char> turned;
  std::vector<SharedEdge> edges;  ///< all shared edges, with `alike` as it is after the turning
  /// Number of edges whose triangles face different sides even after the turning, because the surface has
  /// only one side (a Möbius band). These edges, the seam, lie where the shortest paths from a triangle
  /// around the surface meet, which is across a band. If the seam of the given mesh is not longer, the given
  /// orientation stays.
  std::size_t seams = 0;
};

/// Points have to be finite, indices in range and the vertices of a triangle different.
Orientation orientation_of(const PolygonSoup& soup);

}  // namespace bendlab
