// Equal warnings of many runs are printed once, for the worst run and with the range of all runs.
#include "experiments/cli/collected_texts.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "experiments/cli/report.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::collected_texts_test {
namespace {

using Catch::Matchers::ContainsSubstring;

Experiment sweep_of_cells(const std::string& more = "") {
  return parse_experiment(R"({"name": "told", "sweep": {"/mesh/cells": [4, 8, 16]})" + more + "}", "test");
}

std::vector<CampaignRun> runs_of(const Experiment& experiment) {
  std::vector<CampaignRun> runs;
  for (const RunConfig& config : experiment.runs)
    runs.push_back(
        {.experiment = &experiment, .config = &config, .outcome = RunOutcome{.status = RunStatus::complete}});
  return runs;
}

}  // namespace

TEST_CASE("a warning of several runs is printed for the worst run, with the range", "[warnings]") {
  const Experiment experiment = sweep_of_cells();
  std::vector<CampaignRun> runs = runs_of(experiment);
  runs[0].outcome->warnings = {{"soft_solver", "has 48 %", -0.48, "48 %"}, {"inert_seed", "a seed"}};
  runs[1].outcome->warnings = {{"soft_solver", "has 3 %", -0.03, "3 %"}};
  runs[2].outcome->warnings = {{"soft_solver", "has 20 %", -0.2, "20 %"}, {"inert_seed", "a seed"}};
  const std::vector<CollectedText> texts = collected_warnings(runs);
  REQUIRE(texts.size() == 2);
  CHECK(texts[0].kind == "soft_solver");
  CHECK(text_of(texts[0]) == "cells 8: has 3 % (the worst of 3 runs: 3 % to 48 %)");
  CHECK(text_of(texts[1]) == "cells 4: a seed (and 1 more run)");
}

TEST_CASE("a warning of runs that are equally bad has no range", "[warnings]") {
  const Experiment experiment = sweep_of_cells();
  std::vector<CampaignRun> runs = runs_of(experiment);
  for (CampaignRun& run : runs) run.outcome->warnings = {{"lagging", "is behind", 3, "3 times"}};
  CHECK(text_of(collected_warnings(runs).at(0)) == "cells 4: is behind (and 2 more runs: 3 times)");
}

TEST_CASE("each broken bound is printed once, for a value that is not finite first", "[plausibility]") {
  const Experiment experiment = sweep_of_cells();
  std::vector<CampaignRun> runs = runs_of(experiment);
  const auto stretched = [](double measured) {
    return BrokenBound{.bound = Bound::stretch, .measured = measured, .limit = 2, .time = 1, .vertex = 5};
  };
  runs[0].outcome->broken = stretched(3);
  runs[1].outcome->broken = stretched(390);
  runs[2].outcome->broken = stretched(NAN);
  std::vector<CollectedText> texts = collected_bounds(runs);
  REQUIRE(texts.size() == 1);
  CHECK(texts[0].place == "cells 16");
  CHECK_THAT(text_of(texts[0]), ContainsSubstring("(the worst of 3 runs: not finite to 3)"));
  runs[2].outcome->broken =
      BrokenBound{.bound = Bound::speed, .measured = 8, .limit = 4, .time = 1, .vertex = 5};
  texts = collected_bounds(runs);
  REQUIRE(texts.size() == 2);
  CHECK_THAT(text_of(texts[0]), ContainsSubstring("cells 8: at t = 1 s") &&
                                    ContainsSubstring("(the worst of 2 runs: 390 to 3)"));
  CHECK_THAT(text_of(texts[1]), ContainsSubstring("cells 16: at t = 1 s"));
}

TEST_CASE("a table has columns for the metrics of expectations and for the requested measures",
          "[command line]") {
  const Experiment experiment = sweep_of_cells(
      R"(, "output": {"measures": ["drape"]},
         "expect": [{"metric": "worst_stretch", "max": 2, "why": "x"}])");
  std::vector<CampaignRun> runs = runs_of(experiment);
  for (CampaignRun& run : runs)
    run.outcome->summary = {{"drop", 1},
                            {"worst_stretch", 1.25},
                            {"drape_coefficient", 0.625},
                            {"effective_bending_stiffness", 0}};
  const std::string table = run_table(runs), measures = measure_tables(runs);
  CHECK_THAT(table, ContainsSubstring("worst_stretch") && ContainsSubstring("1.25"));
  CHECK_THAT(table, ContainsSubstring("effective_bending_stiffness") && ContainsSubstring("< 0.01"));
  CHECK_THAT(measures, ContainsSubstring("drape: ") && ContainsSubstring("cells  coefficient") &&
                           ContainsSubstring("0.625") && !ContainsSubstring("folds"));
  for (CampaignRun& run : runs) run.outcome->summary.erase("drape_coefficient");
  CHECK(measure_tables(runs).empty());
}

}  // namespace bendlab::collected_texts_test
