#include "bendlab/bending/ring_springs.hpp"

#include <algorithm>
#include <cmath>

#include "bendlab/mesh/rings.hpp"

namespace bendlab {
namespace {

bool reaches(RingFill fill, int level, int ring) {
  switch (fill) {
    case RingFill::all:
      return ring <= level;
    case RingFill::beyond_edges:
      return ring >= 2 && ring <= level;
    case RingFill::last:
      return ring == level;
    case RingFill::ends:
      return ring == 1 || ring == level;
  }
  return false;
}

double edge_length(const RestMesh& rest, int a, int b) {
  return (rest.position(a) - rest.position(b)).norm();
}

// Lengths of paths from the last centre to other vertices: the shortest of the paths with the fewest edges.
class PathLengths {
 public:
  explicit PathLengths(const RestMesh& rest)
      : rest_(rest),
        length_(static_cast<std::size_t>(rest.vertex_count())),
        ring_(static_cast<std::size_t>(rest.vertex_count()), -1) {}

  // `length_` is valid where `ring_` is not -1. Rings are marked from the inside out, and unmarked by the
  // next call.
  void measure(const RingWalker& walker, int rings) {
    for (const int vertex : visited_) ring_[static_cast<std::size_t>(vertex)] = -1;
    visited_.clear();
    for (int r = 0; r <= rings; ++r)
      for (const int vertex : walker.ring(r)) {
        double shortest = r == 0 ? 0 : std::numeric_limits<double>::infinity();
        for (const int neighbour : rest_.one_ring()[vertex])
          if (ring_[static_cast<std::size_t>(neighbour)] == r - 1 && r > 0)
            shortest = std::min(shortest, length_[static_cast<std::size_t>(neighbour)] +
                                              edge_length(rest_, neighbour, vertex));
        length_[static_cast<std::size_t>(vertex)] = shortest;
        ring_[static_cast<std::size_t>(vertex)] = r;
        visited_.push_back(vertex);
      }
  }
  double operator()(int vertex) const { return length_[static_cast<std::size_t>(vertex)]; }

 private:
  const RestMesh& rest_;
  std::vector<double> length_;
  std::vector<int> ring_;
  std::vector<int> visited_;
};

double longest_edge(const RestMesh& rest) {
  double longest = 0;
  for (Eigen::Index e = 0; e < rest.edges().rows(); ++e)
    longest = std::max(longest, edge_length(rest, rest.edges()(e, 0), rest.edges()(e, 1)));
  return longest;
}

// Visits all vertices at most `reach` from the centre. The straight line to such a vertex crosses triangles,
// whose corners are at most an edge farther away than `reach`; so the vertex is found along their edges.
void walk_straight(RingWalker& walker, const RestMesh& rest, int centre, double reach, double longest_edge) {
  walker.walk(centre, rest.vertex_count(),
              [&](int v) { return edge_length(rest, centre, v) <= reach + longest_edge; });
}

int euclidean_ring(const RestMesh& rest, int a, int b) {
  constexpr double rounding = 1e-9;  // a vertex exactly r edge lengths away belongs to ring r, not r + 1
  return std::max(1,
                  static_cast<int>(std::ceil(edge_length(rest, a, b) / rest.mean_edge_length() - rounding)));
}

// The number of vertices in the rings that a vertex with this level is joined to. On a lattice, ring r has 6
// r vertices.
std::size_t vertices_in_rings(RingFill fill, std::size_t level) {
  return fill == RingFill::last   ? 6 * level
         : fill == RingFill::ends ? 6 * (level + 1)
                                  : 3 * level * (level + 1);
}

// Estimated number of springs, so that memory is reserved once. Two vertices with the same level reach each
// other.
std::size_t expected_springs(const std::vector<int>& levels, const RingRule& rule) {
  std::vector<std::size_t> with_level;
  for (const int level : levels) {
    if (static_cast<std::size_t>(level) >= with_level.size())
      with_level.resize(static_cast<std::size_t>(level) + 1, 0);
    ++with_level[static_cast<std::size_t>(level)];
  }
  std::size_t expected = 0;
  for (std::size_t level = 1; level < with_level.size(); ++level) {
    const std::size_t per_vertex = vertices_in_rings(rule.fill, level);
    const bool is_majority = 2 * with_level[level] > levels.size();
    expected += with_level[level] * (is_majority && !rule.shared_pairs_twice ? per_vertex / 2 : per_vertex);
  }
  return std::min(expected, levels.size() * (levels.size() - 1));
}

}  // namespace

DistanceConstraints ring_springs(const BendingInput& input, const std::vector<int>& levels,
                                 const RingRule& rule) {
  const RestMesh& rest = input.rest;
  const Pins& pins = input.pins;
  DistanceConstraints springs;
  if (!rule.path_rest_length) springs = springs_at_rest_in(rest.positions());
  springs.vertices.reserve(expected_springs(levels, rule));
  RingWalker walker(rest.one_ring());
  PathLengths path(rest);
  const int highest = levels.empty() ? 0 : *std::max_element(levels.begin(), levels.end());
  const double longest = rule.euclidean_rings ? longest_edge(rest) : 0;
  for (int centre = 0; centre < rest.vertex_count(); ++centre) {
    const int level = levels[static_cast<std::size_t>(centre)];
    if (level == 0) continue;
    if (rule.euclidean_rings)
      walk_straight(walker, rest, centre, highest * rest.mean_edge_length(), longest);
    else
      walker.walk(centre, level);
    if (rule.path_rest_length) path.measure(walker, walker.rings());
    for (int r = 1; r <= walker.rings(); ++r)
      for (const int vertex : walker.ring(r)) {
        const int ring = rule.euclidean_rings ? euclidean_ring(rest, centre, vertex) : r;
        if (!reaches(rule.fill, level, ring)) continue;
        const bool from_both = reaches(rule.fill, levels[static_cast<std::size_t>(vertex)], ring);
        if (from_both && !rule.shared_pairs_twice && vertex < centre) continue;
        if (!rule.keep_pinned_pairs && pins.pinned(centre) && pins.pinned(vertex)) continue;
        springs.vertices.push_back({centre, vertex});
        if (rule.path_rest_length) springs.rest_length.push_back(path(vertex));
      }
  }
  return springs;
}

double springs_per_vertex(const RingRule& rule, int level) {
  return static_cast<double>(vertices_in_rings(rule.fill, static_cast<std::size_t>(level))) /
         (rule.shared_pairs_twice ? 1 : 2);
}

RingRule ring_rule(const RingSettings& settings, RingFill fill) {
  return {.fill = fill,
          .euclidean_rings = settings.distance == RingSettings::Distance::euclidean,
          .path_rest_length = settings.rest_length == RingSettings::RestLength::path,
          .shared_pairs_twice = settings.shared_pairs == RingSettings::SharedPairs::twice,
          .keep_pinned_pairs = settings.pinned_pairs == RingSettings::PinnedPairs::keep};
}

}  // namespace bendlab
