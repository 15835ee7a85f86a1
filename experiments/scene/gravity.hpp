// Gravity as a scene's list of effects has it.
#pragma once

#include <vector>

#include "bendlab/mesh/triangle_mesh.hpp"
#include "experiments/config/config.hpp"

namespace bendlab {

/// m/s²; none where the list has no gravity.
Vector3 gravity_of(const std::vector<EffectSettings>& effects);

/// Its direction; -z where there is none.
Vector3 direction_of_gravity(const std::vector<EffectSettings>& effects);

}  // namespace bendlab
