// Pinned vertices that Python moves, step by step.
#pragma once

#include <memory>
#include <vector>

#include "bendlab/effects/effect.hpp"

namespace bendlab {

/// Where pinned vertices are at the start and at the end of a step; they move evenly between.
struct HandMotion {
  std::vector<int> vertices;
  Positions from, to;              ///< #vertices by 3, m
  double start = 0, duration = 1;  ///< s, of the step
};

/// An effect that moves pinned vertices along a HandMotion; it cannot be part of a config.
struct Hand {
  std::shared_ptr<const HandMotion> motion;
  static const EffectKind kind;
};

}  // namespace bendlab
