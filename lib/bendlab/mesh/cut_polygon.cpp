#include "bendlab/mesh/cut_polygon.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bendlab/mesh/collinear.hpp"

namespace bendlab {
namespace {

double cross(const Vector2& a, const Vector2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Twice the area; positive if the triangle is counter-clockwise.
double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  return cross(b - a, c - a);
}

// Whether the triangle is counter-clockwise and its height above the longest side is more than `thickness`.
bool has_area(const Vector2& a, const Vector2& b, const Vector2& c, double thickness) {
  const double longest =
      std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
  return turn(a, b, c) > thickness * longest;
}

Vector3 newell_normal(std::span<const Vector3> corners) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t c = 2; c < corners.size(); ++c)
    sum += (corners[c - 1] - corners[0]).cross(corners[c] - corners[0]);
  return sum;
}

bool on_one_line(std::span<const Vector3> corners, double thickness) {
  const auto farthest =
      std::ranges::max_element(corners, {}, [&](const Vector3& p) { return (p - corners[0]).squaredNorm(); });
  return std::ranges::all_of(
      corners, [&](const Vector3& p) { return collinear_within(thickness, corners[0], *farthest, p); });
}

class EarCutter {
 public:
  using Triangle = std::array<std::size_t, 3>;

  // The polygon as seen from the tip of `normal`, in two dimensions.
  EarCutter(std::span<const Vector3> corners, const Vector3& normal, double thickness)
      : thickness_(thickness) {
    const Vector3 x = normal.unitOrthogonal(), y = normal.normalized().cross(x);
    for (const Vector3& p : corners) points_.emplace_back((p - corners[0]).dot(x), (p - corners[0]).dot(y));
  }

  // Whether a fan around the first corner cuts the polygon into triangles that are not thinner than
  // `thickness`. Around the first corner, the other corners have to be counter-clockwise within one turn.
  bool is_fan(double thickness) const {
    double angle = 0;
    for (std::size_t c = 2; c < points_.size(); ++c) {
      if (!has_area(points_[0], points_[c - 1], points_[c], thickness)) return false;
      const Vector2 a = points_[c - 1] - points_[0], b = points_[c] - points_[0];
      if (points_.size() > 4)
        angle += std::atan2(cross(a, b), a.dot(b));  // two triangles never make a whole turn
    }
    return angle < 2 * std::numbers::pi;
  }

  // Whether two edges cross by more than the thickness.
  bool crosses_itself() const {
    const std::size_t count = points_.size();
    const auto apart = [&](std::size_t edge, std::size_t other) {  // whether `other` ends on both sides
      const Vector2 &a = points_[edge], &b = points_[(edge + 1) % count];
      const double least = thickness_ * (b - a).norm(), first = turn(a, b, points_[other]),
                   second = turn(a, b, points_[(other + 1) % count]);
      return (first > least && second < -least) || (first < -least && second > least);
    };
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = a + 2; b < count; ++b)
        if (apart(a, b) && apart(b, a)) return true;
    return false;
  }

  // Cuts off ears: an ear is a triangle of three neighbouring corners that contains no other corner. The
  // search begins at the corner after the last ear. If all ears are thin, cuts off a thin ear. If there is no
  // ear, cuts off a corner on a straight edge. Returns false if there is no such corner either.
  bool run(std::vector<Triangle>& triangles) {
    for (std::size_t c = 0; c < points_.size(); ++c) left_.push_back(c);
    for (std::size_t start = 0; left_.size() > 3;) {
      std::size_t at = find(start, [&](std::size_t i) { return is_ear(i, thickness_); });
      if (at == left_.size()) at = find(start, [&](std::size_t i) { return is_ear(i, 0); });
      if (at == left_.size()) at = find(start, [&](std::size_t i) { return is_straight(i); });
      if (at == left_.size()) return false;
      triangles.push_back(triangle_at(at));
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      start = at % left_.size();
    }
    triangles.push_back({left_[0], left_[1], left_[2]});
    return has_area(point(0), point(1), point(2), 0) || is_straight(1);
  }

 private:
  const Vector2& point(std::size_t i) const { return points_[left_[i % left_.size()]]; }
  Triangle triangle_at(std::size_t i) const {
    const std::size_t count = left_.size();
    return {left_[(i + count - 1) % count], left_[i], left_[(i + 1) % count]};
  }

  // Index in left_ of the first corner from `start` on for which has(index) is true, or left_.size().
  template <class Property>
  std::size_t find(std::size_t start, const Property& has) const {
    for (std::size_t k = 0; k < left_.size(); ++k)
      if (const std::size_t i = (start + k) % left_.size(); has(i)) return i;
    return left_.size();
  }

  bool is_straight(std::size_t i) const {
    const auto [a, b, c] = triangle_at(i);
    return !has_area(points_[a], points_[b], points_[c], thickness_) &&
           !has_area(points_[c], points_[b], points_[a], thickness_);
  }

  bool is_ear(std::size_t i, double thickness) const {
    const Triangle ear = triangle_at(i);
    const Vector2 &a = points_[ear[0]], &b = points_[ear[1]], &c = points_[ear[2]];
    if (!has_area(a, b, c, thickness)) return false;
    const double ab = -thickness * (b - a).norm(), bc = -thickness * (c - b).norm(),
                 ca = -thickness * (a - c).norm();
    return std::ranges::none_of(left_, [&](std::size_t other) {
      const Vector2& p = points_[other];
      if (p == a || p == b || p == c) return false;  // a corner of the ear, or its copy on a bridge to a hole
      return turn(a, b, p) >= ab && turn(b, c, p) >= bc && turn(c, a, p) >= ca;
    });
  }

  std::vector<Vector2> points_;
  std::vector<std::size_t> left_;  // corners that are not cut off yet
  double thickness_;
};

}  // namespace

void cut_polygon(std::span<const Vector3> corners, double thickness,
                 std::vector<std::array<std::size_t, 3>>& triangles) {
  triangles.clear();
  if (corners.size() == 3) return;
  constexpr const char* crosses =
      "the face crosses itself and cannot be cut into triangles here: cut the face into triangles in the "
      "program that made the mesh";
  const Vector3 normal = newell_normal(corners);
  if (!(normal.norm() > 0)) {
    if (on_one_line(corners, thickness)) return;
    throw std::invalid_argument(crosses);
  }
  EarCutter cutter(corners, normal, thickness);
  if (cutter.is_fan(thickness) || on_one_line(corners, thickness)) return;
  if (corners.size() > most_corners_cut) {
    if (cutter.is_fan(0)) return;
    throw std::invalid_argument(fmt::format(
        "the face has {} corners, but at most {} corners are allowed: cut the face into smaller faces in the "
        "program that made the mesh",
        corners.size(), most_corners_cut));
  }
  if (cutter.crosses_itself() || !cutter.run(triangles)) throw std::invalid_argument(crosses);
}

}  // namespace bendlab
