// Where the cloth is and how it moves at time 0.
#pragma once

#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/scene/scene.hpp"

namespace bendlab {

/// #V by 3, m: the rest shape folded or creased, stretched by `scale`, turned by `tilt`, or at random, as the
/// settings of /initial say; pinned vertices stay where folds and tilt bring them. Throws ConfigError for
/// settings that do not go together.
Positions initial_positions(const Initial& initial, const RestMesh& rest, const Pins& pins);

/// #V by 3, m/s, of a cloth that starts at `positions`; empty where it starts at rest.
Positions initial_velocities(const Initial& initial, const Positions& positions, const Vector3& centre);

}  // namespace bendlab
