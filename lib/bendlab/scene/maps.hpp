// Maps of the material: factors on a number of the scene, by place.
#pragma once

#include <filesystem>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/scene/scene.hpp"

namespace bendlab {

/// #T: the factor of each triangle; empty if the map is not given. `mesh`: as read or generated; places in a
/// map file are places in this mesh. `pointer` names the map in error texts.
/// Throws ConfigError if the map does not fit the mesh, or if a factor is not above 0; MeshFileError if the
/// file cannot be read.
std::vector<double> factors_of(const MaterialMap& map, const Mesh& mesh, const RestMesh& rest,
                               const std::filesystem::path& folder, const std::string& pointer);

}  // namespace bendlab
