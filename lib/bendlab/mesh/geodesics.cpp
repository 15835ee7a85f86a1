#include "bendlab/mesh/geodesics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>

namespace bendlab {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Distance of c from the source with the triangle unfolded into a plane: a at the origin, b at (base, 0), c
// above the base, and the source below it at the distances `to_a` and `to_b`. Infinite if the straight path
// misses the base: the path then leads around a or b.
double unfolded(double to_a, double to_b, double base, double a_to_c, double b_to_c) {
  const double x = (to_a * to_a - to_b * to_b + base * base) / (2 * base), depth = to_a * to_a - x * x;
  const double cx = (a_to_c * a_to_c - b_to_c * b_to_c + base * base) / (2 * base),
               height = a_to_c * a_to_c - cx * cx;
  if (!(depth >= 0 && height > 0)) return infinity;
  const double y = std::sqrt(depth), cy = std::sqrt(height), crossing = (x * cy + cx * y) / (y + cy);
  return crossing >= 0 && crossing <= base ? std::hypot(cx - x, cy + y) : infinity;
}

class Front {
 public:
  Front(const RestMesh& rest, std::span<const int> sources) : rest_(rest), triangles_(vertex_triangles()) {
    const auto count = static_cast<std::size_t>(rest.vertex_count());
    result.distance.assign(count, infinity), result.source.assign(count, -1);
    for (const int v : sources) reach(v, 0, v);
  }

  // Dijkstra's order. But a vertex that turns out to be nearer passes its distance on again: beyond an obtuse
  // corner the path may come back.
  void spread() {
    while (!front_.empty()) {
      const auto [distance, v] = front_.top();
      front_.pop();
      if (distance > distance_of(v)) continue;
      for (const int w : rest_.one_ring()[v]) reach(w, distance + apart(v, w), source_of(v));
      for (const int t : triangles_[static_cast<std::size_t>(v)]) {
        const auto corner = rest_.triangles().row(t);
        const int at = corner(0) == v ? 0 : corner(1) == v ? 1 : 2;
        const int b = corner((at + 1) % 3), c = corner((at + 2) % 3);
        through(v, b, c), through(v, c, b);
      }
    }
  }

  GeodesicDistances result;

 private:
  double& distance_of(int v) { return result.distance[static_cast<std::size_t>(v)]; }
  int& source_of(int v) { return result.source[static_cast<std::size_t>(v)]; }
  double apart(int v, int w) const { return (rest_.position(v) - rest_.position(w)).norm(); }

  void reach(int v, double distance, int source) {
    constexpr double rounding = 1e-14;  // relative: a smaller gain is not passed on
    if (!(distance < distance_of(v) * (1 - rounding) || (distance < infinity && source_of(v) < 0))) return;
    distance_of(v) = distance, source_of(v) = source;
    front_.push({distance, v});
  }

  void through(int a, int b, int c) {
    if (source_of(a) != source_of(b)) return;
    reach(c, unfolded(distance_of(a), distance_of(b), apart(a, b), apart(a, c), apart(b, c)), source_of(a));
  }

  std::vector<std::vector<int>> vertex_triangles() const {
    std::vector<std::vector<int>> triangles(static_cast<std::size_t>(rest_.vertex_count()));
    for (int t = 0; t < rest_.triangle_count(); ++t)
      for (int i = 0; i < 3; ++i) triangles[static_cast<std::size_t>(rest_.triangles()(t, i))].push_back(t);
    return triangles;
  }

  const RestMesh& rest_;
  std::vector<std::vector<int>> triangles_;
  using Reached = std::pair<double, int>;  // distance, vertex
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front_;
};

}  // namespace

GeodesicDistances geodesic_distances(const RestMesh& rest, std::span<const int> sources) {
  Front front(rest, sources);
  front.spread();
  return std::move(front.result);
}

}  // namespace bendlab
