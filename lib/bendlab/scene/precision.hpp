// Which precision a scene needs: the rounding of single precision, compared with what gravity does in a
// substep.
#pragma once

#include "bendlab/solver/precision.hpp"

namespace bendlab {

struct BuiltScene;

/// In single precision a method with keeps_moves_apart stores the moves of a substep separately from the
/// positions before the substep, so that constraints lose nothing. Effects that move vertices (tethers,
/// obstacles, self-collision, moving pins, …) and other methods (kang_cho) store whole positions, which are
/// rounded, and each rounding acts as a speed.
struct RoundingSpeed {
  /// m/s, ε d / h: one rounding in single precision of a coordinate as large as the cloth
  double rounded = 0;
  double gained = 0;       ///< m/s, g h: what gravity adds to a speed in a substep; 0 without gravity
  bool matters = false;    ///< something in the scene rounds positions
  double projections = 1;  ///< per substep; each projection rounds
  bool friction = false;   ///< the scene has friction, which depends on how far obstacles push

  /// Whether single precision resolves gravity.
  bool single_suffices() const;
  /// Whether single precision resolves gravity even with whole positions.
  bool whole_suffices() const;
};

/// Of `scene` only the mesh, the effects and the solver are read.
RoundingSpeed rounding_speed(const BuiltScene& scene);

/// A method that computes forces from rounded positions (quasi_newton) sees strains that are not there.
struct RoundingStrain {
  double rounded = 0;    ///< ε d / l: one rounding of a coordinate as large as the cloth, over a mean edge
  double of_weight = 0;  ///< α ρ g d: strain of the membrane under its weight; without gravity: on earth
  bool matters = false;  ///< the method is of this kind, and the membrane's stiffness is stated

  /// Whether single precision resolves the membrane's strain.
  bool single_suffices() const;
};

/// Of `scene` only the mesh, the effects, the masses and the solver with the membrane's stiffness are read.
RoundingStrain rounding_strain(const BuiltScene& scene);

/// Whether single precision resolves gravity and, where that matters, the membrane's strain.
bool single_suffices(const BuiltScene& scene);

}  // namespace bendlab
