// The pinned and held vertices that a scene states.
#pragma once

#include <string>
#include <vector>

#include "bendlab/mesh/pins.hpp"
#include "bendlab/scene/scene.hpp"

namespace bendlab {

/// Throws ConfigError for a name or an index without vertex, and for a plane of symmetry that the sheet does
/// not cross; MeshError for pins by index if the mesh was `renumbered` (mesh_notes say why). `down`: as in
/// BuiltScene.
Pins pins_of(const Scene& scene, const RestMesh& rest, const std::vector<std::string>& mesh_notes,
             bool renumbered, const Vector3& down);

}  // namespace bendlab
