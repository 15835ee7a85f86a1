// How far apart a vertex and a triangle or two edges are, and whether they come nearer while their vertices
// go straight from one place to another.
#pragma once

#include <array>
#include <optional>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Four vertices: one and the triangle 1, 2, 3, or the edges 0, 1 and 2, 3.
enum class Pairing { vertex_triangle, edge_edge };
using Corners = std::array<Vector3, 4>;

/// From the second element's closest point to the first's: vector = Σ weight_i x_i. The weights of each
/// element are within [0, 1] of its sign (first +, second -) and add up to ±1.
struct Gap {
  std::array<double, 4> weight;
  Vector3 vector;
};

/// The shortest gap (Ericson, Real-Time Collision Detection, §5.1.5 and §5.1.9). Elements may be degenerate.
Gap shortest_gap(Pairing pairing, const Corners& x);

/// How far the first element's vertices lie beyond the second's along a unit `normal`, at least. If the
/// normal is that of the gap at the start, and all four go straight from there to x, the gap is never shorter
/// than the less of what it was and this: each difference along the normal changes evenly.
double separation_along(const Vector3& normal, Pairing pairing, const Corners& x);

/// The gap at the first moment found at which it is not longer than `separation`, while all four go
/// straight from start to end; none where it stays longer than 0.9 of that all along. `separation` is
/// positive and below the gap at the start. By conservative advancement (Li, Kaufman and Jiang 2021,
/// Codimensional Incremental Potential Contact, §5): no cubic to solve, so nothing to lose to its rounding.
/// A pair that stays about that near over a long way counts as one that comes nearer.
std::optional<Gap> first_contact(Pairing pairing, const Corners& start, const Corners& end,
                                 double separation);

}  // namespace bendlab
