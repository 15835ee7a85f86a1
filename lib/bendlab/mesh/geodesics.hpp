// Distances along the rest surface.
#pragma once

#include <memory>
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

/// The vertices around one vertex at a time, by the same distances. A disc takes time by its own size, not by
/// that of the mesh.
class GeodesicDiscs {
 public:
  explicit GeodesicDiscs(const RestMesh& rest);
  ~GeodesicDiscs();

  struct Member {
    int vertex;
    double distance;  ///< m
  };
  /// All vertices nearer to `centre` than `radius` (m), the centre first.
  std::vector<Member> around(int centre, double radius);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> front_;
};

}  // namespace bendlab
