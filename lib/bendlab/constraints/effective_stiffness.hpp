// How much of the stated stiffness a solver realises, from its multipliers.
//
// XPBD that has not converged is softer than its compliances say. At the end of a substep h the force that a
// constraint really exerted is λ/h² ∇C; the force that its compliance states is -C/α ∇C. With α̃ = α/h² there
// are two ratios of work:
//
//   stiffness   = Σ -λ C / Σ C²/α̃     the share of the stated energy; too small if C is rough
//   flexibility = Σ α̃ λ² / Σ -λ C     the share at equal force; too large if λ is rough
//
// For a single constraint both ratios are the share λ α̃ / -C. In a sheet they differ, because an iteration
// leaves too much C in the constraints that it projects first. By Cauchy-Schwarz the first ratio is the
// smaller one. The share that a strip's droop shows lies between both ratios. The estimate is their weighted
// geometric mean
//
//   share = stiffness^(1/3) flexibility^(2/3).
//
// The weights are measured, not derived. With these weights the error was at most 15 % for strips of hinges
// on the equilateral lattice at shares from 0.01 to 1, and 21 % for hanging membranes (in list order 40 % at
// a share of 0.09).
//
// A spring between vertices measures bending by its shortening, and shortens less if the membrane gives way.
// So its bending part B is the change of its length r beyond the change by the membrane's strain ε along the
// spring (the mean of both ends). r0 is the spring's length in the rest shape, L its rest length:
//
//   B = r - r0 (1 + ε),   share = Σ -λ B / Σ (r0 - L + B) B/α̃
//
// For strips of springs the error was at most 19 % at shares from 0.01 to 1; at smaller shares the strips had
// up to twice the estimate. Springs with a pinned end are left out, because at a clamp the strain is not the
// mean of the strains at both ends.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "bendlab/constraints/state.hpp"

namespace bendlab {

/// Sums over constraints of one kind and over states; J times h².
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

  /// The share of the stated stiffness that the cloth has. Nothing if no stiffness is stated (k, or a
  /// compliance of 0) or if the cloth is hardly bent or strained: Σ B²/α̃ has to be 100 times that of
  /// rounding alone, so that rounding changes the share by less than about 1 %.
  std::optional<double> bending_share() const;
  std::optional<double> membrane_share() const;
};

/// A state in the order of the solver's point arrays, into which the batches' offsets point.
struct PermutedState {
  std::span<const Eigen::Vector3d> positions;  ///< m, relative to any origin
  std::span<const Eigen::Vector3d> rest;       ///< m, likewise; empty: springs do not count
  std::span<const char> is_pinned;
  double substep = 0;   ///< h, s
  double rounding = 0;  ///< m, of a position that the solver keeps
};

/// From the state at the end of a substep and the multipliers of that substep.
template <class Real>
EffectiveStiffness effective_stiffness(const Constraints<Real>& constraints, const PermutedState& state);

}  // namespace bendlab
