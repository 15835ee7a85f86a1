// Finer and less regular meshes of the same surface, for studies of resolution on any mesh.
#pragma once

#include <cstdint>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Cuts each triangle into four at the middles of its edges, `times` times. The old vertices keep their
/// numbers and positions, and the middles follow. The texture coordinates of a middle are the mean of the
/// edge's ends. Throws std::invalid_argument if the mesh would have more than most_refined_triangles.
TriangleMesh refined(const TriangleMesh& mesh, int times);

/// As many as a grid of 4096 × 4096 cells has.
inline constexpr std::int64_t most_refined_triangles = 2LL * 4096 * 4096;

/// The largest `times` that refined() allows for a mesh of this many triangles.
int most_refinements(std::int64_t triangles);

/// Moves each interior vertex at random within its surface, by at most `share` of the smallest height of its
/// triangles. With a share below 0.5, no triangle of a flat mesh turns over. Vertices on the border stay.
/// Equal seeds give equal meshes on every platform. Throws std::invalid_argument for a mesh with texture
/// coordinates, because they would no longer fit.
TriangleMesh jittered(const TriangleMesh& mesh, double share, std::uint64_t seed);

}  // namespace bendlab
