// The order in which constraints are projected. Constraints of a group are projected at the same time, one in
// each SIMD lane (batches.hpp).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bendlab/constraints/batches.hpp"

namespace bendlab {

/// Greedy first-fit colouring in list order. No two constraints of a colour share a vertex, so the result
/// does not depend on the number of lanes and threads. Within a colour, constraints keep their list order, so
/// neighbours in the list are neighbours in memory. Every colour is padded to a multiple of max_lanes.
/// `vertices`: #C by arity.
BatchOrder colour_order(std::span<const int> vertices, std::size_t arity, int vertex_count);
template <std::size_t arity>
BatchOrder colour_order(const std::vector<std::array<int, arity>>& vertices, int vertex_count) {
  return colour_order({vertices.empty() ? nullptr : vertices.front().data(), arity * vertices.size()}, arity,
                      vertex_count);
}

/// Pairs grouped into stars: one lane projects up to four pairs with the same first vertex, one after
/// another, so that a kernel keeps this vertex in registers. Stars are coloured first-fit, so that no two
/// stars of a colour share a vertex. Within a colour, stars are sorted by length. The last pairs of every
/// vertex are projected first, because models list the partners of a vertex from near to far, and the near
/// partners, which limit the strain, should be projected last.
BatchOrder star_order(const PairList& pairs, int vertex_count);

/// The order of the list, without colours, for project_by_oracle().
BatchOrder list_order(std::size_t constraint_count);

}  // namespace bendlab
