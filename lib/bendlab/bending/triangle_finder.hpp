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
  /// `plane` is #V by 2. The finder keeps references to `triangles` and `plane`. `cell` is the width of a
  /// grid cell, about an edge's length, in the unit of `plane`.
  TriangleFinder(const Triangles& triangles, std::span<const Vector2> plane, double cell);

  struct Place {
    int triangle;
    std::array<int, 3> corner;
    std::array<double, 3> weight;  ///< barycentric coordinates
  };
  /// Where the point lies. For a point just outside the sheet (in a notch of its outline) the result is the
  /// nearest point of the sheet; for a point farther outside the result is empty.
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
