// Which floating-point numbers a scene needs: what single precision can tell apart, against what gravity does
// in a substep.
#pragma once

#include "bendlab/solver/precision.hpp"

namespace bendlab {

struct Scene;

/// A method that keeps_moves_apart keeps in single precision what a substep changes apart from where the
/// cloth is, so that constraints lose nothing. Effects that move vertices (tethers, obstacles,
/// self-collision, moving pins, …) and other methods (kang_cho) know positions as one number: these they
/// round, and each rounding is a speed.
struct RoundingSpeed {
  double rounded =
      0;  ///< m/s, ε d / h: one rounding in single precision of a coordinate as large as the cloth
  double gained = 0;     ///< m/s, g h: what gravity adds to a speed in a substep; 0 without gravity
  bool matters = false;  ///< something in the scene rounds positions

  /// Whether single precision resolves gravity.
  bool single_suffices() const;
  /// Whether it does so without keeping what a substep changes apart.
  bool whole_suffices() const;
};

/// Of a scene whose mesh, effects and solver are known.
RoundingSpeed rounding_speed(const Scene& scene);

}  // namespace bendlab
