// Directors: unknowns that a bending model adds to the positions of the vertices, such as the angle of the
// sheet's normal at an edge. Vertices and directors together are points. Constraints name director d as the
// point #V + d. A director has up to three coordinates. Coordinates are in m, so that moves of directors and
// of vertices have the same unit; the model says what a coordinate means. Directors do not move with the
// cloth, so a translation of the cloth does not change a director.
#pragma once

#include <array>
#include <vector>

#include "bendlab/constraints/kinds.hpp"
#include "bendlab/constraints/own_elements.hpp"

namespace bendlab {

struct Directors {
  Positions rest;                            ///< #D by 3, m: in the rest shape
  std::vector<std::array<int, 2>> vertices;  ///< #D: ends of its edge; at a vertex: twice this vertex
  std::vector<char> is_pinned;               ///< #D
  int coordinates = 1;                       ///< how many coordinates of a director are read

  int count() const { return static_cast<int>(vertices.size()); }

  /// The inertia of a director, as a share of the mass of a vertex. Real cloth has next to none. A director
  /// of an edge of length h then has the moment of inertia `mass_share` m h², which changes the frequency of
  /// a wave of length L by about (h / L)²; a lighter director converges more slowly in projections.
  static constexpr double mass_share = 0.1;
};

/// Positions of vertices (#V by 3), then directors (#D by 3).
Positions joined(const Positions& vertices, const Positions& directors);

/// #D by 3, m: the directors with the least energy for given positions of the vertices (#V by 3, m). Pinned
/// directors keep their values in `start`. Newton's method starts at `start` (normals at vertices start at
/// the mean normal of their triangles). It ends when moves are as small as rounding errors, or after 20
/// iterations.
Positions relaxed_directors(const Directors& directors, const ElementLists& elements, const OwnElements& own,
                            const Positions& vertices, const Positions& start);

}  // namespace bendlab
