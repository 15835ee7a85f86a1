#include "bendlab/scene/gravity.hpp"

namespace bendlab {

Vector3 gravity_of(const std::vector<Effect>& effects) {
  Vector3 sum = Vector3::Zero();
  for (const Effect& effect : effects)
    if (effect.kind().acceleration != nullptr) sum += effect.kind().acceleration(effect.settings());
  return sum;
}

Vector3 direction_of_gravity(const std::vector<Effect>& effects) {
  const Vector3 gravity = gravity_of(effects);
  return gravity.norm() > 0 ? gravity.normalized() : Vector3(-Vector3::UnitZ());
}

}  // namespace bendlab
