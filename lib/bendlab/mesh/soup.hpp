// A mesh as read from a file, unchecked, and the problems in it. All indices count from 0.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

struct PolygonSoup {
  std::vector<std::array<double, 3>> points;           ///< m; may be any numbers
  std::vector<std::array<std::int64_t, 3>> triangles;  ///< indices into `points`; may be out of range
  /// One per triangle corner (3t + c), or empty; texture coordinates are finite.
  std::vector<std::array<double, 2>> texture_coordinates;
  /// Triangles without texture coordinates, if other triangles of the file have them.
  std::size_t untextured_triangles = 0;
};

/// Does not use allFinite(): it would subtract infinities, which traps in the debug program.
template <class Point>
bool is_finite(const Point& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

enum class MeshProblemKind {
  empty,                     ///< no triangles
  non_finite_vertex,         ///< a coordinate is infinite or not a number
  index_out_of_range,        ///< a triangle names a vertex that does not exist
  repeated_vertex,           ///< a triangle names a vertex twice
  zero_area,                 ///< thinner than zero_area_thickness of the mesh's size
  duplicate_triangle,        ///< the same three vertices as an earlier triangle
  non_manifold_edge,         ///< more than two triangles share it
  non_manifold_vertex,       ///< its triangles form several fans that touch only at the vertex ("bow tie")
  inconsistent_orientation,  ///< the two triangles of an edge run along it in the same direction
  isolated_vertex,           ///< in no triangle; harmless: to_mesh() drops it
};

struct MeshProblem {
  MeshProblemKind kind;
  std::size_t count = 0;
  std::vector<std::string> offenders;  ///< the first five: "triangle 12 (3, 4, 9)", "edge 3-4", "vertex 7"

  bool harmless() const { return kind == MeshProblemKind::isolated_vertex; }
};

/// A triangle has zero area if its smallest height is at most this times the diagonal of the mesh's box.
/// Single precision, of a file or of a run, rounds coordinates by 2⁻²⁴ = 6·10⁻⁸ of the size. Below that, the
/// vertices cannot be distinguished from collinear vertices, and Q⁻¹ is noise. The limit is relative, so that
/// units don't matter. It is a limit of the height, because Q⁻¹ divides by the height. measure_quality()
/// counts thin triangles above this limit.
inline constexpr double zero_area_thickness = 1e-7;

/// All problems, one per kind and in the order of the kinds; empty if the mesh can be simulated. Duplicates
/// and triangles with a bad index or a repeated vertex are left out of later checks.
std::vector<MeshProblem> diagnose(const PolygonSoup& soup);
std::vector<MeshProblem> diagnose(const TriangleMesh& mesh);

/// For example "2 triangles with zero area: triangle 4 (1, 2, 5), triangle 9 (7, 8, 9)"; without line break.
std::string describe(const MeshProblem& problem);

/// A mesh's points and triangles, unchecked; without texture coordinates.
PolygonSoup to_soup(const TriangleMesh& mesh);

/// The soup without its isolated vertices (the other vertices keep their order). Indices have to be in range.
TriangleMesh to_mesh(const PolygonSoup& soup);

}  // namespace bendlab
