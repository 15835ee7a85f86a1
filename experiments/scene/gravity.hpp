// Gravity, from a scene's list of effects.
#pragma once

#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"
#include "experiments/config/config.hpp"

namespace bendlab {

/// m/s²; zero if the list has no gravity.
Vector3 gravity_of(const std::vector<EffectSettings>& effects);

/// Its direction; -z if there is none.
Vector3 direction_of_gravity(const std::vector<EffectSettings>& effects);

}  // namespace bendlab
