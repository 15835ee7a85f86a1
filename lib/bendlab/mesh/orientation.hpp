// Which triangles have to be reversed so that neighbours face the same side.
#pragma once

#include <array>
#include <vector>

#include "bendlab/mesh/soup.hpp"

namespace bendlab {

/// An edge of exactly two triangles.
struct SharedEdge {
  std::array<std::int64_t, 2> ends;
  std::array<std::size_t, 2> triangles;
  bool alike;  ///< both triangles face the same side: their corners follow the edge in opposite directions
};

/// The edges that belong to exactly two triangles. Every triangle must have three different vertices.
std::vector<SharedEdge> shared_edges(const std::vector<std::array<std::int64_t, 3>>& triangles);

/// How to reverse triangles of a surface so that neighbours face the same side.
struct Orientation {
  /// #T: 1 if the triangle has to be reversed, 0 if not. In each connected part, the triangles that face the
  /// less frequent side are reversed. If both sides have equally many, the side of the first triangle stays.
  std::vector<char> turned;
  std::vector<SharedEdge> edges;  ///< all shared edges; `alike` holds for the reversed triangles
  /// Number of edges whose triangles still face different sides, because the surface has only one side (a
  /// Möbius band). These edges form a seam across the band, opposite the triangle from which the search
  /// starts. If the given mesh has a seam that is not longer, no triangle is reversed.
  std::size_t seams = 0;
};

/// Points have to be finite and indices in range. Every triangle must have three different vertices.
Orientation orientation_of(const PolygonSoup& soup);

}  // namespace bendlab
