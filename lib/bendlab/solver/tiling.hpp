// The order in which a single thread projects a batch that is larger than the processor's cache.
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

/// Cuts the stacks of `order` into ranges, in the order in which a thread projects them. The result is bit
/// for bit that of projecting colour after colour. But all colours of one tile of vertices come before the
/// next tile, so a point is fetched from memory once per projection sweep, not once per colour. `corners[c]`:
/// the permuted vertices of constraint c; the closer the numbers of neighbours, the better. A mesh that fits
/// into one tile gives one range per colour. A backward sweep takes the ranges from the last to the first.
/// This is time skewing (Wonnacott 2000) over colours.
/// `Corners` is a vector of arrays, or a PairList.
template <class Corners>
std::vector<StackRange> tiled(const BatchOrder& order, const Corners& corners, int vertex_count,
                              int tile_vertices);

}  // namespace bendlab
