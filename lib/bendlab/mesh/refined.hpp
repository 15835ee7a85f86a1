// Finer and less regular meshes of the same surface, for studies of resolution on any mesh.
#pragma once

#include <cstdint>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Each triangle cut into four at the middles of its edges, `times` times. The old vertices keep their
/// numbers and places, the middles follow; texture coordinates are the means of an edge's ends. Throws
/// std::invalid_argument if the mesh would have more than most_refined_triangles.
TriangleMesh refined(const TriangleMesh& mesh, int times);

/// As many as a grid of 4096 × 4096 cells has.
inline constexpr std::int64_t most_refined_triangles = 2LL * 4096 * 4096;

/// The largest `times` that refined() allows for a mesh of so many triangles.
int most_refinements(std::int64_t triangles);

/// Each vertex inside moved at random within its surface, by at most `share` of the smallest height of its
/// triangles; below 0.5 no triangle of a flat mesh turns over. Vertices on the border stay. Equal seeds give
/// equal meshes on every platform. Throws std::invalid_argument for texture coordinates: they would no longer
/// fit.
TriangleMesh jittered(const TriangleMesh& mesh, double share, std::uint64_t seed);

}  // namespace bendlab
