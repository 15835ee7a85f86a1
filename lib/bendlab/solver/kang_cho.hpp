// The approximate implicit step of Kang & Cho 2002 for cloth of masses and springs.
//
//   per substep h:  force passes → damp passes → springs → implicit solve → update → velocity passes
//
// Backward Euler with the springs' tangent reduced to its part along the spring, J_ij = k d dᵀ / |d|²,
//
//   (M + h² K) Δv = h f - h² K v,
//
// solved by two steps of block Jacobi, from Δv = 0:
//
//   W_i  = m_i 1 + h² Σ_j J_ij
//   p_i  = h f_i + h² Σ_j J_ij (v_j - v_i)
//   Δv_i = W_i⁻¹ (p_i + h² Σ_j J_ij W_j⁻¹ p_j),   v += Δv,   x += h v
//
// f are the springs' forces and, as in the source, the scene's forces: the change of velocity that force passes
// make is taken back and enters p as m_i times it. So a cloth in equilibrium stays there, whatever h. Damp
// passes see the velocities before these forces. A pinned vertex has p = Δv = 0 and acts on its neighbours.
//
// What the approximation does (G = W⁻¹ h² × the off-diagonal blocks; its eigenvalues lie within (-1, 1)):
//
// * Δv solves backward Euler exactly for another mass, M' = (M + h² K) (1 - G²)⁻¹ - h² K ≥ M: with J fixed it is
//   stable at any step. From the solution for M it differs by O(h⁵) per step;
// * the mass gained grows with κ = h² k and acts where J does. Two masses on a spring fall along it slower than a
//   stone, by the factor 1 - (κ / (m + κ))². M' knows no translations: Σ m v is kept for a single spring, not for
//   a cloth (the share lost is O((κ / m)²)). It turns with the cloth, so energy is not kept either: with κ ≫ m a
//   sheet that swings down climbs higher than it started;
// * a taut spring's stiffness across it, k (1 - L / |d|), is not in the source's J and so is integrated explicitly:
//   a mass on a taut string is stable while h² Σ k (1 - L / |d|) < 4 m. In a hanging sheet of 32 × 32 cells that is
//   steps of 1.5 to 4 times explicit Euler's, h² k / m of 1 to 6. Tangent::taut adds it to J.
#pragma once

#include <memory>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// The springs are input.edges, of stiffness 1 / strain_stiffness.compliance, and input.distance, of stiffness
/// 1 / bending_stiffness.compliance (N/m). Of the settings it looks at tangent, dt, substeps and threads. Throws
/// std::invalid_argument for elements, for a stiffness that is not a compliance above 0 and for a pass at a stage
/// that this step has not.
template <class Real>
std::unique_ptr<Simulation> make_kang_cho_step(const SimulationInput& input,
                                               std::vector<Pass<Real>> effect_passes);

}  // namespace bendlab
