// Gravity: a uniform acceleration of every free vertex.
#include <algorithm>
#include <array>

#include "bendlab/effects/effect.hpp"

namespace bendlab {
namespace {

constexpr std::array<double, 3> earth = {0, 0, -9.81};

constexpr std::array parameters = {
    Parameter{.name = "acceleration",
              .type = ParameterType::numbers,
              .unit = "m/s²",
              .default_value = std::span<const double>(earth),
              .meaning = "acceleration of every free vertex",
              .length = 3},
};

template <class Real>
std::vector<Pass<Real>> compile(const EffectInput& input) {
  const std::vector<double>& a = input.parameters.numbers("acceleration");
  const Vector3Of<Real> acceleration(static_cast<Real>(a[0]), static_cast<Real>(a[1]),
                                     static_cast<Real>(a[2]));
  return {{"gravity", Stage::force, [acceleration](PassContext<Real>& context) {
             const Vector3Of<Real> change = context.substep * acceleration;
             State<Real>& state = context.state;
             for (std::size_t v = 0; v < static_cast<std::size_t>(state.vertex_count); ++v)
               if (state.position[v].w > 0) state.accelerate(v, change);
             if (!change.isZero(0)) context.acted += static_cast<std::uint64_t>(state.vertex_count);
           }}};
}

}  // namespace

namespace effect {
extern const Effect gravity{
    .name = "gravity",
    .summary = "a uniform acceleration of every free vertex",
    .source = "Müller et al. 2007, §3.1: v += h w f",
    .parameters = parameters,
    .compile_float = compile<float>,
    .compile_double = compile<double>,
    .idle =
        [](const ParameterValues& values) {
          return std::ranges::all_of(values.numbers("acceleration"), [](double a) { return a == 0; });
        },
};
}  // namespace effect
}  // namespace bendlab
