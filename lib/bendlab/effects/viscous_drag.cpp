// Viscous drag: a force against the velocity of every free vertex, in proportion to the vertex's area.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "bendlab/constraints/build.hpp"
#include "bendlab/effects/effects.hpp"

namespace bendlab {
namespace viscous_drag_effect {

constexpr std::array fields = {
    field<&ViscousDrag::coefficient>(
        {.name = "coefficient",
         .unit = "N s/m³",
         .meaning = "c: the force on a vertex is -c A v, where A is a third of the rest area of the vertex's "
                    "triangles. The final speed of a free falling sheet of ρ kg/m² is ρ g/c; with pbd and "
                    "substeps of h it is smaller by g h/2",
         .minimum = 0}),
};

// Without other forces, v' = -(c A / m) v has the solution v exp(-c A h / m), which reverses no velocity,
// even if h is large. Gravity acts before the drag, once per substep. So a falling sheet reaches the final
// speed g h / (exp(k h) - 1) with k = c A / m, which is smaller than g / k by the fraction k h / 2.
template <class Real>
std::vector<Pass<Real>> compile(const ViscousDrag& settings, const EffectInput& input) {
  if (settings.coefficient == 0) return {};
  // c A in kg/s is the lumped mass of a cloth of density c.
  const std::vector<double> listed = lumped_masses(input.rest, settings.coefficient);
  std::vector<double> drag(listed.size());
  for (int v = 0; v < input.rest.vertex_count(); ++v)
    drag[input.permuted(v)] = listed[static_cast<std::size_t>(v)];
  std::vector<Real> drag_at(drag.size());
  std::ranges::transform(drag, drag_at.begin(), [](double kg_per_s) { return static_cast<Real>(kg_per_s); });
  return {{"viscous_drag", Stage::damp,
           [drag_at = std::move(drag_at), lost = std::vector<Real>(),
            of_substep = Real(0)](PassContext<Real>& context) mutable {
             State<Real>& state = context.state;
             if (std::exchange(of_substep, context.substep) != context.substep) {  // substeps seldom change
               lost.resize(drag_at.size());
               for (std::size_t v = 0; v < lost.size(); ++v)
                 lost[v] = std::expm1(-drag_at[v] * state.position[v].w * context.substep);
             }
             for (std::size_t v = 0; v < lost.size(); ++v)
               state.accelerate(v, lost[v] * state.velocity[v].vector());
             context.acted += drag_at.size();
           },
           nullptr, std::move(drag)}};
}

bool idle(const ViscousDrag& settings) {
  return settings.coefficient == 0;
}

}  // namespace viscous_drag_effect

constinit const EffectKind ViscousDrag::kind{
    .name = "viscous_drag",
    .summary = "drag of a viscous medium at rest on every free vertex, in proportion to velocity and area",
    .source = "Stokes' law for a surface, F = -c A v; exact over a substep without other forces",
    .settings = table_of<ViscousDrag>(viscous_drag_effect::fields),
    .damps = true,
    .compile_float = erased<viscous_drag_effect::compile<float>>,
    .compile_double = erased<viscous_drag_effect::compile<double>>,
    .idle = erased<viscous_drag_effect::idle>,
};
}  // namespace bendlab
