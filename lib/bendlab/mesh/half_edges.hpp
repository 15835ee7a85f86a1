// The sides of triangles, sorted by edge.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// A side of a triangle, from one corner to the next.
template <class Index>
struct HalfEdge {
  Index low, high;  ///< the vertices of its edge, low <= high
  Index side;       ///< 3 · triangle + the corner where it begins

  Index triangle() const { return side / 3; }
  Index corner() const { return side % 3; }
  auto operator<=>(const HalfEdge&) const = default;
};

/// All sides of `triangle_count` triangles, sorted by edge and then by triangle. vertex(triangle, corner)
/// gives a vertex's index.
template <class Index, class Vertex>
std::vector<HalfEdge<Index>> half_edges(Index triangle_count, const Vertex& vertex) {
  const auto for_each_side = [&](const auto& action) {
    for (Index t = 0; t < triangle_count; ++t)
      for (Index c = 0; c < 3; ++c) {
        const Index from = vertex(t, c), to = vertex(t, c == 2 ? 0 : c + 1);
        action(HalfEdge<Index>{std::min(from, to), std::max(from, to), 3 * t + c});
      }
  };
  // Collects the sides with the same lower vertex in a bucket, and sorts each bucket. Buckets take 0.5 to 0.9
  // of the time for sorting all sides at once (2 thousand to 2 million triangles).
  std::vector<std::size_t> place;  // where the next side of each bucket goes
  for_each_side([&](const HalfEdge<Index>& side) {
    const auto next = static_cast<std::size_t>(side.low) + 1;
    if (place.size() <= next) place.resize(next + 1);
    ++place[next];
  });
  std::partial_sum(place.begin(), place.end(), place.begin());
  std::vector<HalfEdge<Index>> sides(3 * static_cast<std::size_t>(triangle_count));
  for_each_side(
      [&](const HalfEdge<Index>& side) { sides[place[static_cast<std::size_t>(side.low)]++] = side; });
  auto begin = sides.begin();
  for (const std::size_t end : place) {
    const auto last = sides.begin() + static_cast<std::ptrdiff_t>(end);
    std::sort(begin, last);
    begin = last;
  }
  return sides;
}

inline std::vector<HalfEdge<int>> half_edges(const Triangles& triangles) {
  return half_edges(static_cast<int>(triangles.rows()), [&](int t, int c) { return triangles(t, c); });
}

/// Calls `action` for each edge, with a std::span of the sides on that edge.
template <class Index, class Action>
void for_each_edge(const std::vector<HalfEdge<Index>>& sides, const Action& action) {
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    const HalfEdge<Index>& edge = sides[first];
    while (last < sides.size() && sides[last].low == edge.low && sides[last].high == edge.high) ++last;
    action(std::span(sides).subspan(first, last - first));
  }
}

}  // namespace bendlab
