// Gravity, from a scene's list of effects.
#pragma once

#include <vector>

#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// m/s²; zero if none of them is a uniform acceleration.
Vector3 gravity_of(const std::vector<Effect>& effects);

/// Its direction; -z if there is none.
Vector3 direction_of_gravity(const std::vector<Effect>& effects);

}  // namespace bendlab
