// The order in which constraints are projected.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bendlab/constraints/batches.hpp"

namespace bendlab {

/// Greedy first-fit colouring in list order. No two constraints of a colour share a vertex, so they may be
/// projected side by side with the same result for any lane width and number of threads. Constraints keep
/// their list order within a colour (neighbours stay neighbours in memory). Every colour is padded to
/// max_lanes. `vertices`: #C by arity.
BatchOrder colour_order(std::span<const int> vertices, std::size_t arity, int vertex_count);
template <std::size_t arity>
BatchOrder colour_order(const std::vector<std::array<int, arity>>& vertices, int vertex_count) {
  return colour_order({vertices.empty() ? nullptr : vertices.front().data(), arity * vertices.size()}, arity,
                      vertex_count);
}

/// Pairs as stars: up to four pairs with the same first vertex follow one another in one lane, so that a
/// kernel keeps that vertex in registers. Stars are coloured first-fit (no two stars of a colour share a
/// vertex), sorted by length within a colour and laid side by side. The last pairs of every vertex are
/// projected first: models list a vertex's partners from near to far, and near partners, which hold the
/// strain, should come last.
BatchOrder star_order(const PairList& pairs, int vertex_count);

/// The order of the list, one constraint after another (for project_by_oracle()).
BatchOrder list_order(std::size_t constraint_count);

}  // namespace bendlab
