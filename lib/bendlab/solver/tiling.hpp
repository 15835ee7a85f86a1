// One thread's way through a batch larger than its cache.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bendlab/constraints/batches.hpp"

namespace bendlab {

/// Runs [first, last) of one colour.
struct RunRange {
  std::size_t first, last;
};

/// The runs of `order` cut into ranges whose sequence gives, bit for bit, what colour after colour gives, but
/// takes all colours of one tile of vertices before it goes on to the next, so that a point is fetched from
/// memory once per sweep and not once per colour. `corners[c]` are the places of constraint c's vertices; the
/// closer neighbours are numbered, the better. Without room for two tiles: one range per colour. Backwards,
/// the ranges go from the last to the first. Known as time skewing (Wonnacott 2000), here over colours.
template <std::size_t arity>
std::vector<RunRange> tiled(const BatchOrder& order, const std::vector<std::array<int, arity>>& corners,
                            int vertex_count, int tile_vertices);

}  // namespace bendlab
