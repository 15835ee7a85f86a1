#include "experiments/scene/gravity.hpp"

namespace bendlab {

Vector3 gravity_of(const std::vector<EffectSettings>& effects) {
  for (const EffectSettings& effect : effects)  // a scene lists it at most once
    if (effect.type == "gravity") return Vector3(effect.values.numbers("acceleration").data());
  return Vector3::Zero();
}

Vector3 direction_of_gravity(const std::vector<EffectSettings>& effects) {
  const Vector3 gravity = gravity_of(effects);
  return gravity.norm() > 0 ? gravity.normalized() : Vector3(-Vector3::UnitZ());
}

}  // namespace bendlab
