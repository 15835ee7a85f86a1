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

/// The normal of a vertex that a clamp holds. It turns with a triangle whose vertices are pinned.
struct ClampedNormal {
  int director = 0;
  std::array<int, 3> triangle{};
  Vector3 in_triangle{0, 0, 0};  ///< m, in the axes of the triangle

  ClampedNormal(int of_director, const std::array<int, 3>& corners, const Positions& vertices,
                const Vector3& normal)
      : director(of_director),
        triangle(corners),
        in_triangle(axes(row(vertices, 0), row(vertices, 1), row(vertices, 2)).transpose() * normal) {}

  /// The normal if the vertices of the triangle are at a, b and c.
  Vector3 at(const Vector3& a, const Vector3& b, const Vector3& c) const {
    return axes(a, b, c) * in_triangle;
  }
  Vector3 at(const Positions& vertices) const {
    return at(row(vertices, 0), row(vertices, 1), row(vertices, 2));
  }

 private:
  Vector3 row(const Positions& vertices, std::size_t corner) const {
    return vertices.row(triangle[corner]).transpose();
  }
  /// Columns: along the first edge, across it, and normal to the triangle.
  static Eigen::Matrix3d axes(const Vector3& a, const Vector3& b, const Vector3& c);
};

struct Directors {
  Positions rest;                            ///< #D by 3, m: in the rest shape
  std::vector<std::array<int, 2>> vertices;  ///< #D: ends of its edge; at a vertex: twice this vertex
  std::vector<char> is_pinned;               ///< #D
  std::vector<ClampedNormal> clamped;        ///< pinned directors that turn with a clamp
  std::vector<char> held = {};               ///< #D, or empty: coordinates that stay, a bit each
  int coordinates = 1;                       ///< how many coordinates of a director are read

  int count() const { return static_cast<int>(vertices.size()); }
  bool is_held(int director, int coordinate) const {
    return !held.empty() && (held[static_cast<std::size_t>(director)] >> coordinate & 1) != 0;
  }

  /// The inertia of a director, as a share of the mass of a vertex. Real cloth has next to none. A director
  /// of an edge of length h then has the moment of inertia `mass_share` m h², which changes the frequency of
  /// a wave of length L by about (h / L)²; a lighter director converges more slowly in projections.
  static constexpr double mass_share = 0.1;
};

/// Positions of vertices (#V by 3), then directors (#D by 3).
Positions joined(const Positions& vertices, const Positions& directors);

/// #D by 3, m: the directors with the least energy for given positions of the vertices (#V by 3, m). Pinned
/// directors keep their values in `start`, or turn with their clamp. Newton's method starts at `start`
/// (normals at vertices start at the mean normal of their triangles). It ends when moves are as small as
/// rounding errors, or after 20 iterations.
Positions relaxed_directors(const Directors& directors, const ElementLists& elements, const OwnElements& own,
                            const Positions& vertices, const Positions& start);

}  // namespace bendlab
