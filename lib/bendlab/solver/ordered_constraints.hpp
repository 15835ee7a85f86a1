// Makes batches of constraints, as the kernels need them, from a scene's lists of constraints.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "bendlab/constraints/state.hpp"
#include "bendlab/solver/method.hpp"
#include "bendlab/solver/tiling.hpp"

namespace bendlab {

/// Ranges of stacks, in the order in which one thread projects the ranges (tiling.hpp). Empty: colour by
/// colour.
struct ConstraintTiles {
  std::vector<StackRange> strain, distance;
  std::array<std::vector<StackRange>, std::tuple_size_v<ElementKinds>> elements;  ///< by kind_index
};

/// How to order constraints.
struct Ordering {
  ConstraintOrder order = ConstraintOrder::colour;
  int projections = 1;               ///< how often a substep projects each constraint
  ConstraintTiles* tiles = nullptr;  ///< ordered_constraints() fills the tiles; null: no tiles
};

/// The batches of the input's lists in the order of `ordering`, with vertices permuted by input.permutation.
/// A stiffness given as k is converted to the k of one projection. For a stiffness given as compliance,
/// batches have multipliers, which are 0.
template <class Real>
Constraints<Real> ordered_constraints(const SimulationInput& input, const Point<Real>* rest_points,
                                      const Ordering& ordering = {});

/// The order of the batch of elements whose Kind::name is `kind`. Throws as index_of_kind() does.
template <class Real>
const BatchOrder& element_order_of(const Constraints<Real>& constraints, std::string_view kind);

}  // namespace bendlab
