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
  bool alike;  ///< they face the same side: they run along the edge in opposite directions
};

/// Vertices of a triangle have to differ.
std::vector<SharedEdge> shared_edges(const std::vector<std::array<std::int64_t, 3>>& triangles);

/// A surface in space and how to turn its triangles alike.
struct Orientation {
  /// #T, 0 or 1. In each part of the mesh that shared edges connect, the smaller number is turned; of equal
  /// numbers, those that face unlike the first triangle.
  std::vector<char> turned;
  std::vector<SharedEdge> edges;  ///< all shared edges; `alike` is true of triangles that are turned as above
  /// Edges that are not alike all the same, because the surface has one side only (a Möbius band). They lie
  /// where the shortest ways from a triangle around the surface meet, which is across a band; or as they did,
  /// if that is shorter.
  std::size_t seams = 0;
};

/// Points have to be finite, indices in range and the vertices of a triangle different.
Orientation orientation_of(const PolygonSoup& soup);

}  // namespace bendlab
