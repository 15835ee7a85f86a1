#include "bendlab/bending/triangle_finder.hpp"

#include <algorithm>
#include <cmath>

namespace bendlab {

TriangleFinder::TriangleFinder(const Triangles& triangles, std::span<const Vector2> plane, double cell)
    : triangles_(triangles), plane_(plane), cell_(cell) {
  if (plane.empty()) return;
  low_ = plane[0];
  Vector2 high = plane[0];
  for (const Vector2& p : plane) low_ = low_.cwiseMin(p), high = high.cwiseMax(p);
  cells_ = {std::numeric_limits<int>::max(), std::numeric_limits<int>::max()};
  cells_ = cell_of(high);
  for (int& count : cells_) ++count;
  triangles_in_.resize(index(cells_[0] - 1, cells_[1] - 1) + 1);
  for (int t = 0; t < static_cast<int>(triangles.rows()); ++t) {
    Vector2 from = plane[static_cast<std::size_t>(triangles(t, 0))], to = from;
    for (int c = 1; c < 3; ++c) {
      const Vector2& p = plane[static_cast<std::size_t>(triangles(t, c))];
      from = from.cwiseMin(p), to = to.cwiseMax(p);
    }
    const auto first = cell_of(from), last = cell_of(to);
    for (int y = first[1]; y <= last[1]; ++y)
      for (int x = first[0]; x <= last[0]; ++x) triangles_in_[index(x, y)].push_back(t);
  }
}

std::array<int, 2> TriangleFinder::cell_of(const Vector2& point) const {
  const auto along = [&](Eigen::Index axis, int count) {
    return std::clamp(static_cast<int>(std::floor((point(axis) - low_(axis)) / cell_)), 0, count - 1);
  };
  return {along(0, cells_[0]), along(1, cells_[1])};
}

std::size_t TriangleFinder::index(int x, int y) const {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(cells_[0]) + static_cast<std::size_t>(x);
}

std::optional<TriangleFinder::Place> TriangleFinder::operator()(const Vector2& point) const {
  const auto cross = [](const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); };
  // How far outside a triangle a point may lie, relative to the triangle's height. The outline of a lattice
  // of equilateral triangles has notches half a height deep.
  constexpr double outside = 0.6;
  std::optional<Place> nearest;
  double deepest = -outside;
  const auto [x, y] = cell_of(point);
  for (const int t : triangles_in_[index(x, y)]) {
    Place place{.triangle = t};
    std::array<Vector2, 3> q;
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<std::size_t>(c);
      place.corner[i] = triangles_(t, c);
      q[i] = plane_[static_cast<std::size_t>(place.corner[i])];
    }
    const double area = cross(q[1] - q[0], q[2] - q[0]);
    for (std::size_t i = 0; i < 3; ++i)
      place.weight[i] = cross(q[(i + 1) % 3] - point, q[(i + 2) % 3] - point) / area;
    const double least = std::min({place.weight[0], place.weight[1], place.weight[2]});
    if (least > deepest) deepest = least, nearest = place;
  }
  if (!nearest) return nearest;
  double sum = 0;
  for (double& weight : nearest->weight) sum += weight = std::max(weight, 0.0);
  for (double& weight : nearest->weight) weight /= sum;
  return nearest;
}

}  // namespace bendlab
