// Plane: a half space that the cloth does not enter.
#include "bendlab/effects/obstacle.hpp"

namespace bendlab {
namespace plane_effect {

constexpr std::array own_fields = {
    field<&Plane::point>(
        {.name = "point", .unit = "m", .meaning = "a point of the plane and of the axis of the spin"}),
    field<&Plane::normal>(
        {.name = "normal", .unit = "1", .meaning = "points to the cloth's side; any length except zero"}),
};

constexpr auto fields = joined(own_fields, obstacle::body_fields<Plane>, obstacle::spin_fields<Plane>);

SteadyMotion motion(const Plane& settings) {
  return {.velocity = settings.velocity,
          .pivot = settings.point,
          .axis = obstacle::direction_of(settings.normal, "normal"),
          .spin = settings.spin};
}

template <class Real>
std::vector<Pass<Real>> compile(const Plane& settings, const EffectInput& input) {
  return {{"plane", Stage::project,
           [motion = motion(settings), thickness = settings.thickness,
            used = input.contacts_used](PassContext<Real>& context) {
             const obstacle::Step<Real> step(motion, context);
             const Vector3Of<Real> normal = motion.axis.template cast<Real>();
             const auto level = static_cast<Real>(motion.axis.dot(motion.pivot + step.shift()) + thickness);
             const Points<Real>& points = context.state.position;
             for (std::size_t v = 0; v < static_cast<std::size_t>(context.state.vertex_count); ++v)
               if (const Real depth = level - normal.dot(points[v].vector()); depth > 0 && points[v].w > 0)
                 obstacle::push(context, step, v, normal, depth, used);
           }}};
}

// A square in the plane, because the plane itself is infinite.
TriangleMesh surface(const Plane& settings, const SurfaceInput& input) {
  constexpr double side = 4;  // relative to the cloth's size
  const Vector3 normal = obstacle::direction_of(settings.normal, "normal");
  const Vector3 right = normal.unitOrthogonal(), forward = normal.cross(right),
                middle = input.centre - normal.dot(input.centre - settings.point) * normal;
  const double half = side * input.size / 2;
  TriangleMesh mesh{Positions(4, 3), Triangles(2, 3), {}};
  mesh.positions << (middle - half * (right + forward)).transpose(),
      (middle + half * (right - forward)).transpose(), (middle + half * (right + forward)).transpose(),
      (middle + half * (forward - right)).transpose();
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

}  // namespace plane_effect

constinit const EffectKind Plane::kind{
    .name = "plane",
    .summary = "an obstacle: a half space that the cloth does not enter",
    .source = "Müller et al. 2007, §3.4 (static collision constraint, projected as an inequality)",
    .settings = table_of<Plane>(plane_effect::fields),
    .needs_projection = true,
    .acts_in_iterations = true,
    .repeatable = true,
    .compile_float = erased<plane_effect::compile<float>>,
    .compile_double = erased<plane_effect::compile<double>>,
    .motion = erased<plane_effect::motion>,
    .surface = erased<plane_effect::surface>,
};
}  // namespace bendlab
