// Capsule: all points within a radius of a segment, which the cloth does not enter.
#include "bendlab/effects/revolved.hpp"
#include "bendlab/effects/round_obstacle.hpp"

namespace bendlab {
namespace capsule_effect {

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

constexpr std::array own_fields = {
    field<&Capsule::a>({.name = "a",
                        .unit = "m",
                        .meaning = "one end of the segment; the axis of the spin points from a to b"}),
    field<&Capsule::b>({.name = "b", .unit = "m", .meaning = "the other end of the segment"}),
    field<&Capsule::radius>({.name = "radius",
                             .unit = "m",
                             .meaning = "the capsule consists of all points within this distance of the "
                                        "segment",
                             .minimum = 0,
                             .above = true}),
};

constexpr auto fields = joined(own_fields, obstacle::body_fields<Capsule>, obstacle::spin_fields<Capsule>);

SteadyMotion motion(const Capsule& settings) {
  return {.velocity = settings.velocity,
          .pivot = settings.a,
          .axis = (settings.b - settings.a).normalized(),
          .spin = settings.spin};
}

template <class Real>
std::vector<Pass<Real>> compile(const Capsule& settings, const EffectInput& input) {
  const Vector3 &a = settings.a, &b = settings.b;
  if (!((b - a).norm() > 0))
    throw std::invalid_argument(
        "a and b are the same point, so the capsule has no length; use a sphere instead");
  return {
      {"capsule", Stage::project,
       obstacle::RoundObstacle<Real, Segment>(settings, input, {a, b}, settings.radius, motion(settings))}};
}

TriangleMesh surface(const Capsule& settings, const SurfaceInput&) {
  const Vector3 along = settings.b - settings.a;
  std::vector<ProfilePoint> profile = arc(settings.radius, -1, 0);
  for (const auto& [distance, height] : arc(settings.radius, 0, 1))
    profile.push_back({distance, height + along.norm()});
  return revolved(profile, settings.a, along.normalized());
}

}  // namespace capsule_effect

constinit const EffectKind Capsule::kind{
    .name = "capsule",
    .summary = "an obstacle: all points within a radius of a segment",
    .source =
        "Müller et al. 2007, §3.4 (collision constraints, projected as inequalities); for edges Kelley 1960 "
        "(cutting planes)",
    .settings = table_of<Capsule>(capsule_effect::fields),
    .needs_projection = true,
    .acts_in_iterations = true,
    .repeatable = true,
    .compile_float = erased<capsule_effect::compile<float>>,
    .compile_double = erased<capsule_effect::compile<double>>,
    .motion = erased<capsule_effect::motion>,
    .surface = erased<capsule_effect::surface>,
};
}  // namespace bendlab
