// A membrane that is softer than stated where the cloth hardly stretches anyway. A softer membrane needs
// fewer iterations: the number grows as the square root of the membrane's stiffness.
//
// Under a load F a membrane of stiffness Y (N/m) strains by about F / (Y l) where the load spreads over the
// length l. So the stated stiffness is needed only near pins, where l is as small as a triangle:
//
//   softness    most |          .--------------
//                    |       .´
//                  1 |....´                        = max(1, most · min(1, r / graded))
//                    +---------|---------------
//                    0       graded         r, distance from the nearest pinned vertex along edges, m
//
// `most` is the softness far from pins. `graded` is the least distance with this softness, m.
#pragma once

#include <vector>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

class SoftMembrane {
 public:
  explicit SoftMembrane(const SimulationInput& input);

  /// The compliance of each triangle divided by the stated compliance, at least 1. `error`: how far the
  /// softer membrane may move the cloth at rest, in sizes. `force`: the sum of the loads, N.
  std::vector<double> softness(double error, double force) const;

 private:
  double size_;                     // m
  double push_tension_;             // of springs that push, N/m
  std::vector<double> distance_;    // of each triangle from pins, m; infinite without pins
  std::vector<double> compliance_;  // of each triangle, the largest over directions and times, m/N
};

}  // namespace bendlab
