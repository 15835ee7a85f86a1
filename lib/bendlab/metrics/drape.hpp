// The drape coefficient (Cusick 1965; ISO 9073-9) of a round specimen that hangs over the edge of a round
// table: the area of the overhanging part's shadow, over the area of the overhanging part. 1 for a stiff
// board, 0 for cloth that falls straight down.
#pragma once

#include <vector>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

struct Drape {
  double coefficient = 0;     ///< (shadow - table) / (specimen - table), areas
  int folds = 0;              ///< maxima of the reach that stand out by more than a fiftieth of its mean
  std::vector<double> reach;  ///< m, from the table's centre to the edge of the shadow, at equal angles
};

/// The drape of a cloth at `positions` (#V by 3, m). Its pinned triangles are the table, and its shadow falls
/// along `down` (unit length). The outline of the shadow is found from the table's centre, so no cloth may
/// hang back under the table. Throws std::invalid_argument if no triangle is pinned or nothing hangs over.
Drape drape_of(const RestMesh& rest, const Pins& pins, const Positions& positions, const Vector3& down);

}  // namespace bendlab
