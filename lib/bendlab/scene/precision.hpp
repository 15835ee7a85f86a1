// Which precision a scene needs: compares rounding errors with the effect of gravity in a substep.
#pragma once

#include "bendlab/solver/precision.hpp"

namespace bendlab {

struct BuiltScene;

/// In single precision, a method with keeps_moves_apart stores positions at the start of a substep and the
/// moves since then separately, so that small moves are not rounded away. But effects that move vertices
/// (tethers, obstacles, self-collision, moving pins, …) and other methods (kang_cho) store whole positions.
/// Rounding a position by an amount d changes the velocity by d / h in a substep h.
struct RoundingSpeed {
  /// m/s, ε d / h: change of a velocity by rounding a coordinate as large as the cloth's size d
  double rounded = 0;
  double gained = 0;       ///< m/s, g h: speed that gravity adds in a substep; 0 without gravity
  bool matters = false;    ///< the scene stores whole positions; false if that is harmless
  double projections = 1;  ///< per substep; every projection rounds positions
  bool friction = false;   ///< the scene has friction

  /// Whether single precision resolves gravity.
  bool single_suffices() const;
  /// Whether single precision resolves gravity even if whole positions are stored.
  bool whole_suffices() const;
};

/// Reads only the mesh, the effects and the solver of `scene`.
RoundingSpeed rounding_speed(const BuiltScene& scene);

/// Methods that compute forces from rounded positions (quasi_newton) compute strains that do not exist.
struct RoundingStrain {
  double rounded = 0;    ///< ε d / l: rounding error at the cloth's size d, divided by a mean edge l
  double of_weight = 0;  ///< α ρ g d: strain of the membrane under its weight; g is 9.81 if not set
  bool matters = false;  ///< such a method simulates a membrane with a stated stiffness

  /// Whether single precision resolves the membrane's strain.
  bool single_suffices() const;
};

/// Reads only the mesh, the effects, the masses, the solver and the membrane's stiffness of `scene`.
RoundingStrain rounding_strain(const BuiltScene& scene);

/// Whether single precision resolves gravity and, for methods like quasi_newton, the membrane's strain.
bool single_suffices(const BuiltScene& scene);

}  // namespace bendlab
