// The connected parts of a mesh: no edge joins two parts.
#pragma once

#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// The vertices of each part, breadth first from the lowest vertex. Parts are sorted by their lowest vertex.
std::vector<std::vector<int>> connected_parts(const Adjacency& one_ring);

}  // namespace bendlab
