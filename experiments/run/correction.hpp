// How far a projection would move a vertex.
#pragma once

#include <string>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// The constraint that would move a vertex farthest in one projection with k = 1.
struct Correction {
  /// "strain", "distance", or an element's Kind::name; empty: no constraint moves the vertex
  std::string kind;
  double length = 0;  ///< m
};

/// The largest correction of `vertex` at `positions` (#V by 3, m); an empty Correction if `vertex` is -1.
Correction worst_correction(const SimulationInput& input, const Positions& positions, int vertex);

/// Length of the largest correction of any vertex by a bending constraint, m.
double largest_bending_correction(const SimulationInput& input, const Positions& positions);

}  // namespace bendlab
