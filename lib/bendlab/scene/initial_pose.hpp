// Where the cloth is and how it moves at time 0.
#pragma once

#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/scene/scene.hpp"

namespace bendlab {

/// #V by 3, m: the rest shape folded or creased, stretched by `scale`, turned by `tilt`, or random positions,
/// as the settings of /initial say. Pinned vertices stay where folds and tilt bring them. Throws ConfigError
/// for settings that contradict each other.
Positions initial_positions(const Initial& initial, const RestMesh& rest, const Pins& pins);

/// The velocities of a cloth that starts at `positions`, #V by 3, m/s; empty if the cloth starts at rest.
Positions initial_velocities(const Initial& initial, const Positions& positions, const Vector3& centre);

}  // namespace bendlab
