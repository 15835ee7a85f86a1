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

/// Lengths of the shortest paths along the surface of a mesh. The distance of a triangle's third corner
/// follows from the distances of the first two: the triangle and the source are drawn in one plane (Novotni &
/// Klein 2002). On flat and developable surfaces the distances are exact, unless a hole or a concave corner
/// of the outline blocks the straight path. Behind such a corner distances are too long by a few per cent;
/// where paths around both sides of a hole meet, they may also be too short, by up to 0.3 edges. They are too
/// long by up to 0.2 % far from a row of sources, and on curved surfaces by an error of first order in the
/// edge length. A distance is never longer than the shortest path along edges.
GeodesicDistances geodesic_distances(const RestMesh& rest, std::span<const int> sources);

/// Finds the vertices within a geodesic distance of a vertex, in a time that depends only on their number.
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
