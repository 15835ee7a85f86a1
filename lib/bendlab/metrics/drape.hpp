// The drape coefficient (Cusick 1965; ISO 9073-9) of a round cloth that hangs over the edge of a round table:
// the area of the shadow of the overhanging part, divided by the area of that part. The coefficient is 1 for
// a stiff board, and 0 for cloth that hangs straight down.
#pragma once

#include <vector>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

struct Drape {
  double coefficient = 0;     ///< ratio of areas: (shadow - table) / (cloth - table)
  int folds = 0;              ///< maxima of the reach, at least 2 % of its mean above the next minima
  std::vector<double> reach;  ///< m, from the table's centre to the edge of the shadow, at equal angles
};

/// The drape of a cloth at `positions` (#V by 3, m). The pinned triangles are the table, and the shadow is
/// cast along `down` (unit length). Cloth that folds back under the table is not measured, because the
/// outline of the shadow is described by one distance for each direction. Throws std::invalid_argument if no
/// triangle or every triangle is pinned.
Drape drape_of(const RestMesh& rest, const Pins& pins, const Positions& positions, const Vector3& down);

}  // namespace bendlab
