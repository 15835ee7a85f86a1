// Distances along the rest surface.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

struct GeodesicDistances {
  std::vector<double> distance;  ///< #V, m, to the nearest source; infinite if no source can be reached
  std::vector<int> source;       ///< #V, the nearest source; -1 if no source can be reached
};

/// Lengths of the shortest paths over the triangles of any mesh. The distances of two corners of a triangle
/// give the distance of the third corner: the triangles on the path so far are unfolded into a plane (Novotni
/// & Klein 2002). The distances are exact on a flat or developable piece if the straight path meets no hole
/// and no inner corner. Otherwise they are too long: by a few per cent behind a corner, by up to 0.2 % far
/// from a row of sources, and to first order in the edge length on curved surfaces. They are never longer
/// than the shortest path along edges.
GeodesicDistances geodesic_distances(const RestMesh& rest, std::span<const int> sources);

/// Finds the vertices around one vertex at a time, by the same distances. The time depends on the size of the
/// disc, not on the size of the mesh.
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
