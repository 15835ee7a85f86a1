// What to do about a mesh in which diagnose() finds problems: refuse it, simulate it as it is, or repair it.
//
//   problem                    regularise            membrane_off             repair
//   -------------------------  --------------------  -----------------------  -------------------------------
//   vertex not finite, index   the triangle is left out
//   out of range, repeated
//   duplicate triangle         the first is kept
//   isolated vertex            left out
//   zero area                  gets a rest height    no strain constraint;    the ends of a short edge become
//                              that can be           like regularise if a     one vertex; a vertex on an edge
//                              simulated             vertex would then have   splits the triangles beyond
//                                                    no strain constraint
//   edge of > 2 triangles      kept, without bending across the edge          cut: the vertices are doubled
//   bow tie                    kept: one shared vertex                        cut: the vertex is doubled
//   mixed orientation          kept: strain and most models do not depend     turned to face the same side; a
//                              on it; effects and models that do (see          Möbius band is cut across
//                              uses_sides) get a warning
//   points nearer than         kept as separate vertices                      united to one vertex
//   united_within · size
//
// The size is the diagonal of the mesh's box. Every policy refuses a mesh in which no triangle is left.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/mesh/soup.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

enum class BadTriangles { refuse, regularise, membrane_off, repair };

/// Names of the policies in configs, in the order of the enumeration.
inline constexpr std::array<std::string_view, 4> bad_triangles_names = {"refuse", "regularise",
                                                                        "membrane_off", "repair"};

struct AcceptedMesh {
  TriangleMesh mesh;
  std::vector<std::string> notes;  ///< warnings: what was done about each problem, a line each
  bool renumbered = false;         ///< whether vertices have other indices than in the soup
  Positions named;                 ///< see RestMesh; empty: the positions of the mesh
};

/// End of the error text for a refused mesh: how to have the mesh accepted although it has problems.
inline constexpr std::string_view remedy_of_cloth =
    "set /mesh/bad_triangles to repair, regularise or membrane_off";

/// Turns the soup into a mesh that can be simulated. If the policy refuses the soup, throws
/// std::invalid_argument. The text lists all kinds of problems, and ends with `remedy`.
AcceptedMesh accept(const PolygonSoup& soup, BadTriangles policy, std::string_view remedy = remedy_of_cloth);

/// #T: whether diagnose() says that a triangle has zero area (see zero_area_thickness). A mesh that the
/// policy `refuse` or `repair` accepted has no triangle with zero area.
std::vector<char> triangles_without_area(const TriangleMesh& mesh);

/// The height that a degenerate triangle's rest shape gets: 1/1000 of its longest edge, at least 10⁻⁵ of the
/// mesh's size. The height is much larger than the rounding of a position in single precision (3·10⁻⁸ of the
/// size, 0.3 % of the least height), and much smaller than the neighbouring triangles.
inline constexpr double regular_height_of_edge = 1e-3, regular_height_of_size = 1e-5;

/// Repair treats two points as the same point if their distance is at most this times the mesh's size. Many
/// programs write six digits, which rounds a coordinate by up to 5·10⁻⁷ of the size. Two copies of a point
/// then differ by up to 10⁻⁶ in each coordinate, so their distance is up to 1.7·10⁻⁶.
inline constexpr double united_within = 2e-6;

struct Repaired {
  PolygonSoup soup;
  std::vector<std::string> notes;  ///< warnings about what diagnose() does not report: united vertices, cuts
};

/// Repairs the soup (see the table above); indices have to be in range and points finite. In the result, each
/// point has one vertex, no triangle has zero area, and all triangles face the same side. It is manifold.
Repaired repaired(const PolygonSoup& soup);

}  // namespace bendlab
