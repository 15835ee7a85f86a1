// Gravity: a uniform acceleration of every free vertex.
#include <algorithm>
#include <array>

#include "bendlab/effects/effects.hpp"

namespace bendlab {
namespace gravity_effect {

constexpr std::array fields = {
    field<&Gravity::acceleration>(
        {.name = "acceleration", .unit = "m/s²", .meaning = "acceleration of every free vertex"}),
};

template <class Real>
std::vector<Pass<Real>> compile(const Gravity& settings, const EffectInput&) {
  const Vector3Of<Real> acceleration = settings.acceleration.template cast<Real>();
  return {{"gravity", Stage::force, [acceleration](PassContext<Real>& context) {
             const Vector3Of<Real> change = context.substep * acceleration;
             State<Real>& state = context.state;
             for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v)
               if (state.position[v].w > 0) state.accelerate(v, change);
             if (!change.isZero(0)) context.acted += static_cast<std::uint64_t>(state.vertex_count);
           }}};
}

bool idle(const Gravity& settings) {
  return settings.acceleration.isZero(0);
}

Vector3 acceleration_of(const Gravity& settings) {
  return settings.acceleration;
}

}  // namespace gravity_effect

constinit const EffectKind Gravity::kind{
    .name = "gravity",
    .summary = "a uniform acceleration of every free vertex",
    .source = "Müller et al. 2007, §3.1: v += h w f",
    .settings = table_of<Gravity>(gravity_effect::fields),
    .keeps_momentum = true,
    .keeps_angular_momentum = true,
    .compile_float = erased<gravity_effect::compile<float>>,
    .compile_double = erased<gravity_effect::compile<double>>,
    .idle = erased<gravity_effect::idle>,
    .acceleration = erased<gravity_effect::acceleration_of>,
};
}  // namespace bendlab
