// Finds cloth that starts inside an obstacle, from which the first step would throw it out.
#pragma once

#include <optional>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

struct Inside {
  int count;     ///< vertices that the obstacle would move by more than a hundredth of the cloth's size
  int deepest;   ///< the vertex that it would move the farthest
  double depth;  ///< how far the obstacle would move that vertex, m
};

/// The cloth that starts inside the obstacle scene.effects[index]; nothing if that effect is not an obstacle.
std::optional<Inside> inside_at_start(const BuiltScene& scene, std::size_t index);

}  // namespace bendlab
