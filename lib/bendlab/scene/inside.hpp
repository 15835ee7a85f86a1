// Finds cloth that starts inside an obstacle. The first step would push such cloth out violently.
#pragma once

#include <optional>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

struct Inside {
  int count;     ///< vertices that the obstacle would move by more than a hundredth of the cloth's size
  int deepest;   ///< the vertex that the obstacle would move the farthest
  double depth;  ///< how far the obstacle would move that vertex, m
};

/// The vertices that start inside scene.effects[index]; nothing if that effect is not an obstacle.
std::optional<Inside> inside_at_start(const BuiltScene& scene, std::size_t index);

}  // namespace bendlab
