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
// * Δv is (1 - G²) times what the exact solution would be, that is, backward Euler of a cloth with more mass,
//   M' = (1 - G²)⁻¹-fold M + h² K less h² K, and M' ≥ M. With J fixed it is stable at any step;
// * the exact solution differs by O(h⁵) in velocity per step;
// * the mass that is gained acts along the springs only and grows with h² k / m: a cloth whose springs point along
//   its fall falls slower than a stone (two masses: by the factor 1 - (h²k / (m + h²k))²), and the sum of momenta
//   is not kept but for single springs and even meshes;
// * J leaves out what a taut spring does sideways, k (1 - L / |d|), which is integrated explicitly: sideways a step
//   is stable up to about h² Σ k (1 - L / |d|) < 2 m.
#pragma once

#include <memory>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

/// The springs are input.edges, of stiffness 1 / strain_stiffness.compliance, and input.distance, of stiffness
/// 1 / bending_stiffness.compliance (N/m). Of the settings it looks at dt, substeps and threads. Throws
/// std::invalid_argument for elements, for a stiffness that is not a compliance above 0 and for a pass at a stage
/// that this step has not.
template <class Real>
std::unique_ptr<Simulation> make_kang_cho_step(const SimulationInput& input,
                                               std::vector<Pass<Real>> effect_passes);

}  // namespace bendlab
