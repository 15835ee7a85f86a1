// Capsule: all points within a radius of a segment, which the cloth does not enter.
#include "bendlab/effects/round_obstacle.hpp"

namespace bendlab {
namespace {

template <class Real>
struct Segment {
  std::array<Vector3Of<Real>, 2> tips;

  Vector3Of<Real> nearest(const Vector3Of<Real>& x) const {
    const Vector3Of<Real> along = tips[1] - tips[0];
    const Real s = along.dot(x - tips[0]), squared = along.squaredNorm();
    return s <= 0 ? tips[0] : s >= squared ? tips[1] : Vector3Of<Real>(tips[0] + s / squared * along);
  }
  Vector3Of<Real> away() const { return Vector3Of<Real>(tips[1] - tips[0]).unitOrthogonal(); }
  template <class To>
  Segment<To> moved(const Vector3& shift) const {
    return {Vector3(tips[0] + shift).cast<To>(), Vector3(tips[1] + shift).cast<To>()};
  }
};

constexpr std::array<double, 3> left = {-0.25, 0, 0}, right = {0.25, 0, 0};

constexpr std::array own_parameters = {
    Parameter{.name = "a",
              .type = ParameterType::numbers,
              .unit = "m",
              .default_value = std::span<const double>(left),
              .meaning = "one end of the segment; the spin turns about the direction from a to b",
              .length = 3},
    Parameter{.name = "b",
              .type = ParameterType::numbers,
              .unit = "m",
              .default_value = std::span<const double>(right),
              .meaning = "the other end",
              .length = 3},
    Parameter{.name = "radius",
              .type = ParameterType::number,
              .unit = "m",
              .default_value = 0.1,
              .meaning = "the capsule is all points within it of the segment",
              .minimum = 0,
              .above = true},
};

constexpr auto parameters = joined(own_parameters, obstacle::common_parameters, obstacle::spin_parameter);

template <class Real>
std::vector<Pass<Real>> compile(const EffectInput& input) {
  const ParameterValues& values = input.parameters;
  const Vector3 a = obstacle::vector_of(values, "a"), b = obstacle::vector_of(values, "b");
  if (!((b - a).norm() > 0))
    throw std::invalid_argument("a and b are the same point; use a sphere for a capsule without length");
  const obstacle::Motion motion{.velocity = obstacle::vector_of(values, "velocity"),
                                .pivot = a,
                                .axis = (b - a).normalized(),
                                .spin = values.number("spin")};
  return {{"capsule", Stage::project,
           obstacle::RoundObstacle<Real, Segment>(input, {a, b}, values.number("radius"), motion)}};
}

}  // namespace

namespace effect {
extern const Effect capsule{
    .name = "capsule",
    .summary = "an obstacle: all points within a radius of a segment",
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
