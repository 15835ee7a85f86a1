// A membrane that is softer than stated where that does no harm. The needed number of iterations grows as the
// square root of the membrane's stiffness, and cloth hardly stretches under its weight with either stiffness.
//
// Under a load F a membrane of stiffness Y (N/m) strains by about F / (Y l) where the load spreads over the
// length l. So it needs the stated stiffness only near pins, where l is as small as a triangle:
//
//   softness    most |          .--------------
//                    |       .´
//                  1 |....´                        = max(1, most · min(1, r / graded))
//                    +---------|---------------
//                    0       graded         r, distance from the nearest pinned vertex along edges, m
//
// `most` is the softness far from pins. `graded` is the distance at which it is reached, m.
#pragma once

#include <vector>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

class SoftMembrane {
 public:
  explicit SoftMembrane(const SimulationInput& input);

  /// The compliance of each triangle divided by the stated compliance, at least 1. `error` is how far the
  /// softer membrane may move the cloth at rest, in sizes of the cloth, under loads of `force` newtons in
  /// total.
  std::vector<double> softness(double error, double force) const;

 private:
  double size_, compliance_;      // m, m/N
  double push_tension_;           // of springs that push, N/m
  std::vector<double> distance_;  // of each triangle from pins, m; infinite without pins
};

}  // namespace bendlab
