// Constraint damping: removes part of the rate of change of every constraint from the velocities.
#include <array>
#include <cmath>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/constraints/oracle.hpp"
#include "bendlab/effects/effect.hpp"

namespace bendlab {
namespace {

constexpr std::array parameters = {
    Parameter{
        .name = "rate",
        .type = ParameterType::number,
        .unit = "1/s",
        .default_value = 1.0,
        .meaning = "γ: the fraction 1 - exp(-γ h) of each constraint's rate of change is removed per substep",
        .minimum = 0},
};

template <class Real, class Batch>
void damp_any(const Point<Real>* points, Point<Real>* velocities, const Batch& batch, Real k) {
  batch.order.conflict_free ? damp(points, velocities, batch, k)
                            : damp_by_oracle(points, velocities, batch, k);
}

template <class Real>
std::vector<Pass<Real>> compile(const EffectInput& input) {
  const double rate = input.parameters.number("rate");
  return {{"constraint_damping", Stage::velocity, [rate](PassContext<Real>& context) {
             const auto k = static_cast<Real>(-std::expm1(-rate * static_cast<double>(context.substep)));
             const Point<Real>* const points = context.state.position.data();
             Point<Real>* const velocities = context.state.velocity.data();
             context.constraints.for_each([&](const auto& batch) {
               damp_any(points, velocities, batch, k);
               if (k > 0) context.acted += batch.count;
             });
           }}};
}

}  // namespace

namespace effect {
extern const Effect constraint_damping{
    .name = "constraint_damping",
    .summary = "damps the rate of change of every constraint; keeps both momenta",
    .source = "Müller et al. 2014, eq. 23 (the same for equal masses; dissipates for any masses)",
    .parameters = parameters,
    .needs_projection = true,
    .compile_float = compile<float>,
    .compile_double = compile<double>,
    .idle = [](const ParameterValues& values) { return values.number("rate") == 0; },
};
}  // namespace effect
}  // namespace bendlab
