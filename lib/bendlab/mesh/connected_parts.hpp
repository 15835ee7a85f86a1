// The connected parts of a mesh: no edge leads from a part to another part.
#pragma once

#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// The vertices of each part, breadth first from its lowest vertex. Parts are ordered by their lowest vertex.
std::vector<std::vector<int>> connected_parts(const Adjacency& one_ring);

}  // namespace bendlab
