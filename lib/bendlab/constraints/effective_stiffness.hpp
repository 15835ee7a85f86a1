// What a solver made of the stiffness that it was told, read off its multipliers.
//
// XPBD that has not converged is softer than its compliances say. At the end of a substep h the force that a
// constraint really exerted is λ/h² ∇C; the one that its compliance asks for is -C/α ∇C. Two ratios of work
// follow, with α̃ = α/h²:
//
//   stiffness   = Σ -λ C / Σ C²/α̃     the share of the told energy; too small where C is rough
//   flexibility = Σ α̃ λ² / Σ -λ C     the share at equal force; too large where λ is rough
//
// For one constraint both are the share λ α̃ / -C. In a sheet, a sweep leaves too much C in the constraints
// that it projects first, so that they differ; by Cauchy-Schwarz the first is the smaller one. What a strip's
// droop shows lies between them. The estimate is their weighted geometric mean
//
//   share = stiffness^(1/3) flexibility^(2/3).
//
// The weights are measured, not derived: with them strips of hinges on the equilateral lattice were off by at
// most 15 % at shares from 0.01 to 1, hanging membranes by 21 % (in list order by 40 % at a share of 0.09).
//
// A spring between vertices measures bending by how much it shortens, and shortens less where the membrane
// gives way. Its bending part B is what the membrane's strain ε along it (the mean of that at its ends)
// leaves of the change of its length r, which is r0 in the rest shape; L is its rest length:
//
//   B = r - r0 (1 + ε),   share = Σ -λ B / Σ (r0 - L + B) B/α̃
//
// Strips of springs were off by at most 19 % at shares from 0.01 to 1, and had up to twice what was estimated
// below. Springs with a pinned end are left out: at a clamp the strain is not the mean of the ends'.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "bendlab/constraints/state.hpp"

namespace bendlab {

/// Sums over constraints of one kind and over states; J times h².
struct AppliedWork {
  double applied = 0;   ///< Σ -λ B
  double told = 0;      ///< Σ -λ_told B, what the compliances ask for; Σ C²/α̃ where B = C
  double spent = 0;     ///< Σ α̃ λ²; of springs 0
  double measured = 0;  ///< Σ B²/α̃
  double rounding = 0;  ///< the same, of what the rounding of positions makes of B

  AppliedWork& operator+=(const AppliedWork& other);
};

struct EffectiveStiffness {
  AppliedWork membrane, hinges, springs;

  EffectiveStiffness& operator+=(const EffectiveStiffness& other);

  /// 1, the share of the told stiffness that the cloth has. Nothing where none was told (k, or a compliance
  /// of 0) and where the cloth is hardly bent or strained: Σ B²/α̃ below 100 times what rounding alone makes
  /// of it, so that rounding changes the share by less than about 1 %.
  std::optional<double> bending_share() const;
  std::optional<double> membrane_share() const;
};

/// A state in the order of the solver's point arrays, which the batches' offsets name.
struct PermutedState {
  std::span<const Eigen::Vector3d> positions;  ///< m, relative to any origin
  std::span<const Eigen::Vector3d>
      rest;  ///< m, likewise; empty: springs have no bending part and count nothing
  std::span<const char> is_pinned;
  double substep = 0;   ///< h, s
  double rounding = 0;  ///< m, of a position that the solver keeps
};

/// Of the state at the end of a substep, with the multipliers of that substep.
template <class Real>
EffectiveStiffness effective_stiffness(const Constraints<Real>& constraints, const PermutedState& state);

}  // namespace bendlab
