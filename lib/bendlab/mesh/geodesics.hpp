// Distances along the rest surface.
#pragma once

#include <span>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

struct GeodesicDistances {
  std::vector<double> distance;  ///< #V, m, to the nearest source; infinite where none can be reached
  std::vector<int> source;       ///< #V, that source; -1 where none can be reached
};

/// Lengths of the shortest ways over the triangles of any mesh: from two corners of a triangle to the third
/// by unfolding the plane of the way so far (Novotni & Klein 2002). Exact where the straight way meets no
/// hole and no inner corner on a flat or developable piece; else too long, first order in the edge length on
/// curved surfaces, by a few per cent behind a corner, but never longer than the shortest way along edges.
GeodesicDistances geodesic_distances(const RestMesh& rest, std::span<const int> sources);

}  // namespace bendlab
