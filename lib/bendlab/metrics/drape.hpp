// The drape coefficient: how far a round specimen that hangs over the edge of a round table reaches (Cusick
// 1965; ISO 9073-9): the share of what hangs over that its shadow still covers, 1 for a stiff board, 0 for
// what falls straight down.
#pragma once

#include <vector>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

struct Drape {
  double coefficient = 0;     ///< (shadow - table) / (specimen - table), areas
  int folds = 0;              ///< maxima of the reach around the table, by more than a fiftieth of its mean
  std::vector<double> reach;  ///< m, of the shadow from the table's centre, at equal angles around it
};

/// Of a cloth at `positions` (#V by 3, m) whose pinned triangles are the table and whose shadow falls along
/// `down` (unit length). The shadow's outline is taken from its centre, so nothing may hang back under the
/// table. Throws std::invalid_argument where no triangle is pinned or nothing hangs over.
Drape drape_of(const RestMesh& rest, const Pins& pins, const Positions& positions, const Vector3& down);

}  // namespace bendlab
