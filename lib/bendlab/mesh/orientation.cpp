#include "bendlab/mesh/orientation.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>

#include "bendlab/mesh/half_edges.hpp"

namespace bendlab {
namespace {

class Turner {
 public:
  explicit Turner(const PolygonSoup& soup)
      : soup_(soup),
        orientation_{.turned = std::vector<char>(soup.triangles.size(), 0),
                     .edges = shared_edges(soup.triangles)} {}

  Orientation run() {
    if (std::ranges::all_of(orientation_.edges, &SharedEdge::alike)) return std::move(orientation_);
    edges_of_.resize(soup_.triangles.size());
    for (std::size_t e = 0; e < orientation_.edges.size(); ++e)
      for (const std::size_t t : orientation_.edges[e].triangles) edges_of_[t].push_back(e);
    way_.assign(soup_.triangles.size(), std::numeric_limits<double>::infinity());
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t)
      if (way_[t] == std::numeric_limits<double>::infinity()) turn_part_of(t);
    for (SharedEdge& edge : orientation_.edges) {
      edge.alike = alike(edge);
      if (!edge.alike) ++orientation_.seams;
    }
    return std::move(orientation_);
  }

 private:
  bool alike(const SharedEdge& edge) const {
    return edge.alike == (orientation_.turned[edge.triangles[0]] == orientation_.turned[edge.triangles[1]]);
  }

  Vector3 point(std::int64_t vertex) const {
    return Eigen::Map<const Vector3>(soup_.points[static_cast<std::size_t>(vertex)].data());
  }
  Vector3 centre(std::size_t t) const {
    const auto& [a, b, c] = soup_.triangles[t];
    return (point(a) + point(b) + point(c)) / 3;
  }

  // Reverses triangles of a connected part, starting from `first`, so that neighbours face the same side.
  // Visits triangles by distance (Dijkstra's algorithm), along paths through triangle centres and edge
  // middles.
  void turn_part_of(std::size_t first) {
    using Reached = std::pair<double, std::size_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
    std::vector<std::size_t> part;
    way_[first] = 0;
    next.push({0.0, first});
    while (!next.empty()) {
      const auto [way, t] = next.top();
      next.pop();
      if (way > way_[t]) continue;
      part.push_back(t);
      for (const std::size_t e : edges_of_[t]) {
        const SharedEdge& edge = orientation_.edges[e];
        const std::size_t other = edge.triangles[edge.triangles[0] == t ? 1 : 0];
        const Vector3 middle = (point(edge.ends[0]) + point(edge.ends[1])) / 2;
        const double there = way + (centre(t) - middle).norm() + (centre(other) - middle).norm();
        if (!(there < way_[other])) continue;
        way_[other] = there;
        orientation_.turned[other] =
            static_cast<char>(orientation_.turned[t] != static_cast<char>(!edge.alike));
        next.push({there, other});
      }
    }
    if (seam_length(part, [](const SharedEdge& e) { return e.alike; }) <=
        seam_length(part,
                    [&](const SharedEdge& e) { return alike(e); }))  // keeps a given seam: it may be intended
      for (const std::size_t t : part) orientation_.turned[t] = 0;
    const auto turned =
        std::ranges::count_if(part, [&](std::size_t t) { return orientation_.turned[t] != 0; });
    if (2 * static_cast<std::size_t>(turned) > part.size())
      for (const std::size_t t : part) orientation_.turned[t] ^= 1;
  }

  // Twice the length of the edges of `part` whose triangles face different sides.
  template <class Alike>
  double seam_length(const std::vector<std::size_t>& part, const Alike& are_alike) const {
    double sum = 0;
    for (const std::size_t t : part)
      for (const std::size_t e : edges_of_[t])
        if (const SharedEdge& edge = orientation_.edges[e]; !are_alike(edge))
          sum += (point(edge.ends[0]) - point(edge.ends[1])).norm();
    return sum;
  }

  const PolygonSoup& soup_;
  Orientation orientation_;
  std::vector<std::vector<std::size_t>> edges_of_;  // #T
  std::vector<double> way_;                         // #T, m: path length from the first triangle of its part
};

}  // namespace

std::vector<SharedEdge> shared_edges(const std::vector<std::array<std::int64_t, 3>>& triangles) {
  using Side = HalfEdge<std::int64_t>;
  const auto vertex = [&](std::int64_t t, std::int64_t c) {
    return triangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(c)];
  };
  const auto triangle = [](const Side& side) { return static_cast<std::size_t>(side.triangle()); };
  const auto start = [&](const Side& side) { return vertex(side.triangle(), side.corner()); };
  std::vector<SharedEdge> edges;
  for_each_edge(half_edges(static_cast<std::int64_t>(triangles.size()), vertex),
                [&](std::span<const Side> sides) {
                  if (sides.size() == 2)
                    edges.push_back({{sides[0].low, sides[0].high},
                                     {triangle(sides[0]), triangle(sides[1])},
                                     start(sides[0]) != start(sides[1])});
                });
  return edges;
}

Orientation orientation_of(const PolygonSoup& soup) {
  return Turner(soup).run();
}

}  // namespace bendlab
