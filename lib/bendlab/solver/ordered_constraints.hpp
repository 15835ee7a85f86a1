// A scene's lists of constraints as the batches of the kernels.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "bendlab/constraints/state.hpp"
#include "bendlab/solver/method.hpp"
#include "bendlab/solver/tiling.hpp"

namespace bendlab {

/// Ranges of stacks by which one thread goes through a batch (tiling.hpp); empty: colour by colour.
struct ConstraintTiles {
  std::vector<StackRange> strain, distance;
  std::array<std::vector<StackRange>, std::tuple_size_v<ElementKinds>> elements;  ///< by kind_index
};

/// How constraints are put in order.
struct Ordering {
  ConstraintOrder order = ConstraintOrder::colour;
  int projections = 1;               ///< of each constraint in a substep
  ConstraintTiles* tiles = nullptr;  ///< to be filled; null: none
};

/// The batches of input's lists in that order, on vertices permuted by input.permutation, with their
/// stiffness. A k is that of one projection; a compliance has its multipliers, which are 0.
template <class Real>
Constraints<Real> ordered_constraints(const SimulationInput& input, const Point<Real>* rest_points,
                                      const Ordering& ordering = {});

/// The order of the element batch of that Kind::name; throws as index_of_kind() does.
template <class Real>
const BatchOrder& element_order_of(const Constraints<Real>& constraints, std::string_view kind);

}  // namespace bendlab
