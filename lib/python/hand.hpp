// Pinned vertices that Python moves, step by step.
#pragma once

#include <memory>
#include <vector>

#include "bendlab/effects/effect.hpp"

namespace bendlab {

/// Positions of pinned vertices at the start and end of a step; during the step they move evenly.
struct HandMotion {
  std::vector<int> vertices;
  Positions from, to;              ///< #vertices by 3, m
  double start = 0, duration = 1;  ///< s, of the step
};

/// An effect that moves pinned vertices by a HandMotion. A config cannot have this effect.
struct Hand {
  std::shared_ptr<const HandMotion> motion;
  static const EffectKind kind;
};

}  // namespace bendlab
