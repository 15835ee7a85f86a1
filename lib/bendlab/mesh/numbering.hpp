// Numbering of vertices: neighbours in space should be neighbours in memory.
#pragma once

#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// How far apart in the numbering the ends of an edge are, on average. `permutation`: the number of each
/// vertex; empty: as the mesh numbers them.
double mean_edge_span(const Edges& edges, const std::vector<int>& permutation = {});

/// #V: the number of each vertex by the reverse Cuthill-McKee order (Boost.Graph), which walks the mesh ring
/// by ring. Empty where the mesh's own numbering is nearly as good (less than twice the mean edge span):
/// grids and other generated meshes keep theirs.
std::vector<int> local_numbering(const RestMesh& rest);

}  // namespace bendlab
