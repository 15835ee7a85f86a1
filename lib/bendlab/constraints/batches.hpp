// Constraints in the layout of the kernels: a structure of arrays per kind. A lane is an entry of a vector
// register, and holds one constraint. Lanes form groups, groups form stacks, and stacks form colours:
//
//   group   max_lanes constraints, no two of which share a vertex
//   stack   consecutive groups. The constraints of a lane have the same first vertex in all groups of the
//           stack: they are a star of springs around one centre. A kernel keeps the centres of a stack in
//           registers, and so moves half as many points through memory.
//   colour  stacks, no two of which share a vertex. The result of a colour does not depend on the number of
//           threads that project its stacks.
//
// A padded lane holds no constraint. Dummy points for padded lanes follow the cloth's points; inverse mass 0.
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

/// Number of lanes of a group: the number of lanes of the widest pack of any processor (pack.hpp), so that
/// the order of a batch is the same on all processors.
inline constexpr int max_lanes = 16;
inline constexpr auto group_size = static_cast<std::size_t>(max_lanes);

/// The order of a batch's constraints. In most lists the springs of a star follow one another, so two numbers
/// per star are stored instead of one number per spring.
struct BatchOrder {
  /// max_lanes numbers per stack: the place of each lane's constraint in the first group, or -1 for a padded
  /// lane. In group i of the stack the lane holds the constraint at the place first - i.
  std::vector<int> first;
  /// max_lanes numbers per stack: the number of groups in which each lane holds a constraint. If empty, the
  /// number is 1, or 0 for a padded lane.
  std::vector<std::uint8_t> length;
  std::vector<int> at_place;  ///< index in the list of the constraint at each place; empty: the place itself
  std::vector<std::size_t> stacks;   ///< first lane of each stack; at the end the number of lanes
  std::vector<std::size_t> colours;  ///< first stack of each colour; at the end the number of stacks
  bool conflict_free = true;  ///< false: lanes of a group may share vertices; only the oracle may project it

  std::size_t stack_count() const { return stacks.size() - 1; }
  std::size_t lane_count() const { return stacks.empty() ? 0 : stacks.back(); }
  /// Whether this lane of this stack holds a constraint.
  bool holds(std::size_t stack, std::size_t lane) const;
  /// Index in the list of the constraint in this lane of this stack, or -1 if the lane is padded.
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
inline constexpr int dummy_corners = 13;
/// Dummy points for padded lanes: one per lane and corner, so that a pack never writes a point twice. The
/// positions of the dummies change no result. But a lane whose dummies are all at one point counts as a
/// collapsed constraint. The kernel would project its pack a second time, which takes time.
inline constexpr int dummy_points = dummy_corners * max_lanes;

/// Sets the positions of the dummy points, which begin at points[first]. The corners of a padded lane are at
/// different places.
template <class Real>
void place_dummies(Points<Real>& points, std::size_t first) {
  for (int corner = 1; corner < dummy_corners; ++corner)
    for (int lane = 0; lane < max_lanes; ++lane)
      points[first + static_cast<std::size_t>(corner * max_lanes + lane)].set(
          Vector3Of<Real>::Unit((corner - 1) % 3) * static_cast<Real>(1 + (corner - 1) / 3));
}

template <class Real>
struct DistanceBatch {
  BatchOrder order;
  LargeArray<int> a;             ///< offset_of() the star's centre; max_lanes per stack
  LargeArray<int> b;             ///< offset_of() the end that is not the centre
  LargeArray<Real> rest_length;  ///< m; the largest number in a padded lane
  LargeArray<Real> softness;     ///< by lane; empty: 1
  LargeArray<Real> multiplier;   ///< λ, XPBD only, else empty
  StiffnessKind kind = StiffnessKind::k;
  Real k = 1;               ///< fraction per projection
  Real compliance = 0;      ///< α is this times the softness, m/N
  bool only_pulls = false;  ///< a spring shorter than at rest is slack; only for projections
  std::size_t count = 0;
  /// Collapsed springs open in their directions in this rest shape; null: collapsed springs do not open.
  const Point<Real>* rest_points = nullptr;
};

enum class StrainForm {
  normalised,  ///< √S_ii - 1 and S_ij / (|f_i| |f_j|) (SBD 2014, eqs. 14 and 15)
  green,       ///< S_ii - 1 and S_ij (SBD 2014, eqs. 9 and 10)
  /// Not from a paper: √S_ii - 1, and for shear the difference of a right angle and the angle between warp
  /// and weft, asin(S_ij / (|f_i| |f_j|)). The gradient of this difference is 1 / |f| at any angle. The
  /// cosine in `normalised` has no gradient for parallel warp and weft, so its projections overshoot.
  angle,
  /// S_ii - 1 and S_ij, like green, but with the stiffnesses of an isotropic sheet: with the Green strain E
  /// the energy per area is ½ Y ((1 - ν) |E|² + ν (tr E)²), Y = E h / (1 - ν²) (Saint Venant-Kirchhoff).
  /// The compliance is 1 / (Y (1 - ν)). A fourth term, C = S_11 + S_22 - 2, takes the place of the area.
  stvk,
};
inline constexpr std::array<std::string_view, 4> strain_form_names = {"normalised", "green", "angle", "stvk"};

/// Whether the form measures stretch by S_ii - 1 and shear by S_ij.
constexpr bool is_green(StrainForm form) {
  return form == StrainForm::green || form == StrainForm::stvk;
}

/// The α of stretch and of shear, divided by compliance / rest area. All forms have the same stiffness of
/// stretch at rest, although S_ii - 1 is about 2 (√S_ii - 1). All forms but stvk have equal stiffnesses of
/// stretch and shear.
constexpr int stretch_softness(StrainForm form) {
  return is_green(form) ? 4 : 1;
}
constexpr int shear_softness(StrainForm form) {
  return form == StrainForm::stvk ? 2 : 1;
}
/// The α of the fourth term, divided by compliance / rest area. For stvk, `area` is ν / (1 - ν).
template <class Real>
constexpr Real area_softness(StrainForm form, Real area) {
  return form == StrainForm::stvk ? 4 / area : Real(1);
}

template <class Real>
struct StrainBatch {
  BatchOrder order;
  LargeArray<int> a, b, c;                        ///< offset_of() each corner
  LargeArray<Real> q00, q01, q10, q11;            ///< inverse of Q, 1/m
  LargeArray<Real> softness;                      ///< of each lane, times `compliance`; empty: 1
  std::array<Real, 3> term_softness = {1, 1, 1};  ///< of warp, weft and shear, times `compliance`
  LargeArray<Real> multiplier;  ///< λ of all warps, then wefts, shears and areas; XPBD only
  StrainForm form = StrainForm::normalised;
  StiffnessKind kind = StiffnessKind::k;
  /// Fractions per projection (XPBD: 0 switches a term off). For StrainForm::stvk, `area` is ν / (1 - ν).
  Real warp = 1, weft = 1, shear = 1, area = 0;
  Real compliance = 0;  ///< inverse membrane stiffness, m/N; a triangle's α is compliance / rest area
  std::size_t count = 0;
  /// Collapsed triangles open towards this rest shape; null: collapsed triangles do not open.
  const Point<Real>* rest_points = nullptr;
};

/// Batches from lists, in the given order. `vertex_count` is the index of the first dummy point.
template <class Real>
DistanceBatch<Real> make_distance_batch(const DistanceConstraints& list, BatchOrder order, int vertex_count);
template <class Real>
StrainBatch<Real> make_strain_batch(const StrainConstraints& list, BatchOrder order, int vertex_count);

}  // namespace bendlab
