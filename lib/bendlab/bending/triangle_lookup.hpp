// Finds the triangle with three given vertices, and the mean over the triangles of an element.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "bendlab/constraints/kinds.hpp"
#include "bendlab/mesh/rest_mesh.hpp"

namespace bendlab {

class TriangleLookup {
 public:
  TriangleLookup() = default;
  explicit TriangleLookup(const RestMesh& rest) {
    for (int t = 0; t < rest.triangle_count(); ++t) {
      const auto corner = rest.triangles().row(t);
      triangle_.emplace(ascending(corner(0), corner(1), corner(2)), t);
    }
  }

  /// Its index, or -1.
  int operator()(int a, int b, int c) const {
    const auto found = triangle_.find(ascending(a, b, c));
    return found == triangle_.end() ? -1 : found->second;
  }

 private:
  static std::array<int, 3> ascending(int a, int b, int c) {
    std::array<int, 3> vertices = {a, b, c};
    std::ranges::sort(vertices);
    return vertices;
  }

  std::map<std::array<int, 3>, int> triangle_;  // by ascending vertices
};

/// Makes values of elements and vertices from values of triangles (#T, or empty: all 1).
class OverElements {
 public:
  OverElements(const RestMesh& rest, std::span<const double> of_triangle);

  bool all_one() const { return of_triangle_.empty(); }

  /// Of a hinge: the mean of both triangles. Of a triangle that bends: its value. Of a ring around a vertex:
  /// the mean over the vertex's triangles by area.
  template <class Kind>
  double operator()(const ElementList<Kind>& list, std::size_t c) const {
    if (all_one()) return 1;
    const auto& v = list.vertices[c];
    if constexpr (std::is_same_v<Kind, FoldBend> || std::is_same_v<Kind, MidEdgeBend>)
      return of(find_(v[3], v[4], v[5]));
    else if constexpr (std::is_same_v<Kind, LaplacianBend>)
      return of_vertex_[static_cast<std::size_t>(v[LaplacianBend::arity - 1])];
    else if constexpr (Kind::arity == 4)
      return 0.5 * (of(find_(v[0], v[1], v[2])) + of(find_(v[0], v[1], v[3])));
    else
      return 0.5 * (of_vertex_[static_cast<std::size_t>(v[0])] + of_vertex_[static_cast<std::size_t>(v[1])]);
  }
  /// Of an own element whose first corners are those of a triangle.
  double of_corners(std::span<const int> corners) const {
    return all_one() ? 1 : of(find_(corners[0], corners[1], corners[2]));
  }

 private:
  double of(int triangle) const {
    return triangle < 0 ? 1 : of_triangle_[static_cast<std::size_t>(triangle)];
  }

  std::span<const double> of_triangle_;
  TriangleLookup find_;
  std::vector<double> of_vertex_;
};

inline OverElements::OverElements(const RestMesh& rest, std::span<const double> of_triangle)
    : of_triangle_(of_triangle) {
  if (all_one()) return;
  find_ = TriangleLookup(rest);
  std::vector<double> area(static_cast<std::size_t>(rest.vertex_count()), 0);
  of_vertex_.assign(area.size(), 0);
  for (int t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c) {
      const auto v = static_cast<std::size_t>(rest.triangles()(t, c)), at = static_cast<std::size_t>(t);
      area[v] += rest.areas()[at], of_vertex_[v] += rest.areas()[at] * of_triangle[at];
    }
  for (std::size_t v = 0; v < area.size(); ++v) of_vertex_[v] = area[v] > 0 ? of_vertex_[v] / area[v] : 1;
}

}  // namespace bendlab
