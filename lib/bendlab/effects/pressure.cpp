// Pressure on a side of the cloth, along the present normals.
#include <Eigen/Geometry>
#include <array>

#include "bendlab/effects/effects.hpp"
#include "bendlab/effects/named_vertices.hpp"

namespace bendlab {
namespace pressure_effect {

constexpr std::array own_fields = {
    field<&Pressure::pressure>({.name = "pressure",
                                .unit = "Pa",
                                .meaning =
                                    "force per area of the deformed cloth. Above 0: along the normals of "
                                    "the triangles, which point to the side from which the corners run "
                                    "counterclockwise. Below 0: in the opposite direction"}),
};
constexpr auto fields = joined(own_fields, load_fields<Pressure>);

template <class Real>
std::vector<Pass<Real>> compile(const Pressure& settings, const EffectInput& input) {
  check_schedule(settings);
  if (settings.pressure == 0) return {};
  std::vector<std::array<std::size_t, 3>> triangles;
  for (int t = 0; t < input.rest.triangle_count(); ++t) {
    const auto row = input.rest.triangles().row(t);
    triangles.push_back({input.permuted(row(0)), input.permuted(row(1)), input.permuted(row(2))});
  }
  return {{"pressure", Stage::force, [settings, triangles](PassContext<Real>& context) {
             State<Real>& state = context.state;
             const double pressure =
                 settings.pressure *
                 share_of_load(settings, context.time + static_cast<double>(context.substep));
             for (const std::array<std::size_t, 3>& corner : triangles) {
               const auto p = [&](std::size_t c) { return state.position[corner[c]].vector(); };
               // A third of pressure · area · normal, with half of the cross product as area · normal.
               const Vector3Of<Real> impulse =
                   context.substep * static_cast<Real>(pressure / 6) * (p(1) - p(0)).cross(p(2) - p(0));
               for (const std::size_t v : corner)
                 if (state.position[v].w > 0) state.accelerate(v, state.position[v].w * impulse);
             }
             context.acted += triangles.size();
           }}};
}

bool idle(const Pressure& settings) {
  return settings.pressure == 0;
}

bool drives(const Pressure& settings) {
  return !idle(settings);
}

double largest_force(const Pressure& settings, double area) {
  return settings.largest() * std::abs(settings.pressure) * area;
}

}  // namespace pressure_effect

constinit const EffectKind Pressure::kind{
    .name = "pressure",
    .summary = "a pressure on a side of the cloth, along its present normals",
    .source = "force p A n on each triangle, a third on each corner",
    .settings = table_of<Pressure>(pressure_effect::fields),
    .repeatable = true,
    .uses_sides = true,
    .force_follows_pose = true,
    .compile_float = erased<pressure_effect::compile<float>>,
    .compile_double = erased<pressure_effect::compile<double>>,
    .idle = erased<pressure_effect::idle>,
    .drives = erased<pressure_effect::drives>,
    .largest_force = erased<pressure_effect::largest_force>,
};
}  // namespace bendlab
