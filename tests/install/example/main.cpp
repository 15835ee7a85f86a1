// The bendlab program with the additions of mine.hpp.
#include "experiments/campaign/campaign.hpp"
#include "experiments/cli/command_line.hpp"
#include "mine.hpp"

using namespace bendlab;

int main(int argc, char** argv) {
  register_bending_model(EdgeHinge::kind);
  register_effect(Trap::kind);
  register_method(SymplecticEuler::kind);
  register_measure(height);
  if (argc > 1) return command_line(argc, argv);  // run, plan, models, schema, advise, …

  const std::vector<Experiment> experiments = {load_experiment("sweep.json")};
  std::vector<CampaignRun> runs = plan_campaign(experiments);
  run_campaign(runs, {.out = "results"}, [&](std::size_t i) {
    if (runs[i].outcome) std::printf("%zu: height %.9f m\n", i, runs[i].outcome->summary["height"]);
  });
  return campaign_exit_code(runs);
}
