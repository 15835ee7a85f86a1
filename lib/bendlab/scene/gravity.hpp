// Gravity, from a scene's list of effects.
#pragma once

#include <vector>

#include "bendlab/effects/effect.hpp"
#include "bendlab/mesh/triangle_mesh.hpp"

namespace bendlab {

/// The sum of the uniform accelerations of all effects, m/s²; zero if no effect has one.
Vector3 gravity_of(const std::vector<Effect>& effects);

/// The direction of gravity; -z if there is no gravity.
Vector3 direction_of_gravity(const std::vector<Effect>& effects);

}  // namespace bendlab
