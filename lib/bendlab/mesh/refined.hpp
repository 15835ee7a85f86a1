// Makes a mesh finer or less regular, to study how results depend on the mesh.
#pragma once

#include <cstdint>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Cuts each triangle into four at the middles of its edges, `times` times. Vertices keep their numbers and
/// positions; the middles are numbered after them. Texture coordinates of a middle are means of the edge's
/// ends. Throws std::invalid_argument if the mesh would have more than most_refined_triangles.
TriangleMesh refined(const TriangleMesh& mesh, int times);

/// The number of triangles of a grid of 4096 × 4096 cells.
inline constexpr std::int64_t most_refined_triangles = 2LL * 4096 * 4096;

/// The largest `times` that refined() allows for a mesh of this many triangles.
int most_refinements(std::int64_t triangles);

/// Moves each interior vertex at random within the surface, by at most `share` of the smallest height of the
/// adjacent triangles. If `share` is below 0.5, no triangle of a flat mesh is inverted. Vertices on the
/// border stay. Equal seeds give equal meshes on every platform. Throws std::invalid_argument for a mesh with
/// texture coordinates, which would no longer fit the moved vertices.
TriangleMesh jittered(const TriangleMesh& mesh, double share, std::uint64_t seed);

}  // namespace bendlab
