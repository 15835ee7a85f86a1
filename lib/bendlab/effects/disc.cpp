// Disc: a round table top. It holds all points within half its height of a flat disc, whose radius is smaller
// by half the height. So its rim is half a circle, and the cloth has no edge to catch on.
#include "bendlab/effects/round_obstacle.hpp"

namespace bendlab {
namespace {

template <class Real>
struct FlatDisc {
  Vector3Of<Real> centre, axis;
  Real radius;
  std::array<Vector3Of<Real>, 0> tips{};  // none: edges of the cloth meet the rim before triangles do

  Vector3Of<Real> nearest(const Vector3Of<Real>& x) const {
    const Vector3Of<Real> arm = x - centre, within = arm - axis.dot(arm) * axis;
    const Real squared = within.squaredNorm();
    return squared <= radius * radius ? Vector3Of<Real>(centre + within)
                                      : Vector3Of<Real>(centre + radius / std::sqrt(squared) * within);
  }
  Vector3Of<Real> away() const { return axis; }
  template <class To>
  FlatDisc<To> moved(const Vector3& shift) const {
    return {Vector3(centre + shift).cast<To>(), axis.template cast<To>(), static_cast<To>(radius)};
  }
};

constexpr std::array own_parameters = {
    Parameter{.name = "centre",
              .type = ParameterType::numbers,
              .unit = "m",
              .default_value = std::span<const double>(obstacle::zero),
              .meaning = "centre of the table top, half its height below the surface",
              .length = 3},
    Parameter{.name = "axis",
              .type = ParameterType::numbers,
              .unit = "1",
              .default_value = std::span<const double>(obstacle::up),
              .meaning = "of the disc and its spin; of any length but zero",
              .length = 3},
    Parameter{.name = "radius",
              .type = ParameterType::number,
              .unit = "m",
              .default_value = 0.5,
              .meaning = "of the table top, rim included",
              .minimum = 0,
              .above = true},
    Parameter{.name = "height",
              .type = ParameterType::number,
              .unit = "m",
              .default_value = 0.04,
              .meaning = "of the table top, at most twice the radius; the rim is half a circle",
              .minimum = 0,
              .above = true},
};

constexpr auto parameters = joined(own_parameters, obstacle::common_parameters, obstacle::spin_parameter);

template <class Real>
std::vector<Pass<Real>> compile(const EffectInput& input) {
  const ParameterValues& values = input.parameters;
  const Vector3 centre = obstacle::vector_of(values, "centre"), axis = obstacle::direction_of(values, "axis");
  const double radius = values.number("radius"), half_height = values.number("height") / 2;
  if (half_height > radius)
    throw std::invalid_argument(
        "height is more than twice the radius; use a capsule for what is taller than wide");
  const obstacle::Motion motion{.velocity = obstacle::vector_of(values, "velocity"),
                                .pivot = centre,
                                .axis = axis,
                                .spin = values.number("spin")};
  return {{"disc", Stage::project,
           obstacle::RoundObstacle<Real, FlatDisc>(input, {centre, axis, radius - half_height}, half_height,
                                                   motion)}};
}

}  // namespace

namespace effect {
extern const Effect disc{
    .name = "disc",
    .summary = "an obstacle: a round table top with a rounded rim",
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
