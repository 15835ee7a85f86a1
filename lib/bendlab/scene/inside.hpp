// Cloth that starts inside an obstacle, from where the first step throws it out.
#pragma once

#include <optional>

#include "bendlab/scene/built_scene.hpp"

namespace bendlab {

struct Inside {
  int count;     ///< of vertices that the obstacle would move by more than a hundredth of the cloth's size
  int deepest;   ///< the vertex that it would move the farthest
  double depth;  ///< by so much, m
};

/// Of the start, and the obstacle that is the effect at `index`; nothing if that is no obstacle.
std::optional<Inside> inside_at_start(const BuiltScene& scene, std::size_t index);

}  // namespace bendlab
