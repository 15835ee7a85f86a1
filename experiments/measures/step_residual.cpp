#include <limits>

#include "bendlab/solver/method.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

class StepResidual final : public Measurement {
 public:
  void capture(const Simulation& simulation, const Positions&, std::span<double> values) override {
    values[0] = simulation.step_residual().value_or(std::numeric_limits<double>::quiet_NaN());
  }

  void finish(const RunEnd& end, Findings& findings) override {
    if (end.status == RunStatus::diverged) return;
    if (const std::optional<double> mean = end.frames.mean_of_known("step_residual"))
      findings.summary["step_residual"] = *mean;
  }
};

}  // namespace

namespace measure {
extern const Measure step_residual{
    .name = "step_residual",
    .summary = "what the iterations of a step leave of its forces",
    .cost = "as long as an iteration, for each frame",
    .applies = [](const RunConfig&, const Scene& scene) { return scene.input.method->steps_implicitly; },
    .when = "with newton, quasi_newton and vbd",
    .columns = []() -> std::vector<Column> {
      return {{"step_residual", "1",
               "forces, inertia among them, that the last substep left unbalanced: the sum of their lengths "
               "over vertices, relative to that of the effects' forces; unknown without such forces"}};
    },
    .gives = []() -> std::vector<Quantity> {
      return {{"step_residual", "1",
               "mean over the frames that have it: the share of the forces' impulse that is unbalanced"}};
    },
    .begin = [](const RunConfig&, const Scene&) -> std::unique_ptr<Measurement> {
      return std::make_unique<StepResidual>();
    }};
}  // namespace measure
}  // namespace bendlab
