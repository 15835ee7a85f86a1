#include "bendlab/mesh/polygon_list.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "bendlab/mesh/cut_polygon.hpp"

namespace bendlab {
namespace {

using Triple = std::array<std::int64_t, 3>;

double size_of(const std::vector<std::array<double, 3>>& points) {
  Eigen::AlignedBox3d box;
  for (const auto& p : points)
    if (is_finite(p)) box.extend(Vector3(p[0], p[1], p[2]));
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

// The corners of a polygon that is stored as a fan of triangles.
std::vector<std::int64_t> corners_of(std::span<const Triple> fan) {
  std::vector<std::int64_t> corners = {fan[0][0], fan[0][1]};
  for (const Triple& triangle : fan) corners.push_back(triangle[2]);
  return corners;
}

void rearrange(std::span<Triple> fan, const std::vector<std::array<std::size_t, 3>>& triangles) {
  const std::vector<std::int64_t> corners = corners_of(fan);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c) fan[t][c] = corners[triangles[t][c]];
}

}  // namespace

void PolygonList::fail(std::size_t place, std::string_view what) const {
  throw std::invalid_argument(fmt::format("{} {}: {}", place_, place, what));
}

void PolygonList::add(std::span<const std::int64_t> corners, std::size_t place) {
  if (corners.size() < 3)
    fail(place, fmt::format("a face has fewer than 3 corners: it has {}", corners.size()));
  if (corners.size() > 3) polygons_.push_back({soup_.triangles.size(), corners.size(), place});
  for (std::size_t c = 2; c < corners.size(); ++c)
    soup_.triangles.push_back({corners[0], corners[c - 1], corners[c]});
}

// Copies the polygon's corners to points_; false if a corner does not exist or is not finite.
bool PolygonList::take_points(const Polygon& polygon) {
  points_.clear();
  const auto take = [&](std::int64_t vertex) {
    if (vertex < 0 || vertex >= static_cast<std::int64_t>(soup_.points.size())) return false;
    const auto& p = soup_.points[static_cast<std::size_t>(vertex)];
    points_.emplace_back(p[0], p[1], p[2]);
    return is_finite(p);
  };
  const Triple* fan = &soup_.triangles[polygon.first_triangle];
  if (!take(fan[0][0]) || !take(fan[0][1])) return false;
  for (std::size_t t = 0; t + 2 < polygon.corners; ++t)
    if (!take(fan[t][2])) return false;
  return true;
}

void PolygonList::cut(std::span<Triple> attributes) {
  if (polygons_.empty()) return;
  const double thickness = zero_area_thickness * size_of(soup_.points);
  std::vector<std::array<std::size_t, 3>> triangles;
  for (const Polygon& polygon : polygons_) {
    if (!take_points(polygon)) continue;
    try {
      cut_polygon(points_, thickness, triangles);
    } catch (const std::invalid_argument& error) {
      fail(polygon.place, error.what());
    }
    if (triangles.empty()) continue;
    rearrange(std::span(soup_.triangles).subspan(polygon.first_triangle, triangles.size()), triangles);
    if (!attributes.empty())
      rearrange(attributes.subspan(polygon.first_triangle, triangles.size()), triangles);
  }
}

}  // namespace bendlab
