#include "bendlab/mesh/geodesics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>

namespace bendlab {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Distance of the corner c from the source, with the triangle unfolded into a plane. There a is at the
// origin, b at (base, 0), c above the base, and the source below, `to_a` from a and `to_b` from b. Infinite
// if the straight line from the source to c misses the base: the shortest path then goes through a or b.
double unfolded(double to_a, double to_b, double base, double a_to_c, double b_to_c) {
  if (!(base > 0)) return infinity;
  const double x = (to_a * to_a - to_b * to_b + base * base) / (2 * base), depth = to_a * to_a - x * x;
  const double cx = (a_to_c * a_to_c - b_to_c * b_to_c + base * base) / (2 * base),
               height = a_to_c * a_to_c - cx * cx;
  if (!(depth >= 0 && height > 0)) return infinity;
  const double y = std::sqrt(depth), cy = std::sqrt(height), crossing = (x * cy + cx * y) / (y + cy);
  return crossing >= 0 && crossing <= base ? std::hypot(cx - x, cy + y) : infinity;
}

// Distances from several sources at once. Each vertex stores the distances to its 8 nearest sources, because
// unfolding a triangle needs the distances of two corners to the same source. Halfway between two sources,
// two corners often have different nearest sources.
class Front {
 public:
  explicit Front(const RestMesh& rest)
      : rest_(rest), triangles_(vertex_triangles()), known_(static_cast<std::size_t>(rest.vertex_count())) {}

  // Forgets all distances, and starts from `sources`. Only paths shorter than `limit` are followed.
  void start(std::span<const int> sources, double limit) {
    for (const int v : reached_) known_[static_cast<std::size_t>(v)] = {};
    reached_.clear(), limit_ = limit;
    for (const int v : sources) reach(v, 0, v);
  }

  // Visits vertices by ascending distance, as Dijkstra's algorithm does. A vertex is visited again if a
  // shorter path is found later, which obtuse triangles make possible.
  void spread() {
    while (!front_.empty()) {
      const auto [distance, v, source] = front_.top();
      front_.pop();
      if (distance != distance_of(v, source)) continue;  // a nearer path was found, or the source was dropped
      for (const int w : rest_.one_ring()[v]) reach(w, distance + apart(v, w), source);
      for (const int t : triangles_[static_cast<std::size_t>(v)]) {
        const auto corner = rest_.triangles().row(t);
        const int at = corner(0) == v ? 0 : corner(1) == v ? 1 : 2;
        const int b = corner((at + 1) % 3), c = corner((at + 2) % 3);
        through(v, b, c, source), through(v, c, b, source);
      }
    }
  }

  struct Reached {
    double distance = infinity;
    int source = -1;
    int times = 0;  // how often a nearer path to this source was found
  };
  Reached nearest(int v) const {
    return *std::ranges::min_element(known_[static_cast<std::size_t>(v)], {}, &Reached::distance);
  }
  // The vertices that a path reached.
  const std::vector<int>& reached() const { return reached_; }

 private:
  using Known = std::array<Reached, 8>;

  double distance_of(int v, int source) const {
    const Known& known = known_[static_cast<std::size_t>(v)];
    const auto entry = std::ranges::find(known, source, &Reached::source);
    return entry == known.end() ? infinity : entry->distance;
  }

  double apart(int v, int w) const { return (rest_.position(v) - rest_.position(w)).norm(); }

  // Stores the distance of v from the source if it is new or shorter, and v has fewer than 8 nearer sources.
  void reach(int v, double distance, int source) {
    Known& known = known_[static_cast<std::size_t>(v)];
    auto entry = std::ranges::find(known, source, &Reached::source);
    if (entry == known.end()) entry = std::ranges::max_element(known, {}, &Reached::distance);
    // A path that is shorter by a smaller fraction is ignored. The fraction doubles with each improvement,
    // because around triangles without height the improvements would never end.
    constexpr double least_gain = 1e-10;
    const int times = entry->source == source ? entry->times + 1 : 0;
    if (!(distance < limit_ && distance < entry->distance * (1 - std::ldexp(least_gain, times)))) return;
    if (known.front().source < 0) reached_.push_back(v);
    *entry = {distance, source, times};
    front_.push({distance, v, source});
  }

  void through(int a, int b, int c, int source) {
    const double to_a = distance_of(a, source), to_b = distance_of(b, source);
    if (to_a < infinity && to_b < infinity)
      reach(c, unfolded(to_a, to_b, apart(a, b), apart(a, c), apart(b, c)), source);
  }

  std::vector<std::vector<int>> vertex_triangles() const {
    std::vector<std::vector<int>> triangles(static_cast<std::size_t>(rest_.vertex_count()));
    for (int t = 0; t < rest_.triangle_count(); ++t)
      for (int i = 0; i < 3; ++i) triangles[static_cast<std::size_t>(rest_.triangles()(t, i))].push_back(t);
    return triangles;
  }

  const RestMesh& rest_;
  std::vector<std::vector<int>> triangles_;
  std::vector<Known> known_;
  std::vector<int> reached_;
  double limit_ = infinity;
  using Arrival = std::tuple<double, int, int>;  // distance, vertex, source
  std::priority_queue<Arrival, std::vector<Arrival>, std::greater<>> front_;
};

}  // namespace

GeodesicDistances geodesic_distances(const RestMesh& rest, std::span<const int> sources) {
  Front front(rest);
  front.start(sources, infinity);
  front.spread();
  GeodesicDistances result;
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const Front::Reached nearest = front.nearest(v);
    result.distance.push_back(nearest.distance), result.source.push_back(nearest.source);
  }
  return result;
}

struct GeodesicDiscs::Implementation : Front {
  using Front::Front;
};

GeodesicDiscs::GeodesicDiscs(const RestMesh& rest) : front_(std::make_unique<Implementation>(rest)) {}
GeodesicDiscs::~GeodesicDiscs() = default;

std::vector<GeodesicDiscs::Member> GeodesicDiscs::around(int centre, double radius) {
  front_->start(std::array{centre}, radius);
  front_->spread();
  std::vector<Member> disc;
  for (const int v : front_->reached()) disc.push_back({v, front_->nearest(v).distance});
  return disc;
}

}  // namespace bendlab
