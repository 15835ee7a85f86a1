// bendlab with a bending model and a measure of our own.
#include <cmath>

#include "bendlab/bending/rest_hinges.hpp"
#include "experiments/campaign/campaign.hpp"
#include "experiments/cli/command_line.hpp"
#include "experiments/measures/measure.hpp"

using namespace bendlab;

struct EdgeHinge {
  double power = 1;
  static const BendingKind kind;
};

constexpr std::array fields = {
    field<&EdgeHinge::power>({.name = "power", .unit = "1", .meaning = "p of ½ k |e|^p θ²", .minimum = 0})};

BendingConstraints build(const EdgeHinge& settings, const BendingInput& input) {
  BendingConstraints constraints;
  std::get<ElementList<HingeAngle>>(constraints.elements) =
      angle_constraints(rest_hinges(input.rest, input.pins), HingeAngle::Law::angle,
                        [&](const RestHinge& hinge) { return std::pow(hinge.edge, -settings.power); });
  return constraints;
}

const BendingKind EdgeHinge::kind{
    .name = "edge_hinge",
    .label = "edge hinge",
    .summary = "the fold angle at every interior edge, as stiff as a power of the edge's length",
    .settings = table_of<EdgeHinge>(fields),
    .build = erased<build>};

struct Height final : Measurement {
  void finish(const RunEnd& end, Findings& findings) override {
    findings.summary["height"] = end.simulation.positions().col(2).mean();
  }
};

const Measure height{
    .name = "height",
    .summary = "where the cloth is at the end",
    .cost = "nothing",
    .gives = []() -> std::vector<Quantity> {
      return {{"height", "m", "mean z of the vertices"}};
    },
    .begin = [](auto&, auto&) -> std::unique_ptr<Measurement> { return std::make_unique<Height>(); }};

int main(int argc, char** argv) {
  register_bending_model(EdgeHinge::kind);
  register_measure(height);
  if (argc > 1) return command_line(argc, argv);  // the whole program: run, plan, models, schema, advise, …

  const std::vector<Experiment> experiments = {load_experiment("sweep.json")};
  std::vector<CampaignRun> runs = plan_campaign(experiments);
  run_campaign(runs, {.out = "results"}, [&](std::size_t i) {
    if (runs[i].outcome) std::printf("%zu: height %.9f m\n", i, runs[i].outcome->summary["height"]);
  });
  return campaign_exit_code(runs);
}
