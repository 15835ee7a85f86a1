// A polygon soup holds unchecked points and triangles of a mesh file. diagnose() finds problems in a soup.
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
  /// Entry 3t + c belongs to corner c of triangle t; finite. Empty if the soup has no texture.
  std::vector<std::array<double, 2>> texture_coordinates;
  /// Number of triangles without texture coordinates; 0 if no triangle of the file has any.
  std::size_t untextured_triangles = 0;
};

/// Does not use allFinite(), which subtracts infinities: with BENDLAB_TRAPS that would stop the program.
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
  non_manifold_edge,         ///< more than two triangles share the edge
  non_manifold_vertex,       ///< triangles form several fans that touch only at the vertex ("bow tie")
  inconsistent_orientation,  ///< the two triangles of an edge face different sides
  isolated_vertex,           ///< in no triangle; harmless: to_mesh() leaves such vertices out
};

struct MeshProblem {
  MeshProblemKind kind;
  std::size_t count = 0;
  std::vector<std::string> offenders;  ///< the first five: "triangle 12 (3, 4, 9)", "edge 3-4", "vertex 7"

  bool harmless() const { return kind == MeshProblemKind::isolated_vertex; }
};

/// A triangle has zero area if its smallest height is at most this times the diagonal of the mesh's box.
/// Files and runs in single precision round coordinates by 2⁻²⁴ = 6·10⁻⁸ of that diagonal. The three points
/// of a triangle that is so thin may really be collinear, so Q⁻¹ would be meaningless. The limit is relative,
/// because a mesh may be in any unit, and applies to the height, because Q⁻¹ divides by the height.
/// measure_quality() counts thin triangles above this limit.
inline constexpr double zero_area_thickness = 1e-7;

/// All problems, one per kind, in the order of MeshProblemKind; empty if the mesh can be simulated.
/// Duplicates, and triangles with a bad index or a repeated vertex, are left out of later checks.
std::vector<MeshProblem> diagnose(const PolygonSoup& soup);
std::vector<MeshProblem> diagnose(const TriangleMesh& mesh);

/// For example "2 triangles with zero area: triangle 4 (1, 2, 5), triangle 9 (7, 8, 9)"; on one line.
std::string describe(const MeshProblem& problem);

/// The points and triangles of a mesh, without texture coordinates.
PolygonSoup to_soup(const TriangleMesh& mesh);

/// The soup without its isolated vertices (the other vertices keep their order). Indices have to be in range.
TriangleMesh to_mesh(const PolygonSoup& soup);

}  // namespace bendlab
