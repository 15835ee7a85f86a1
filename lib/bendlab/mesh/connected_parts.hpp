// The parts of a mesh that no edge connects.
#pragma once

#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// The vertices of each part, breadth first from its lowest vertex. Parts are ordered by that vertex.
std::vector<std::vector<int>> connected_parts(const Adjacency& one_ring);

}  // namespace bendlab
