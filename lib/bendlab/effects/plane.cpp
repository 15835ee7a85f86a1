// Plane: a half space that the cloth does not enter.
#include "bendlab/effects/obstacle.hpp"

namespace bendlab {
namespace {

constexpr std::array own_parameters = {
    Parameter{.name = "point",
              .type = ParameterType::numbers,
              .unit = "m",
              .default_value = std::span<const double>(obstacle::zero),
              .meaning = "a point of the plane; the spin's axis goes through it",
              .length = 3},
    Parameter{.name = "normal",
              .type = ParameterType::numbers,
              .unit = "1",
              .default_value = std::span<const double>(obstacle::up),
              .meaning = "points to the cloth's side; of any length but zero",
              .length = 3},
};

constexpr auto parameters = joined(own_parameters, obstacle::common_parameters, obstacle::spin_parameter);

template <class Real>
std::vector<Pass<Real>> compile(const EffectInput& input) {
  const ParameterValues& values = input.parameters;
  const obstacle::Motion motion{.velocity = obstacle::vector_of(values, "velocity"),
                                .pivot = obstacle::vector_of(values, "point"),
                                .axis = obstacle::direction_of(values, "normal"),
                                .spin = values.number("spin")};
  const double thickness = values.number("thickness");
  return {
      {"plane", Stage::project, [motion, thickness, used = input.contacts_used](PassContext<Real>& context) {
         const obstacle::Step<Real> step(motion, context);
         const Vector3Of<Real> normal = motion.axis.template cast<Real>();
         const auto level = static_cast<Real>(motion.axis.dot(motion.pivot + step.shift()) + thickness);
         const Points<Real>& points = context.state.position;
         for (std::size_t v = 0; v < static_cast<std::size_t>(context.state.vertex_count); ++v)
           if (const Real depth = level - normal.dot(points[v].vector()); depth > 0 && points[v].w > 0)
             obstacle::push(context, step, v, normal, depth, used);
       }}};
}

}  // namespace

namespace effect {
extern const Effect plane{
    .name = "plane",
    .summary = "an obstacle: a half space that the cloth does not enter",
    .source = "Müller et al. 2007, §3.4 (static collision constraint, projected as an inequality)",
    .parameters = parameters,
    .needs_projection = true,
    .is_obstacle = true,
    .repeatable = true,
    .compile_float = compile<float>,
    .compile_double = compile<double>,
};
}  // namespace effect
}  // namespace bendlab
