// Sphere: a ball that the cloth does not enter.
#include "bendlab/effects/round_obstacle.hpp"

namespace bendlab {
namespace {

// The core of a ball is its centre.
template <class Real>
struct Centre {
  std::array<Vector3Of<Real>, 1> tips;

  const Vector3Of<Real>& nearest(const Vector3Of<Real>&) const { return tips[0]; }
  Vector3Of<Real> away() const { return Vector3Of<Real>::UnitZ(); }
  template <class To>
  Centre<To> moved(const Vector3& shift) const {
    return {Vector3(tips[0] + shift).cast<To>()};
  }
};

constexpr std::array own_parameters = {
    Parameter{.name = "centre",
              .type = ParameterType::numbers,
              .unit = "m",
              .default_value = std::span<const double>(obstacle::zero),
              .meaning = "centre of the ball",
              .length = 3},
    Parameter{.name = "radius",
              .type = ParameterType::number,
              .unit = "m",
              .default_value = 0.25,
              .meaning = "of the ball",
              .minimum = 0,
              .above = true},
    Parameter{.name = "axis",
              .type = ParameterType::numbers,
              .unit = "1",
              .default_value = std::span<const double>(obstacle::up),
              .meaning = "of the spin; of any length but zero",
              .length = 3},
};

constexpr auto parameters = joined(own_parameters, obstacle::common_parameters, obstacle::spin_parameter);

template <class Real>
std::vector<Pass<Real>> compile(const EffectInput& input) {
  const ParameterValues& values = input.parameters;
  const Vector3 centre = obstacle::vector_of(values, "centre");
  const obstacle::Motion motion{.velocity = obstacle::vector_of(values, "velocity"),
                                .pivot = centre,
                                .axis = obstacle::direction_of(values, "axis"),
                                .spin = values.number("spin")};
  return {{"sphere", Stage::project,
           obstacle::RoundObstacle<Real, Centre>(input, {centre}, values.number("radius"), motion)}};
}

}  // namespace

namespace effect {
extern const Effect sphere{
    .name = "sphere",
    .summary = "an obstacle: a ball that the cloth does not enter",
    .source =
        "Müller et al. 2007, §3.4 (collision constraints, projected as inequalities); edges: Kelley 1960, "
        "cutting planes",
    .parameters = parameters,
    .needs_projection = true,
    .is_obstacle = true,
    .repeatable = true,
    .compile_float = compile<float>,
    .compile_double = compile<double>,
};
}  // namespace effect
}  // namespace bendlab
