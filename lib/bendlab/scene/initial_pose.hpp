// The positions and velocities of the cloth at time 0.
#pragma once

#include <filesystem>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/scene/scene.hpp"

namespace bendlab {

/// #V by 3, m. By the settings of /initial, the pose is that of a file in `folder` or of a named surface, or
/// the rest shape is folded or creased. Then the pose is turned by `tilt` and stretched by `scale`, or free
/// vertices get random positions. Pinned vertices have the pose, turned by `tilt`. Throws MeshFileError, and
/// ConfigError if settings contradict each other or the file has other triangles than the rest mesh.
Positions initial_positions(const Initial& initial, const RestMesh& rest, const Pins& pins,
                            const std::filesystem::path& folder);

/// The velocities at the start, #V by 3, m/s, for a cloth at `positions`. Empty if the cloth starts at rest.
Positions initial_velocities(const Initial& initial, const Positions& positions, const Vector3& centre);

}  // namespace bendlab
