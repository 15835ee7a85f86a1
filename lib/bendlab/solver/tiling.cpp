#include "bendlab/solver/tiling.hpp"

#include <algorithm>
#include <limits>

namespace bendlab {
namespace {

struct Extent {
  int lowest = std::numeric_limits<int>::max(), highest = -1;
};

template <class Corners>
std::vector<Extent> extents_of_stacks(const BatchOrder& order, const Corners& corners) {
  std::vector<Extent> extents(order.stack_count());
  for (std::size_t stack = 0; stack < extents.size(); ++stack)
    for (std::size_t lane = order.stacks[stack]; lane < order.stacks[stack + 1]; ++lane)
      if (const int constraint = order.constraint(stack, lane); constraint >= 0)
        for (const int vertex : corners[static_cast<std::size_t>(constraint)]) {
          extents[stack].lowest = std::min(extents[stack].lowest, vertex);
          extents[stack].highest = std::max(extents[stack].highest, vertex);
        }
  return extents;
}

}  // namespace

template <class Corners>
std::vector<StackRange> tiled(const BatchOrder& order, const Corners& corners, int vertex_count,
                              int tile_vertices) {
  const std::vector<Extent> extents = extents_of_stacks(order, corners);
  // For each stack, the lowest vertex of this stack and of all later stacks of its colour. After the earlier
  // stacks, the colour has no more work below this vertex.
  std::vector<int> lowest_left(extents.size());
  std::vector<std::size_t> next;  // per colour, the first stack still to do
  for (std::size_t colour = 0; colour + 1 < order.colours.size(); ++colour) {
    next.push_back(order.colours[colour]);
    int lowest = std::numeric_limits<int>::max();
    for (std::size_t stack = order.colours[colour + 1]; stack-- > order.colours[colour];)
      lowest_left[stack] = lowest = std::min(lowest, extents[stack].lowest);
  }
  std::vector<StackRange> ranges;
  for (int end = std::min(tile_vertices, vertex_count);; end = std::min(end + tile_vertices, vertex_count)) {
    int settled = end;  // below this vertex all colours before the current one are done
    for (std::size_t colour = 0; colour < next.size(); ++colour) {
      const std::size_t first = next[colour];
      while (next[colour] < order.colours[colour + 1] && extents[next[colour]].highest < settled)
        ++next[colour];
      if (first < next[colour]) ranges.push_back({first, next[colour]});
      if (next[colour] < order.colours[colour + 1]) settled = std::min(settled, lowest_left[next[colour]]);
    }
    if (end == vertex_count) return ranges;
  }
}

template std::vector<StackRange> tiled(const BatchOrder&, const PairList&, int, int);
template std::vector<StackRange> tiled(const BatchOrder&, const std::vector<std::array<int, 2>>&, int, int);
template std::vector<StackRange> tiled(const BatchOrder&, const std::vector<std::array<int, 3>>&, int, int);
template std::vector<StackRange> tiled(const BatchOrder&, const std::vector<std::array<int, 4>>&, int, int);
template std::vector<StackRange> tiled(const BatchOrder&, const std::vector<std::array<int, 6>>&, int, int);
template std::vector<StackRange> tiled(const BatchOrder&, const std::vector<std::array<int, 9>>&, int, int);
template std::vector<StackRange> tiled(const BatchOrder&, const std::vector<std::array<int, 13>>&, int, int);

}  // namespace bendlab
