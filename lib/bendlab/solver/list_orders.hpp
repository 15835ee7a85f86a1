// The orders of a scene's constraints, for methods that do not reorder the scene's lists.
#pragma once

#include <array>
#include <string_view>
#include <tuple>

#include "bendlab/solver/simulation.hpp"

namespace bendlab {

struct ListOrders {
  BatchOrder strain, distance;
  std::array<BatchOrder, std::tuple_size_v<ElementKinds>> elements;  ///< by kind_index

  explicit ListOrders(const SimulationInput& input);

  /// Throws as index_of_kind() does.
  const BatchOrder& of_elements(std::string_view kind) const { return elements[index_of_kind(kind)]; }
};

}  // namespace bendlab
