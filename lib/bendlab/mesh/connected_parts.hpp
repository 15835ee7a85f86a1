// The parts of a mesh that no edge joins.
#pragma once

#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// The vertices of each part, breadth first from its lowest one; parts in the order of these.
std::vector<std::vector<int>> connected_parts(const Adjacency& one_ring);

}  // namespace bendlab
