// Constraints in the layout of the kernels: a structure of arrays per kind, in groups of max_lanes lanes that
// are projected side by side. Groups form stacks, stacks form colours:
//
//   group   max_lanes constraints, no two of which share a vertex
//   stack   groups one after another in which every lane keeps its first vertex (a star of springs around one
//           centre): the kernel holds the centres in registers and moves half as many points through memory
//   colour  stacks no two of which share a vertex: they may be projected side by side on any number of
//           threads with the same result
//
// A padded lane refers to dummy points behind the cloth's own, whose inverse mass is 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bendlab/constraints/large_array.hpp"
#include "bendlab/constraints/lists.hpp"
#include "bendlab/constraints/point.hpp"
#include "bendlab/constraints/stiffness.hpp"
#include "bendlab/constraints/tolerances.hpp"

namespace bendlab {

/// Lanes of a group: as many as the widest pack of any processor has (pack.hpp), so that the order of a batch
/// is the same on all processors.
inline constexpr int max_lanes = 16;
inline constexpr auto group_size = static_cast<std::size_t>(max_lanes);

/// The order of a batch's constraints. The springs of a star mostly follow one another in the list. Then two
/// numbers per star say where its springs are, and no number per spring is needed.
struct BatchOrder {
  /// max_lanes per stack: the place of the lane's constraint in the first group; -1: the lane is padded. In
  /// the next groups the lane holds the constraints at the places before it.
  std::vector<int> first;
  /// max_lanes per stack: in how many groups the lane holds a constraint; empty: in one, unless it is padded.
  std::vector<std::uint8_t> length;
  std::vector<int> at_place;  ///< index in the list of the constraint at each place; empty: the place itself
  std::vector<std::size_t> stacks;   ///< first lane of each stack, then the number of lanes
  std::vector<std::size_t> colours;  ///< first stack of each colour, then the number of stacks
  bool conflict_free = true;  ///< false: lanes of a group may share vertices; only the oracle may project it

  std::size_t stack_count() const { return stacks.size() - 1; }
  std::size_t lane_count() const { return stacks.empty() ? 0 : stacks.back(); }
  /// Whether a lane of that stack holds a constraint.
  bool holds(std::size_t stack, std::size_t lane) const;
  /// Index in the list of the constraint in a lane of that stack, or -1 if the lane is padded.
  int constraint(std::size_t stack, std::size_t lane) const;
  std::vector<int> constraint_of_lane() const;  ///< constraint() of every lane
};

inline bool BatchOrder::holds(std::size_t stack, std::size_t lane) const {
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  const std::size_t at = stack * width + lane % width;
  return length.empty() ? first[at] >= 0 : (lane - stacks[stack]) / width < length[at];
}

inline int BatchOrder::constraint(std::size_t stack, std::size_t lane) const {
  if (!holds(stack, lane)) return -1;
  constexpr auto width = static_cast<std::size_t>(max_lanes);
  const int place = first[stack * width + lane % width] - static_cast<int>((lane - stacks[stack]) / width);
  return at_place.empty() ? place : at_place[static_cast<std::size_t>(place)];
}

/// Calls visit(lane, constraint) for every lane; the constraint of a padded lane is -1.
template <class Visit>
void for_each_lane(const BatchOrder& order, Visit visit) {
  for (std::size_t stack = 0; stack + 1 < order.stacks.size(); ++stack)
    for (std::size_t lane = order.stacks[stack]; lane < order.stacks[stack + 1]; ++lane)
      visit(lane, order.constraint(stack, lane));
}

inline std::vector<int> BatchOrder::constraint_of_lane() const {
  std::vector<int> all(lane_count());
  for_each_lane(*this, [&](std::size_t lane, int constraint) { all[lane] = constraint; });
  return all;
}

/// The largest number of vertices of a constraint.
inline constexpr int dummy_corners = 4;
/// Dummy points for padded lanes: one per lane and corner, so that a pack never writes a point twice. Their
/// positions change no result. But a lane whose dummies are all at the same point counts as collapsed and is
/// projected again with care, which takes time.
inline constexpr int dummy_points = dummy_corners * max_lanes;

template <class Real>
struct DistanceBatch {
  BatchOrder order;
  LargeArray<int> a;             ///< max_lanes per stack: offset_of() the star's centre
  LargeArray<int> b;             ///< offset_of() the other end
  LargeArray<Real> rest_length;  ///< m; the largest number in a padded lane
  LargeArray<Real> softness;     ///< by lane, or empty: 1
  LargeArray<Real> multiplier;   ///< λ, XPBD only, else empty
  StiffnessKind kind = StiffnessKind::k;
  Real k = 1;               ///< fraction per projection
  Real compliance = 0;      ///< α is this times the softness, m/N
  bool only_pulls = false;  ///< a spring shorter than at rest is slack; only for projections
  std::size_t count = 0;
  /// Rest shape along which collapsed springs open; null: they stay collapsed.
  const Point<Real>* rest_points = nullptr;
};

enum class StrainForm {
  normalised,  ///< √S_ii - 1 and S_ij / (|f_i| |f_j|) (SBD 2014, eqs. 14 and 15)
  green,       ///< S_ii - 1 and S_ij (SBD 2014, eqs. 9 and 10)
  /// Ours: √S_ii - 1, and for shear the difference to a right angle, asin(S_ij / (|f_i| |f_j|)). Its gradient
  /// is 1 / |f| at any angle. The gradient of the cosine vanishes for parallel warp and weft, so its
  /// projection overshoots.
  angle,
};
inline constexpr std::array<std::string_view, 3> strain_form_names = {"normalised", "green", "angle"};

/// The α of stretch divided by the α of shear, so that all forms have the same stiffness at rest: S_ii - 1 of
/// `green` is about 2 (√S_ii - 1).
constexpr int stretch_softness(StrainForm form) {
  return form == StrainForm::green ? 4 : 1;
}

template <class Real>
struct StrainBatch {
  BatchOrder order;
  LargeArray<int> a, b, c;              ///< offset_of() each corner
  LargeArray<Real> q00, q01, q10, q11;  ///< inverse of Q, 1/m
  LargeArray<Real> softness;            ///< of each lane, times `compliance`, for add_forces(); empty: 1
  LargeArray<Real> multiplier;          ///< λ of all warps, then wefts, shears and areas; XPBD only
  StrainForm form = StrainForm::normalised;
  StiffnessKind kind = StiffnessKind::k;
  Real warp = 1, weft = 1, shear = 1, area = 0;  ///< fractions per projection (XPBD: 0 switches a term off)
  Real compliance = 0;  ///< inverse membrane stiffness, m/N; a triangle's α is compliance / rest area
  std::size_t count = 0;
  /// Rest shape along which collapsed triangles open; null: they stay collapsed.
  const Point<Real>* rest_points = nullptr;
};

/// Batches from lists, in the given order. `vertex_count` is the index of the first dummy.
template <class Real>
DistanceBatch<Real> make_distance_batch(const DistanceConstraints& list, BatchOrder order, int vertex_count);
template <class Real>
StrainBatch<Real> make_strain_batch(const StrainConstraints& list, BatchOrder order, int vertex_count);

}  // namespace bendlab
