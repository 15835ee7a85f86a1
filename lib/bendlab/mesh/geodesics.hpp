// Distances along the rest surface.
#pragma once

#include <span>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

struct GeodesicDistances {
  std::vector<double> distance;  ///< #V, m, to the nearest source; infinite if no source can be reached
  std::vector<int> source;       ///< #V, that source; -1 if none can be reached
};

/// Lengths of the shortest paths over the triangles of any mesh. A path goes from two corners of a triangle
/// to the third by unfolding the triangles so far into a plane (Novotni & Klein 2002). Exact on a flat or
/// developable piece if the straight path meets no hole and no inner corner. Otherwise too long: by a few per
/// cent behind a corner, by up to two thousandths far from a row of sources, and to first order in the edge
/// length on curved surfaces. Never longer than the shortest path along edges.
GeodesicDistances geodesic_distances(const RestMesh& rest, std::span<const int> sources);

}  // namespace bendlab
