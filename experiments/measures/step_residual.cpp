#include <limits>

#include "bendlab/solver/method.hpp"
#include "experiments/measures/measure.hpp"

namespace bendlab {
namespace {

class StepResidualMeasurement final : public Measurement {
 public:
  StepResidualMeasurement(const RunConfig&, const BuiltScene&) {}

  void capture(const Simulation& simulation, const Positions&, std::span<double> values) override {
    values[0] = std::numeric_limits<double>::quiet_NaN();
    const std::optional<StepResidual> residual = simulation.step_residual();
    if (!residual) return;
    values[0] = residual->share();
    sum_.unbalanced += residual->unbalanced, sum_.effects += residual->effects;
  }

  void archive(Archive& state) override { state(sum_.unbalanced, sum_.effects); }

  void finish(const RunEnd& end, Findings& findings) override {
    if (end.status != RunStatus::diverged && sum_.effects > 0)
      findings.summary["step_residual"] = sum_.share();
  }

 private:
  StepResidual sum_{0, 0};  // over frames
};

}  // namespace

namespace measure {
extern const Measure step_residual{
    .name = "step_residual",
    .summary = "forces that the iterations of a step leave unbalanced",
    .cost = "the time of one iteration per frame",
    .applies = [](const RunConfig&,
                  const BuiltScene& scene) { return scene.input.method.kind().steps_implicitly; },
    .when = "with newton, quasi_newton and vbd",
    .columns = []() -> std::vector<Column> {
      return {{"step_residual", "1",
               "unbalanced forces (inertia included) after the last substep: the sum of their lengths over "
               "all vertices, divided by the sum of the lengths of the effects' forces (without effects: of "
               "the inertial forces); unknown if no force acts"}};
    },
    .gives = []() -> std::vector<Quantity> {
      return {{"step_residual", "1",
               "sum of the unbalanced forces divided by the sum of the effects' forces (without effects: of "
               "the inertial forces); each sum runs over the last substeps of all frames"}};
    },
    .begin = begun<StepResidualMeasurement>};
}  // namespace measure
}  // namespace bendlab
