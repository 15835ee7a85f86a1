// Numbers vertices so that vertices near each other in the mesh are near each other in memory.
#pragma once

#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

/// The difference between the numbers of the two ends of an edge, as a mean over all edges. `permutation`
/// holds the number of each vertex; an empty `permutation` means that vertices keep their indices.
double mean_edge_span(const Edges& edges, const std::vector<int>& permutation = {});

/// #V: the number of each vertex in the reverse Cuthill-McKee order (Boost.Graph), which visits the mesh ring
/// by ring. Empty if this order does not halve mean_edge_span(), as for generated meshes.
std::vector<int> local_numbering(const RestMesh& rest);

}  // namespace bendlab
