// Constraint damping: removes part of the rate of change of every constraint from the velocities.
#include <array>
#include <cmath>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/oracle.hpp"
#include "bendlab/effects/effects.hpp"

namespace bendlab {
namespace constraint_damping_effect {

constexpr std::array fields = {
    field<&ConstraintDamping::rate>(
        {.name = "rate",
         .unit = "1/s",
         .meaning =
             "γ: the fraction 1 - exp(-γ h) of each constraint's rate of change is removed per substep",
         .minimum = 0}),
};

template <class Real, class Batch>
void damp_any(const Point<Real>* points, Point<Real>* velocities, const Batch& batch, Real k) {
  batch.order.conflict_free ? damp(points, velocities, batch, k)
                            : damp_by_oracle(points, velocities, batch, k);
}

template <class Real>
std::vector<Pass<Real>> compile(const ConstraintDamping& settings, const EffectInput&) {
  return {{"constraint_damping", Stage::velocity, [rate = settings.rate](PassContext<Real>& context) {
             const auto k = static_cast<Real>(-std::expm1(-rate * static_cast<double>(context.substep)));
             const Point<Real>* const points = context.state.position.data();
             Point<Real>* const velocities = context.state.velocity.data();
             context.constraints.for_each([&](const auto& batch) {
               damp_any(points, velocities, batch, k);
               if (k > 0) context.acted += batch.count;
             });
             damp_by_oracle(points, velocities, context.constraints.own, k);
             if (k > 0) context.acted += context.constraints.own.count;
           }}};
}

bool idle(const ConstraintDamping& settings) {
  return settings.rate == 0;
}

}  // namespace constraint_damping_effect

constinit const EffectKind ConstraintDamping::kind{
    .name = "constraint_damping",
    .summary = "damps the rate of change of every constraint; preserves linear and angular momentum",
    .source = "Müller et al. 2014, eq. 23; for unequal masses changed so that it dissipates energy",
    .settings = table_of<ConstraintDamping>(constraint_damping_effect::fields),
    .needs_projection = true,
    .keeps_momentum = true,
    .keeps_angular_momentum = true,
    .damps = true,
    .compile_float = erased<constraint_damping_effect::compile<float>>,
    .compile_double = erased<constraint_damping_effect::compile<double>>,
    .idle = erased<constraint_damping_effect::idle>,
};
}  // namespace bendlab
