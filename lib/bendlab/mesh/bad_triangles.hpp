// What is done about a mesh that diagnose() finds wrong: refuse it, simulate it as it is, or mend it.
//
//   problem                     regularise            membrane_off             repair
//   --------------------------  --------------------  -----------------------  --------------------------------
//   vertex not finite, index    the triangle is left out (it has no place, or no three corners to have one)
//   out of range, repeated
//   duplicate triangle          the first is kept
//   isolated vertex             left out
//   zero area                   a rest height that    no strain constraint;    short edges become one vertex, a
//                               can be simulated      as regularise where a    vertex on an edge splits the
//                                                     vertex would have none   triangles beyond it
//   edge of > 2 triangles       kept, no bending across it                     cut: the vertices are doubled
//   bow tie                     kept: one shared vertex                        cut
//   mixed orientation           kept: neither strain nor bending looks at it   turned alike, cut where that is
//                                                                              impossible (a Möbius band)
//   equal points                kept: pieces that happen to touch              one vertex
//
// A mesh without triangles, and one all of whose triangles are left out, is refused by every policy.
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
  std::vector<std::string> notes;  ///< what was done to how many, a line each; empty: nothing
  bool renumbered = false;         ///< vertices have other indices than in the soup
};

/// The soup as a mesh that can be simulated. Throws std::invalid_argument with every problem and its first
/// offenders where the policy refuses it.
AcceptedMesh accept(const PolygonSoup& soup, BadTriangles policy);

/// #T: triangles with zero area as diagnose() has it (see zero_area_thickness). None in a mesh that was
/// accepted by `refuse` or `repair`.
std::vector<char> triangles_without_area(const TriangleMesh& mesh);

/// The height that a degenerate triangle's rest shape is given: 1/1000 of its longest edge, at least 10⁻⁵ of
/// the mesh's size. Large against a float's rounding of positions (3·10⁻⁸ of the size: 0.3 % of this height),
/// small against the triangles around, which it disturbs by no more than itself.
inline constexpr double regular_height_of_edge = 1e-3, regular_height_of_size = 1e-5;

/// The soup with one vertex per place, no zero areas, manifold and oriented alike (see the table above).
/// Triangles keep their texture coordinates. Indices have to be in range and points finite.
PolygonSoup repaired(const PolygonSoup& soup);

}  // namespace bendlab
