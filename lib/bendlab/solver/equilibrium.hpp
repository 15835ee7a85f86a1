// Static equilibrium: the minimum of elastic energy and loads, by Newton's method.
//
//   per step:  loads → gradient, Hessian → factorise → move
//
//   (H + M / τ²) Δx = f - ∇E,   H = Σ ψ'' ∇C ∇Cᵀ + λ ∇²C
//
// λ estimates ψ'(C), the force in a constraint. In a membrane that hardly stretches ψ'(C) itself is a bad estimate away
// from the solution: a step that turns a triangle by an angle stretches it by the angle squared, and the force of that
// would hold the next step back. So λ is what the last step aimed at, ψ' + ψ'' ∇C·Δx, as if force and position were
// both unknowns (the mixed form of Newton's method; at the solution the two agree). A step is as long as it stretches
// no triangle by more than `stretch_per_step` beyond what it aimed at.
//
// M / τ² is what an implicit Euler step of length τ from rest has: from afar (a flat sheet has no stiffness across
// itself) the cloth creeps downhill, and as τ grows the steps become Newton's. Where the matrix is not positive definite
// (a crumpled cloth; springs that are compressed before the membrane has taken their push) λ counts only where a length
// pulls, and where that does not help τ shrinks. The last steps are with the whole matrix and without M / τ²: what is
// found is a minimum, never a saddle.
//
// A stiff membrane starts softer, and grows stiff in steps of ten once the cloth has found its shape: found at full
// stiffness from the start, a strip that bends by springs keeps creases that the first steps made.
//
// A step counts as dt of the scene's time; the scene is settled when the last step moved no vertex by more than 1e-6
// sizes and forces that are left over are at most `equilibrium_tolerance` of the loads, or what the rounding of
// positions amounts to.
#pragma once

#include <memory>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

inline constexpr double equilibrium_tolerance = 1e-7;  ///< 1, |f - ∇E| / |f| over all free vertices

/// In double precision. Loads are what the passes of stage `force` do to a cloth at rest; passes of stages `damp`
/// and `velocity` have nothing to do there. Throws std::invalid_argument for passes of other stages and as ElasticSystem does.
std::unique_ptr<Simulation> make_equilibrium(const SimulationInput& input,
                                             std::vector<Pass<double>> effect_passes);

}  // namespace bendlab
