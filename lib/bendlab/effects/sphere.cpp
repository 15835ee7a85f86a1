// Sphere: a ball that the cloth does not enter.
#include "bendlab/effects/revolved.hpp"
#include "bendlab/effects/round_obstacle.hpp"

namespace bendlab {
namespace sphere_effect {

// The core of a ball (round_obstacle.hpp) is its centre.
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

constexpr std::array own_fields = {
    field<&Sphere::centre>({.name = "centre", .unit = "m", .meaning = "centre of the ball"}),
    field<&Sphere::radius>(
        {.name = "radius", .unit = "m", .meaning = "radius of the ball", .minimum = 0, .above = true}),
    field<&Sphere::axis>(
        {.name = "axis", .unit = "1", .meaning = "axis of the spin; any length except zero"}),
};

constexpr auto fields = joined(own_fields, obstacle::body_fields<Sphere>, obstacle::spin_fields<Sphere>);

SteadyMotion motion(const Sphere& settings) {
  return {.velocity = settings.velocity,
          .pivot = settings.centre,
          .axis = obstacle::direction_of(settings.axis, "axis"),
          .spin = settings.spin};
}

template <class Real>
std::vector<Pass<Real>> compile(const Sphere& settings, const EffectInput& input) {
  return {{"sphere", Stage::project,
           obstacle::RoundObstacle<Real, Centre>(settings, input, {settings.centre}, settings.radius,
                                                 motion(settings))}};
}

TriangleMesh surface(const Sphere& settings, const SurfaceInput&) {
  return revolved(arc(settings.radius, -1, 1), settings.centre, Vector3::UnitZ());
}

}  // namespace sphere_effect

constinit const EffectKind Sphere::kind{
    .name = "sphere",
    .summary = "an obstacle: a ball that the cloth does not enter",
    .source =
        "Müller et al. 2007, §3.4 (collision constraints, projected as inequalities); for edges Kelley 1960 "
        "(cutting planes)",
    .settings = table_of<Sphere>(sphere_effect::fields),
    .needs_projection = true,
    .acts_in_iterations = true,
    .repeatable = true,
    .compile_float = erased<sphere_effect::compile<float>>,
    .compile_double = erased<sphere_effect::compile<double>>,
    .motion = erased<sphere_effect::motion>,
    .surface = erased<sphere_effect::surface>,
};
}  // namespace bendlab
