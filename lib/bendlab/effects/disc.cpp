// Disc: a round table top. The table top consists of all points whose distance from a flat disc is at most
// half the table top's height. So the profile of the rim is half a circle, and the cloth meets no sharp edge.
// The radius of the flat disc is the radius of the table top minus half the height.
#include "bendlab/effects/revolved.hpp"
#include "bendlab/effects/round_obstacle.hpp"

namespace bendlab {
namespace disc_effect {

template <class Real>
struct FlatDisc {
  Vector3Of<Real> centre, axis;
  Real radius;
  std::array<Vector3Of<Real>, 0> tips{};  // no tips: the cloth's edges meet the rim before its triangles

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

constexpr std::array own_fields = {
    field<&Disc::centre>({.name = "centre",
                          .unit = "m",
                          .meaning = "centre of the table top, half its height below the surface"}),
    field<&Disc::axis>(
        {.name = "axis", .unit = "1", .meaning = "axis of the disc and of its spin; any length except zero"}),
    field<&Disc::radius>({.name = "radius",
                          .unit = "m",
                          .meaning = "radius of the table top, rim included",
                          .minimum = 0,
                          .above = true}),
    field<&Disc::height>({.name = "height",
                          .unit = "m",
                          .meaning = "height of the table top, at most twice the radius; the rim's profile "
                                     "is half a circle",
                          .minimum = 0,
                          .above = true}),
};

constexpr auto fields = joined(own_fields, obstacle::body_fields<Disc>, obstacle::spin_fields<Disc>);

SteadyMotion motion(const Disc& settings) {
  return {.velocity = settings.velocity,
          .pivot = settings.centre,
          .axis = obstacle::direction_of(settings.axis, "axis"),
          .spin = settings.spin};
}

template <class Real>
std::vector<Pass<Real>> compile(const Disc& settings, const EffectInput& input) {
  const SteadyMotion steady = motion(settings);
  const double half_height = settings.height / 2;
  if (half_height > settings.radius)
    throw std::invalid_argument(
        "height is more than twice the radius; reduce height, or use a capsule for a body that is taller "
        "than wide");
  return {{"disc", Stage::project,
           obstacle::RoundObstacle<Real, FlatDisc>(
               settings, input, {settings.centre, steady.axis, settings.radius - half_height}, half_height,
               steady)}};
}

// A flat top and bottom, and a rim whose profile is half a circle.
TriangleMesh surface(const Disc& settings, const SurfaceInput&) {
  const double half_height = settings.height / 2, flat = settings.radius - half_height;
  std::vector<ProfilePoint> profile = {{0, -half_height}};
  for (const auto& [distance, height] : arc(half_height, -1, 1)) profile.push_back({flat + distance, height});
  profile.push_back({0, half_height});
  return revolved(profile, settings.centre, obstacle::direction_of(settings.axis, "axis"));
}

}  // namespace disc_effect

constinit const EffectKind Disc::kind{
    .name = "disc",
    .summary = "an obstacle: a round table top with a rounded rim",
    .source =
        "Müller et al. 2007, §3.4 (collision constraints, projected as inequalities); for edges Kelley 1960 "
        "(cutting planes)",
    .settings = table_of<Disc>(disc_effect::fields),
    .needs_projection = true,
    .acts_in_iterations = true,
    .repeatable = true,
    .compile_float = erased<disc_effect::compile<float>>,
    .compile_double = erased<disc_effect::compile<double>>,
    .motion = erased<disc_effect::motion>,
    .surface = erased<disc_effect::surface>,
};
}  // namespace bendlab
