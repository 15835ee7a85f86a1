// Finds the triangle of a flat sheet in which a point lies.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

class TriangleFinder {
 public:
  /// `plane` is #V by 2. Both arrays are kept by reference. `cell`: the width of a grid cell, about an edge's
  /// length, in the unit of `plane`.
  TriangleFinder(const Triangles& triangles, std::span<const Vector2> plane, double cell);

  struct Place {
    int triangle;
    std::array<int, 3> corner;
    std::array<double, 3> weight;  ///< barycentric coordinates
  };
  /// Where the point lies. A point just outside (in a notch of the outline) gets the nearest point of the
  /// sheet. Nothing for a point farther out.
  std::optional<Place> operator()(const Vector2& point) const;

 private:
  std::array<int, 2> cell_of(const Vector2& point) const;
  std::size_t index(int x, int y) const;

  const Triangles& triangles_;
  std::span<const Vector2> plane_;
  Vector2 low_ = Vector2::Zero();
  double cell_;
  std::array<int, 2> cells_{1, 1};
  std::vector<std::vector<int>> triangles_in_;  // for each cell, the triangles whose box touches it
};

}  // namespace bendlab
