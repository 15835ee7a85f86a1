// The order in which one thread goes through a batch that is larger than its cache.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bendlab/constraints/batches.hpp"

namespace bendlab {

/// Stacks [first, last) of one colour.
struct StackRange {
  std::size_t first, last;
};

/// Cuts the stacks of `order` into ranges. Their sequence gives, bit for bit, what colour after colour gives,
/// but it takes all colours of one tile of vertices before it goes on to the next: a point is fetched from
/// memory once per projection sweep and not once per colour. `corners[c]` are the permuted vertices of
/// constraint c; the closer neighbours are numbered, the better. Without room for two tiles: one range per
/// colour. Backwards, the ranges go from the last to the first. Known as time skewing (Wonnacott 2000), here
/// over colours.
/// `Corners`: a vector of arrays, or a PairList.
template <class Corners>
std::vector<StackRange> tiled(const BatchOrder& order, const Corners& corners, int vertex_count,
                              int tile_vertices);

}  // namespace bendlab
