#include "bendlab/mesh/proximity.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bendlab {
namespace {

constexpr int most_advances = 64;
constexpr double surely_kept = 0.9;  // of the separation: a pair without contact stays farther apart

Gap gap_of(const Corners& x, const std::array<double, 4>& weight) {
  return {weight, weight[0] * x[0] + weight[1] * x[1] + weight[2] * x[2] + weight[3] * x[3]};
}

double fraction_along(const Vector3& point, const Vector3& from, const Vector3& to) {
  const Vector3 edge = to - from;
  const double squared = edge.squaredNorm();
  return squared > 0 ? std::clamp(edge.dot(point - from) / squared, 0.0, 1.0) : 0;
}

// If the projection of the vertex is outside the triangle, the nearest point is on an edge.
Gap vertex_triangle_gap(const Corners& x) {
  const Vector3 ab = x[2] - x[1], ac = x[3] - x[1], ap = x[0] - x[1];
  const Vector3 normal = ab.cross(ac);
  const double squared = normal.squaredNorm();
  if (squared > 0) {
    const double b = normal.dot(ap.cross(ac)) / squared, c = normal.dot(ab.cross(ap)) / squared;
    if (b >= 0 && c >= 0 && b + c <= 1) return gap_of(x, {1, b + c - 1, -b, -c});
  }
  Gap nearest{{}, Vector3::Constant(std::numeric_limits<double>::infinity())};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double f = fraction_along(x[0], x[1 + i], x[1 + j]);
    std::array<double, 4> weight{1, 0, 0, 0};
    weight[1 + i] = f - 1, weight[1 + j] = -f;
    const Gap gap = gap_of(x, weight);
    if (gap.vector.squaredNorm() < nearest.vector.squaredNorm()) nearest = gap;
  }
  return nearest;
}

Gap edge_edge_gap(const Corners& x) {
  const Vector3 first = x[1] - x[0], second = x[3] - x[2], apart = x[0] - x[2];
  const double a = first.squaredNorm(), e = second.squaredNorm(), b = first.dot(second);
  const double determinant = a * e - b * b;
  // For parallel edges, any point of the first edge is good, because t and then s are computed from it.
  double s =
      determinant > 0 ? std::clamp((b * second.dot(apart) - e * first.dot(apart)) / determinant, 0., 1.) : 0;
  const double t = fraction_along(x[0] + s * first, x[2], x[3]);
  s = fraction_along(x[2] + t * second, x[0], x[1]);
  return gap_of(x, {1 - s, s, t - 1, -t});
}

}  // namespace

Gap shortest_gap(Pairing pairing, const Corners& x) {
  return pairing == Pairing::vertex_triangle ? vertex_triangle_gap(x) : edge_edge_gap(x);
}

double separation_along(const Vector3& normal, Pairing pairing, const Corners& x) {
  const std::array<double, 4> at{normal.dot(x[0]), normal.dot(x[1]), normal.dot(x[2]), normal.dot(x[3])};
  return pairing == Pairing::vertex_triangle ? at[0] - std::max({at[1], at[2], at[3]})
                                             : std::min(at[0], at[1]) - std::max(at[2], at[3]);
}

// Measured along the gap, a vertex of one element and a vertex of the other are at least the gap's length
// apart. So all four vertices can move on until two such vertices are only 0.9 `separation` apart.
std::optional<Gap> first_contact(Pairing pairing, const Corners& start, const Corners& end,
                                 double separation) {
  const std::size_t second = pairing == Pairing::vertex_triangle ? 1 : 2;
  Corners x = start;
  const double least = surely_kept * separation;
  double time = 0;
  for (int advance = 0;; ++advance) {
    const Gap gap = shortest_gap(pairing, x);
    const double distance = gap.vector.norm();
    if (distance <= separation || advance == most_advances) return gap;
    const Vector3 normal = gap.vector / distance;
    double part = 1;  // of the remaining path
    for (std::size_t i = 0; i < second; ++i)
      for (std::size_t j = second; j < 4; ++j) {
        const double now = normal.dot(x[i] - x[j]), then = normal.dot(end[i] - end[j]);
        if (then < least) part = std::min(part, (now - least) / (now - then));
      }
    time += part * (1 - time);
    if (!(part < 1)) return std::nullopt;
    for (std::size_t i = 0; i < 4; ++i) x[i] = start[i] + time * (end[i] - start[i]);
  }
}

}  // namespace bendlab
