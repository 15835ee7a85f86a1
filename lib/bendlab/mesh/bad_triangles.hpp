// What is done about a mesh in which diagnose() finds problems: refuse it, simulate it as it is, or repair
// it.
//
//   problem                    regularise            membrane_off             repair
//   -------------------------  --------------------  -----------------------  -------------------------------
//   vertex not finite, index   the triangle is left out (it does not have three corners in space)
//   out of range, repeated
//   duplicate triangle         the first is kept
//   isolated vertex            left out
//   zero area                  a rest height that    no strain constraint;    short edges become one vertex,
//                              can be simulated      as regularise if a       a vertex on an edge splits the
//                                                    vertex would have none   triangles beyond it
//   edge of > 2 triangles      kept, no bending across it                     cut: the vertices are doubled
//   bow tie                    kept: one shared vertex                        cut
//   mixed orientation          kept: strain and bending do not depend on it   turned alike, or cut if that is
//                                                                             impossible (a Möbius band,
//                                                                             across)
//   equal points, within       kept: pieces that happen to touch              one vertex
//   united_within of the size
//
// Every policy refuses a mesh without triangles, and one whose triangles are all left out.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "bendlab/mesh/soup.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

enum class BadTriangles { refuse, regularise, membrane_off, repair };

/// Their names in configs, in the order of the enumeration.
inline constexpr std::array<std::string_view, 4> bad_triangles_names = {"refuse", "regularise",
                                                                        "membrane_off", "repair"};

struct AcceptedMesh {
  TriangleMesh mesh;
  std::vector<std::string> notes;  ///< what was done, and how often: a line each; empty: nothing
  bool renumbered = false;         ///< vertices have other indices than in the soup
};

/// How a cloth's mesh can be taken although it has problems, for the text of a refusal.
inline constexpr std::string_view remedy_of_cloth =
    "by /mesh/bad_triangles: repair, regularise or membrane_off";

/// The soup as a mesh that can be simulated. If the policy refuses it, throws std::invalid_argument with
/// every problem, its first offenders, and the remedy.
AcceptedMesh accept(const PolygonSoup& soup, BadTriangles policy, std::string_view remedy = remedy_of_cloth);

/// #T: whether diagnose() says that a triangle has zero area (see zero_area_thickness). No triangle has in a
/// mesh that was accepted by `refuse` or `repair`.
std::vector<char> triangles_without_area(const TriangleMesh& mesh);

/// The height that a degenerate triangle's rest shape gets: 1/1000 of its longest edge, at least 10⁻⁵ of the
/// mesh's size. That is large against a float's rounding of positions (3·10⁻⁸ of the size: 0.3 % of this
/// height) and small against the triangles around it.
inline constexpr double regular_height_of_edge = 1e-3, regular_height_of_size = 1e-5;

/// Points of a mesh that are nearer than this times its size are meant to be one. Six digits, which many
/// programs write, round a coordinate by 5·10⁻⁷ of the size: two copies of a point then differ by up to 10⁻⁶
/// in each of three directions, 1.7·10⁻⁶ in all.
inline constexpr double united_within = 2e-6;

struct Repaired {
  PolygonSoup soup;
  std::vector<std::string> notes;  ///< of what diagnose() does not name: united vertices, cuts
};

/// The soup with one vertex per point, no zero areas, manifold and oriented alike (see the table above).
/// Triangles keep their texture coordinates. Indices have to be in range and points finite.
Repaired repaired(const PolygonSoup& soup);

}  // namespace bendlab
