// Tensile crossover springs: the usual bending springs that the paper compares with (Fig. 2).
//
//      o              o---o---o
//     / \              \  |  /       opposite: over every interior edge, between the two triangles' far
//    o---o    or          v          vertices; straight: over every vertex, between neighbours that lie on a
//     \ /              /  |  \       line through it
//      o              o---o---o
#include <algorithm>
#include <cmath>
#include <set>

#include "bendlab/bending/models.hpp"

namespace bendlab {
namespace crossover_model {

constexpr std::array<std::string_view, 2> pair_choices = {"opposite", "straight"};

constexpr std::array fields = {
    field<&Crossover::pairs>(
        {.name = "pairs",
         .meaning =
             "what a spring joins: the two vertices opposite an interior edge, or two neighbours of a vertex "
             "on a straight line through it (two edges apart)",
         .choices = pair_choices}),
};

std::vector<std::array<int, 2>> opposite_pairs(const RestMesh& rest) {
  std::vector<std::array<int, 2>> pairs;
  for (const Hinge& hinge : rest.hinges())
    pairs.push_back(
        {std::min(hinge.opposite[0], hinge.opposite[1]), std::max(hinge.opposite[0], hinge.opposite[1])});
  return pairs;
}

// Two interior edges can have the same two opposite vertices (crossed diagonals, for example). Such a pair
// gets only one spring, the first in the list, because a second spring would only double k.
std::vector<std::array<int, 2>> without_repeats(std::vector<std::array<int, 2>> pairs) {
  std::set<std::array<int, 2>> seen;
  std::erase_if(pairs, [&](const std::array<int, 2>& pair) { return !seen.insert(pair).second; });
  return pairs;
}

// The neighbour of `vertex` that best continues the line from `from` through `vertex`, or -1 if no neighbour
// is within 30 degrees of that line.
int straight_ahead(const RestMesh& rest, int vertex, int from) {
  const double least_straight = std::cos(30 * 3.14159265358979323846 / 180);
  const Vector3 direction = (rest.position(vertex) - rest.position(from)).normalized();
  int best = -1;
  double best_cosine = least_straight;
  for (const int neighbour : rest.one_ring()[vertex]) {
    const double cosine = direction.dot((rest.position(neighbour) - rest.position(vertex)).normalized());
    if (cosine > best_cosine) best = neighbour, best_cosine = cosine;
  }
  return best;
}

std::vector<std::array<int, 2>> straight_pairs(const RestMesh& rest) {
  std::vector<std::array<int, 2>> pairs;
  for (int vertex = 0; vertex < rest.vertex_count(); ++vertex)
    for (const int neighbour : rest.one_ring()[vertex]) {
      const int far = straight_ahead(rest, vertex, neighbour);
      if (far >= 0) pairs.push_back({std::min(neighbour, far), std::max(neighbour, far)});
    }
  return pairs;
}

BendingConstraints build(const Crossover& settings, const BendingInput& input) {
  const bool opposite = settings.pairs == Crossover::Pairs::opposite;
  BendingConstraints constraints;
  constraints.distance = springs_at_rest_in(input.rest.positions());
  for (const auto& [a, b] :
       without_repeats(opposite ? opposite_pairs(input.rest) : straight_pairs(input.rest))) {
    if (input.pins.pinned(a) && input.pins.pinned(b)) continue;
    constraints.distance.vertices.push_back({a, b});
  }
  return constraints;
}

}  // namespace crossover_model

constinit const BendingKind Crossover::kind{
    .name = "crossover",
    .label = "crossover",
    .summary =
        "one spring over every interior edge, between the two opposite vertices (at most one per pair)",
    .source = "Kim, Fig. 2; Choi and Ko 2002; Bridson et al. 2003; Kang and Cho 2002",
    .limits =
        "no linear bending stiffness (moment ∝ κ³); does not distinguish the two directions of a fold; "
        "softer on finer meshes",
    .compliance = "1 / k of every spring, k in N/m",
    .settings = table_of<Crossover>(crossover_model::fields),
    .springs_only = true,
    .build = erased<crossover_model::build>,
};
}  // namespace bendlab
