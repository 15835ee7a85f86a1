// Numbering of vertices: neighbours in space should be neighbours in memory.
#pragma once

#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// The mean difference between the numbers of an edge's ends. `permutation` holds the number of each vertex;
/// if it is empty, vertices keep their indices.
double mean_edge_span(const Edges& edges, const std::vector<int>& permutation = {});

/// #V: the number of each vertex by the reverse Cuthill-McKee order (Boost.Graph), which walks the mesh ring
/// by ring. Empty if the mesh's own numbering is nearly as good (less than twice the mean edge span): grids
/// and other generated meshes keep their numbers.
std::vector<int> local_numbering(const RestMesh& rest);

}  // namespace bendlab
