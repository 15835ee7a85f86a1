#include "bendlab/solver/order_from_pins.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace bendlab {
namespace {

// #V: number of edges to the nearest pinned vertex.
std::vector<int> hops_from_pins(const std::vector<char>& is_pinned, const Adjacency& one_ring) {
  std::vector<int> hops(is_pinned.size(), std::numeric_limits<int>::max()), reached;
  for (std::size_t v = 0; v < is_pinned.size(); ++v)
    if (is_pinned[v]) hops[v] = 0, reached.push_back(static_cast<int>(v));
  for (std::size_t next = 0; next < reached.size(); ++next)
    for (const int neighbour : one_ring[reached[next]]) {
      int& to = hops[static_cast<std::size_t>(neighbour)];
      if (to != std::numeric_limits<int>::max()) continue;
      to = hops[static_cast<std::size_t>(reached[next])] + 1;
      reached.push_back(neighbour);
    }
  return hops;
}

template <class Corners>
std::vector<std::size_t> nearest_first(const Corners& vertices, const std::vector<int>& hops) {
  const auto distance = [&](std::size_t c) {
    int least = std::numeric_limits<int>::max();
    for (const int v : vertices[c])
      if (const auto at = static_cast<std::size_t>(v); at < hops.size()) least = std::min(least, hops[at]);
    return least;
  };
  std::vector<int> distances(vertices.size());
  for (std::size_t c = 0; c < vertices.size(); ++c) distances[c] = distance(c);
  std::vector<std::size_t> order(vertices.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
  return order;
}

// Sorts `values` by `order`; an optional array may be empty.
template <class Values>
void reorder(Values& values, const std::vector<std::size_t>& order) {
  if (values.empty()) return;
  Values sorted;
  sorted.reserve(values.size());
  for (const std::size_t from : order) sorted.push_back(values[from]);
  values = std::move(sorted);
}

}  // namespace

void order_from_pins(SimulationInput& input, const RestMesh& rest) {
  const std::vector<int> hops = hops_from_pins(input.is_pinned, rest.one_ring());
  const auto sort = [&](auto& list, auto&... values) {
    const std::vector<std::size_t> order = nearest_first(list.vertices, hops);
    reorder(list.vertices, order);
    (reorder(values, order), ...);
  };
  sort(input.strain, input.strain.inverse_rest, input.strain.softness);
  sort(input.distance, input.distance.rest_length, input.distance.softness);
  for_each_kind(input.elements, [&](auto& list) {
    sort(list, list.rest, list.softness, list.moment.length, list.moment.yield, list.moment.hardening);
  });
}

}  // namespace bendlab
