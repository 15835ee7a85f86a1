// Which precision a scene needs: the rounding of single precision, compared with what gravity does in a
// substep.
#pragma once

#include "bendlab/solver/precision.hpp"

namespace bendlab {

struct BuiltScene;

/// In single precision a method with keeps_moves_apart stores what a substep changes apart from the
/// positions before it, so that constraints lose nothing. Effects that move vertices (tethers, obstacles,
/// self-collision, moving pins, …) and other methods (kang_cho) store whole positions and round them, and
/// each rounding acts as a speed.
struct RoundingSpeed {
  /// m/s, ε d / h: one rounding in single precision of a coordinate as large as the cloth
  double rounded = 0;
  double gained = 0;       ///< m/s, g h: what gravity adds to a speed in a substep; 0 without gravity
  bool matters = false;    ///< something in the scene rounds positions
  double projections = 1;  ///< of a substep; each rounds
  bool friction = false;   ///< of an obstacle, by how far it pushes

  /// Whether single precision resolves gravity.
  bool single_suffices() const;
  /// Whether it does so with whole positions, too.
  bool whole_suffices() const;
};

/// `scene` needs its mesh, effects and solver only.
RoundingSpeed rounding_speed(const BuiltScene& scene);

/// A method that finds forces from rounded positions (quasi_newton) sees strains that are not there.
struct RoundingStrain {
  double rounded = 0;    ///< ε d / l: one rounding of a coordinate as large as the cloth, over a mean edge
  double of_weight = 0;  ///< α ρ g d: what its own weight strains the membrane; on earth, without gravity
  bool matters = false;  ///< the method is such a one, and has a membrane of stated stiffness

  /// Whether single precision resolves the membrane's strain.
  bool single_suffices() const;
};

/// `scene` needs its mesh, effects, masses and solver with the membrane's stiffness only.
RoundingStrain rounding_strain(const BuiltScene& scene);

/// Whether single precision resolves gravity and, where that matters, the membrane's strain.
bool single_suffices(const BuiltScene& scene);

}  // namespace bendlab
