// The distance between a vertex and a triangle or between two edges, and their first contact in a motion.
#pragma once

#include <array>
#include <optional>

#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// Two elements with four vertices: vertex 0 and the triangle (1, 2, 3), or the edges (0, 1) and (2, 3).
enum class Pairing { vertex_triangle, edge_edge };
using Corners = std::array<Vector3, 4>;

/// The vector Σ weight_i x_i from the closest point of the second element to the closest point of the first.
/// The weights of the first element, and minus the weights of the second, are in [0, 1] and add up to 1.
struct Gap {
  std::array<double, 4> weight;
  Vector3 vector;
};

/// The shortest gap (Ericson, Real-Time Collision Detection, §5.1.5 and §5.1.9). Elements may be degenerate.
Gap shortest_gap(Pairing pairing, const Corners& x);

/// How far the lowest vertex of the first element is above the highest vertex of the second element, measured
/// along a unit `normal`. Suppose that the gap at the start points along `normal`, and that all four vertices
/// move in straight lines from the start to x. Then the gap is always at least the smaller of its start
/// length and this value, because differences along `normal` change linearly.
double separation_along(const Vector3& normal, Pairing pairing, const Corners& x);

/// Moves all four vertices straight from start to end and looks for the first moment at which the gap is at
/// most `separation`. Returns the gap at that moment, or nothing if the gap stays longer than 0.9
/// `separation`, which has to be positive and less than the gap at the start. The method is conservative
/// advancement (Li, Kaufman and Jiang 2021, Codimensional Incremental Potential Contact, §5). The method
/// avoids a cubic equation, whose solution would have rounding errors. If the gap is nearly `separation`
/// during 64 steps of the method, that counts as a contact.
std::optional<Gap> first_contact(Pairing pairing, const Corners& start, const Corners& end,
                                 double separation);

}  // namespace bendlab
