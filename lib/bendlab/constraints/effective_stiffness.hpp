// Which share of the stated stiffness a solver reaches, computed from its multipliers.
//
// If XPBD has not converged, the cloth is softer than the compliances state. In a substep h a constraint
// exerts the force λ/h² ∇C; the compliance states the force -C/α ∇C. With α̃ = α/h², two ratios of work are:
//
//   stiffness   = Σ -λ C / Σ C²/α̃     exerted work per stated energy; too small if C is not smooth
//   flexibility = Σ α̃ λ² / Σ -λ C     the share at equal forces; too large if λ is not smooth
//
// For a single constraint both ratios are the share λ α̃ / -C. In a sheet the two ratios differ, because an
// iteration leaves too much C in the constraints that it projects first. By Cauchy-Schwarz `stiffness` is
// smaller than `flexibility`. The share that the droop of a strip shows lies between the two ratios. The
// estimate is a weighted geometric mean of the two ratios:
//
//   share = stiffness^(1/3) flexibility^(2/3).
//
// The weights are measured, not derived. The error of the estimate was at most 15 % for strips of hinges on
// the equilateral lattice at shares from 0.01 to 1, and 21 % for hanging membranes (40 % at a share of 0.09
// if constraints are projected in list order).
//
// A spring between two vertices shortens if the cloth bends, but its length r also changes with the
// membrane's strain ε along the spring (the mean of the strains at both ends). So the bending part B is the
// change of r minus the change that ε causes. r0 is the spring's length in the rest shape, L its rest length:
//
//   B = r - r0 (1 + ε),   share = Σ -λ B / Σ (r0 - L + B) B/α̃
//
// For strips of springs the error was at most 19 % at shares from 0.01 to 1. At smaller shares the measured
// share was up to twice the estimate. The sums leave out springs with a pinned end, because at a clamp the
// strain along the spring is not the mean of the strains at both ends.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "bendlab/constraints/state.hpp"

namespace bendlab {

/// Sums over the constraints of one kind and over states, in J times h².
struct AppliedWork {
  double applied = 0;   ///< Σ -λ B
  double stated = 0;    ///< Σ -λ B with the λ that the compliances state; Σ C²/α̃ if B = C
  double spent = 0;     ///< Σ α̃ λ²; 0 for springs
  double measured = 0;  ///< Σ B²/α̃
  double rounding = 0;  ///< Σ b²/α̃ with b, the rounding of B by positions

  AppliedWork& operator+=(const AppliedWork& other);
};

struct EffectiveStiffness {
  AppliedWork membrane, hinges, springs;

  EffectiveStiffness& operator+=(const EffectiveStiffness& other);

  /// The share of the stated stiffness that the cloth has. Empty if no stiffness is stated (k, or a
  /// compliance of 0) or if the cloth is hardly bent or strained: Σ B²/α̃ has to be 100 times the sum from
  /// rounding alone, so that rounding changes the share by less than about 1 %.
  std::optional<double> bending_share() const;
  std::optional<double> membrane_share() const;
};

/// A state in the order of the solver's point arrays, into which the batches' offsets point.
struct PermutedState {
  std::span<const Eigen::Vector3d> positions;  ///< m, relative to any origin
  std::span<const Eigen::Vector3d> rest;  ///< m, relative to any origin; empty: the sums leave out springs
  std::span<const char> is_pinned;
  double substep = 0;   ///< h, s
  double rounding = 0;  ///< m, of a position that the solver keeps
};

/// Takes the state at the end of a substep, and the multipliers of the same substep in `constraints`.
template <class Real>
EffectiveStiffness effective_stiffness(const Constraints<Real>& constraints, const PermutedState& state);

}  // namespace bendlab
