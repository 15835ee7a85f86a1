// What to do about a mesh in which diagnose() finds problems: refuse it, simulate it as it is, or repair it.
//
//   problem                    regularise            membrane_off             repair
//   -------------------------  --------------------  -----------------------  -------------------------------
//   vertex not finite, index   the triangle is left out (it does not have three corners in space)
//   out of range, repeated
//   duplicate triangle         the first is kept
//   isolated vertex            left out
//   zero area                  a rest height that    no strain constraint;    short edges become one vertex,
//                              can be simulated      like regularise if a     a vertex on an edge splits the
//                                                    vertex would then have   triangles beyond it
//                                                    no strain constraint
//   edge of > 2 triangles      kept, no bending across it                     cut: the vertices are doubled
//   bow tie                    kept: one shared vertex                        cut
//   mixed orientation          kept: strain and bending do not depend on it   turned to face alike, or cut if
//                                                                             impossible (a Möbius band is
//                                                                             cut across)
//   points within              kept: pieces that happen to touch              united to one vertex
//   united_within sizes
//
// A size is the diagonal of the mesh's box. Every policy refuses a mesh that has no triangles or whose
// triangles are all left out.
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
};

/// What to do so that a cloth's mesh is accepted although it has problems. Part of the text of a refusal.
inline constexpr std::string_view remedy_of_cloth =
    "set /mesh/bad_triangles to repair, regularise or membrane_off";

/// Turns the soup into a mesh that can be simulated. If the policy refuses the soup, throws
/// std::invalid_argument with every problem, its first offenders and the remedy.
AcceptedMesh accept(const PolygonSoup& soup, BadTriangles policy, std::string_view remedy = remedy_of_cloth);

/// #T: whether diagnose() says that a triangle has zero area (see zero_area_thickness). A mesh that was
/// accepted by `refuse` or `repair` has no such triangle.
std::vector<char> triangles_without_area(const TriangleMesh& mesh);

/// The height that a degenerate triangle's rest shape gets: 1/1000 of its longest edge, at least 10⁻⁵ of the
/// mesh's size. That is large against a float's rounding of positions (3·10⁻⁸ of the size: 0.3 % of this
/// height) and small against the triangles around it.
inline constexpr double regular_height_of_edge = 1e-3, regular_height_of_size = 1e-5;

/// Points of a mesh that are nearer to each other than this times the mesh's size are meant to be the same
/// point. Many programs write six digits, which rounds a coordinate by up to 5·10⁻⁷ of the size. Two copies
/// of a point then differ by up to 10⁻⁶ in each of three directions, 1.7·10⁻⁶ in all.
inline constexpr double united_within = 2e-6;

struct Repaired {
  PolygonSoup soup;
  std::vector<std::string> notes;  ///< warnings about what diagnose() does not report: united vertices, cuts
};

/// Repairs the soup (see the table above). The result has one vertex per point and no triangles of zero area;
/// it is manifold, and its triangles face the same side. Triangles keep their texture coordinates. Indices
/// have to be in range and points finite.
Repaired repaired(const PolygonSoup& soup);

}  // namespace bendlab
