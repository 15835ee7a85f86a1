// Constraints as the kernels want them: a structure of arrays per kind, grouped by colour (no two constraints
// of a colour share a vertex), each colour padded to whole packs of max_lanes lanes. A padded lane points to
// dummy points behind the cloth's own, whose inverse mass is 0.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bendlab/constraints/lists.hpp"
#include "bendlab/constraints/pack.hpp"
#include "bendlab/constraints/stiffness.hpp"
#include "bendlab/constraints/tolerances.hpp"

namespace bendlab {

/// Where each constraint stands: lane → constraint index, or -1 for a padded lane.
struct BatchOrder {
  std::vector<int> constraint_of_lane;  ///< a multiple of max_lanes
  std::vector<std::size_t> colours;     ///< first lane of each colour, then the number of lanes
  bool conflict_free =
      true;  ///< no vertex twice in a colour; false: only the reference may run it, lane by lane
};

/// Dummy points that padded lanes use: one per lane and corner, so that a pack never meets a point twice.
inline constexpr int dummy_points = 4 * max_lanes;

template <class Real>
struct DistanceBatch {
  BatchOrder order;
  std::vector<int> a, b;
  std::vector<Real> rest_length;
  std::vector<Real> multiplier;  ///< λ, XPBD only, else empty
  StiffnessKind kind = StiffnessKind::k;
  Real k = 1;           ///< fraction per projection
  Real compliance = 0;  ///< α, m/N
  std::size_t count = 0;
};

enum class StrainForm {
  normalised,  ///< √S_ii - 1 and S_ij / (|f_i| |f_j|) (SBD 2014, eqs. 14 and 15)
  green,       ///< S_ii - 1 and S_ij (SBD 2014, eqs. 9 and 10)
};

template <class Real>
struct StrainBatch {
  BatchOrder order;
  std::vector<int> a, b, c;
  std::vector<Real> q00, q01, q10, q11;  ///< inverse of Q, 1/m
  std::vector<Real> multiplier;          ///< λ of warp, weft, shear, area after one another; XPBD only
  StrainForm form = StrainForm::normalised;
  StiffnessKind kind = StiffnessKind::k;
  Real warp = 1, weft = 1, shear = 1, area = 0;  ///< fractions per projection (XPBD: 0 switches a term off)
  Real compliance = 0;  ///< inverse membrane stiffness, m/N; a triangle's α is compliance / rest area
  std::size_t count = 0;
};

/// Batches from lists, in the given order. `vertex_count` is where the dummies begin.
template <class Real>
DistanceBatch<Real> make_distance_batch(const DistanceConstraints& list, BatchOrder order, int vertex_count);
template <class Real>
StrainBatch<Real> make_strain_batch(const StrainConstraints& list, BatchOrder order, int vertex_count);

}  // namespace bendlab
