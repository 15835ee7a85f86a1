// The hot loops of the step of Kang & Cho (methods/kang_cho.cpp). Every vertex sums its own springs. A pack
// is a SIMD vector with one vertex in each lane, and its vertices are computed at the same time.
#pragma once

#include "bendlab/constraints/state.hpp"
#include "bendlab/solver/spring_rows.hpp"

namespace bendlab {

/// The tangent of a spring is k along the spring, and k max(least, slope (1 - L / |d|)) across the spring.
template <class Real>
struct AcrossTangent {
  Real least, slope;
};

/// p, W and the first guess W⁻¹ p of every vertex.
template <class Real>
struct ImplicitSystem {
  LargeArray<Real> rows;  ///< by pack of lanes: p and the factors of W
  Points<Real> guess;     ///< m/s

  ImplicitSystem() = default;
  ImplicitSystem(std::size_t slice_count, std::size_t point_count);
};

/// Fills the system for the vertices of slices [first, last). `external`: the changes of velocity by the
/// scene's forces in this substep, or null. `substep` is h in s.
template <class Real>
void assemble(ImplicitSystem<Real>& system, const State<Real>& state, const Point<Real>* external,
              const SpringRows<Real>& springs, AcrossTangent<Real> across, Real substep, std::size_t first,
              std::size_t last);

/// Adds Δv to the velocities of the vertices of slices [first, last).
template <class Real>
void solve(State<Real>& state, const ImplicitSystem<Real>& system, const SpringRows<Real>& springs,
           AcrossTangent<Real> across, Real substep, std::size_t first, std::size_t last);

}  // namespace bendlab
