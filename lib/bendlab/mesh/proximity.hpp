// The distance between a vertex and a triangle or between two edges, and whether it shrinks while their
// vertices move along straight lines.
#pragma once

#include <array>
#include <optional>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// What four vertices form: vertex 0 and the triangle 1, 2, 3, or the edges 0, 1 and 2, 3.
enum class Pairing { vertex_triangle, edge_edge };
using Corners = std::array<Vector3, 4>;

/// The vector from the second element's closest point to the first's: Σ weight_i x_i. The weights of the
/// first element are in [0, 1] and add up to 1. The weights of the second element are in [-1, 0] and add up
/// to -1.
struct Gap {
  std::array<double, 4> weight;
  Vector3 vector;
};

/// The shortest gap (Ericson, Real-Time Collision Detection, §5.1.5 and §5.1.9). Elements may be degenerate.
Gap shortest_gap(Pairing pairing, const Corners& x);

/// The least distance by which the first element's vertices lie beyond the second's along a unit `normal`.
/// Suppose that the gap at the start has this direction, and that all four vertices move straight from the
/// start to x. Then the gap is never shorter than the smaller of its start length and this distance, because
/// differences along the normal change linearly.
double separation_along(const Vector3& normal, Pairing pairing, const Corners& x);

/// Moves all four vertices straight from start to end and looks for the first moment at which the gap is at
/// most `separation`. Returns the gap at that moment, or nothing if the gap stays longer than 0.9
/// `separation`. `separation` is positive and below the gap at the start. The method is conservative
/// advancement (Li, Kaufman and Jiang 2021, Codimensional Incremental Potential Contact, §5), which solves no
/// cubic equation and so avoids its rounding errors. A pair that stays at about this distance for long counts
/// as a contact.
std::optional<Gap> first_contact(Pairing pairing, const Corners& start, const Corners& end,
                                 double separation);

}  // namespace bendlab
