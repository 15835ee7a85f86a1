// The loops that take most of the time. project() projects a range of stacks of a batch, all lanes of a pack
// at once. The stacks must lie within one colour. `substep` is h in s, which only XPBD uses. `backwards`
// projects the constraints in the opposite order.
#pragma once

#include <type_traits>

#include "bendlab/constraints/elements.hpp"

namespace bendlab {

template <class Real>
void project(const PlacesOf<Real>& places, DistanceBatch<Real>& batch, std::size_t first_stack,
             std::size_t last_stack, Real substep, bool backwards = false);
template <class Real>
void project(const PlacesOf<Real>& places, StrainBatch<Real>& batch, std::size_t first_stack,
             std::size_t last_stack, Real substep, bool backwards = false);
template <class Real, class Kind>
void project(const PlacesOf<Real>& places, ElementBatch<Real, Kind>& batch, std::size_t first_stack,
             std::size_t last_stack, Real substep, bool backwards = false);

/// Adds the elastic force -ψ'(C) ∇C of each constraint to the points of `forces`, in N: ψ = C² / 2α with the
/// batch's compliance, which has to be above 0. A constraint without a direction adds no force. `points` are
/// positions in one piece (not split, see point.hpp). Pinned points get forces, too.
template <class Real>
void add_forces(const Point<Real>* points, Point<Real>* forces, const DistanceBatch<Real>& batch,
                std::size_t first_stack, std::size_t last_stack);
template <class Real>
void add_forces(const Point<Real>* points, Point<Real>* forces, const StrainBatch<Real>& batch,
                std::size_t first_stack, std::size_t last_stack);
/// Throws std::logic_error for a OneSided kind.
template <class Real, class Kind>
void add_forces(const Point<Real>* points, Point<Real>* forces, const ElementBatch<Real, Kind>& batch,
                std::size_t first_stack, std::size_t last_stack);

/// Removes the fraction `k` of the rate of change of each constraint from the velocities (SBD 2014, eq. 23,
/// in the form that dissipates for any masses: Δv = -k Ċ / Σ w|∇C|² w ∇C), colour by colour. Damps normalised
/// warp, weft and shear of triangles. The batch must be conflict-free; otherwise use damp_by_oracle().
template <class Real>
void damp(const Point<Real>* points, Point<Real>* velocities, const DistanceBatch<Real>& batch, Real k);
template <class Real>
void damp(const Point<Real>* points, Point<Real>* velocities, const StrainBatch<Real>& batch, Real k);
template <class Real, class Kind>
void damp(const Point<Real>* points, Point<Real>* velocities, const ElementBatch<Real, Kind>& batch, Real k);

/// Calls action(std::bool_constant<split>), where `split` says whether the places are split (single
/// precision).
template <class Real, class Action>
void with_split(const Places<Real>& places, const Action& action) {
  if constexpr (sizeof(Real) == sizeof(float)) {
    if (places.base != nullptr) return action(std::true_type{});
  }
  action(std::false_type{});
}

}  // namespace bendlab
