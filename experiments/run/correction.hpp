// How far a projection would move a vertex.
#pragma once

#include <string>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// The constraint that wants to move a vertex farthest in one projection at k = 1.
struct Correction {
  /// "strain", "distance", or an element's Kind::name; empty: no constraint moves the vertex
  std::string kind;
  double length = 0;  ///< m
};

/// At `positions` (#V by 3, m); `vertex` may be -1.
Correction worst_correction(const SimulationInput& input, const Positions& positions, int vertex);

/// The largest of any vertex by a constraint of bending, m.
double largest_bending_correction(const SimulationInput& input, const Positions& positions);

}  // namespace bendlab
