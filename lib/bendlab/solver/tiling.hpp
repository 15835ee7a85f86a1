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

/// Cuts the stacks of `order` into ranges, in the order in which a thread projects the ranges. The result is
/// the same, bit for bit, as for colour after colour. But a thread projects all colours of one tile of
/// vertices before the next tile, so a point is read from memory once per projection sweep, not once per
/// colour. `corners[c]`: the permuted vertices of constraint c. Neighbours should have close numbers. If the
/// mesh fits into one tile, there is one range per colour. A backward sweep projects the ranges from the last
/// to the first. The method is time skewing (Wonnacott 2000) with colours in place of time steps.
/// `Corners` is a vector of arrays, or a PairList.
template <class Corners>
std::vector<StackRange> tiled(const BatchOrder& order, const Corners& corners, int vertex_count,
                              int tile_vertices);

}  // namespace bendlab
