// How far a cloth is from its rest shape, wherever it has gone and however it has turned.
#pragma once

#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// Compares poses with a rest shape after the rotation and translation that bring them nearest (Kabsch 1976; without
/// reflections: a mirrored shape stays away). Parts that no common edge joins move freely of each other and are aligned
/// each by itself; vertices in no triangle do not count.
class Alignment {
 public:
  explicit Alignment(const RestMesh& rest);

  /// Root mean square over the vertices of the distance that is left, m; NaN where a position is not finite.
  double distance(const Positions& positions) const;

 private:
  Positions rest_;
  std::vector<std::vector<int>> parts_;  // vertices
};

}  // namespace bendlab
