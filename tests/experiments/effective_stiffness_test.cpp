// The effective stiffness of the solver in the summary and the warnings of a run.
#include "experiments/measures/effective_stiffness.hpp"

#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::experiments_effective_stiffness_test {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

namespace {

// Hinges that all have the share `share`.
EffectiveStiffness of_share(double share) {
  EffectiveStiffness stiffness;
  stiffness.hinges = {.applied = share, .stated = 1, .spent = share * share, .measured = 1, .rounding = 0};
  return stiffness;
}

}  // namespace

TEST_CASE("a summary has the share, and if it is below a half also the substeps that would raise it",
          "[effective stiffness]") {
  CHECK(effective_stiffness_summary({}, 10).empty());
  const auto half = effective_stiffness_summary(of_share(0.6), 10);
  CHECK(half.size() == 1);
  CHECK_THAT(half.at("effective_bending_stiffness"), WithinRel(0.6, 1e-12));
  const auto soft = effective_stiffness_summary(of_share(0.04), 16);
  CHECK(soft.size() == 2);
  // 1 / share - 1 falls from 24 to 1/9 at least like (16 / N)^1.5. This gives N = 576, rounded to 600.
  CHECK(soft.at("substeps_for_90_percent_bending") == 600);
}

TEST_CASE("substeps for 90 % grow as the share falls, and equal the present number if the share is 90 %",
          "[effective stiffness]") {
  CHECK(substeps_for_90_percent(0.95, 7) == 7);
  double last = 0;
  for (const double share : {0.9, 0.5, 0.2, 0.05, 0.01}) {
    CHECK(substeps_for_90_percent(share, 4) >= last);
    last = substeps_for_90_percent(share, 4);
  }
  CHECK(last > 100);
}

TEST_CASE("a soft membrane gives a warning only if it stretches", "[effective stiffness]") {
  std::map<std::string, double> summary = {{"effective_membrane_stiffness", 0.2},
                                           {"substeps_for_90_percent_membrane", 80},
                                           {"mean_strain", 0.005}};
  CHECK_FALSE(soft_solver_warning(summary));
  summary["mean_strain"] = 0.02;
  REQUIRE(soft_solver_warning(summary));
  CHECK_THAT(soft_solver_warning(summary)->message, ContainsSubstring("20 % of the membrane stiffness"));
  summary.erase("mean_strain");  // unknown
  CHECK(soft_solver_warning(summary));
}

TEST_CASE("a run that is less than half as stiff as stated gets a warning with share and substeps",
          "[effective stiffness]") {
  CHECK(!soft_solver_warning({}));
  CHECK(!soft_solver_warning(effective_stiffness_summary(of_share(0.51), 10)));
  const auto soft = soft_solver_warning(effective_stiffness_summary(of_share(0.04), 16));
  REQUIRE(soft);
  CHECK_THAT(soft->message,
             ContainsSubstring("4 % of the bending stiffness") && ContainsSubstring("600 substeps"));
  CHECK_THAT(soft->share, WithinRel(0.04, 1e-12));
  CHECK(share_text(soft->share) == "4 %");
}

TEST_CASE("the warning states that an estimate is too small to be reliable", "[effective stiffness]") {
  const auto soft = soft_solver_warning(effective_stiffness_summary(of_share(0), 16));
  REQUIRE(soft);
  CHECK_THAT(soft->message,
             ContainsSubstring("less than 1 % of the bending stiffness") && ContainsSubstring("too small"));
  CHECK(share_text(0) == "< 1 %");
  CHECK(share_text(0.0099) == "< 1 %");
  CHECK(share_text(0.01) == "1 %");
}

// Coarse levels reduce stretch besides the constraints, but do not act on bending. The strip's H/W is the
// same without them, so the share of its rigidity is the same, too.
TEST_CASE("with coarse levels the share of bending is known, but not the share of the membrane",
          "[effective stiffness]") {
  test::Workplace place;
  place.write("strip.json",
              R"({"name": "strip", "duration": 2, "pins": {"vertices": ["left"], "distance": 0.03},
    "mesh": {"generator": "equilateral", "rows": "perpendicular", "width": 0.5, "height": 0.25, "cells": 24},
    "bending": {"model": "discrete_shells", "flexural_rigidity": 0.005}, "solver": {"method": "pbd"},
    "effects": [{"type": "gravity"}, {"type": "viscous_drag", "coefficient": 2}],
    "sweep": {"/solver/levels": [0, 12]}})");
  REQUIRE(place.run("run strip.json --json") == 0);
  const auto runs = place.out_lines();
  REQUIRE(runs.size() == 2);
  const auto &alone = runs[0].at("summary"), &with_levels = runs[1].at("summary");
  CHECK(alone.contains("effective_membrane_stiffness"));
  CHECK_FALSE(with_levels.contains("effective_membrane_stiffness"));
  const double share = alone.at("effective_bending_stiffness");
  CHECK(share < 0.5);
  constexpr double of_the_estimate = 0.21;  // effective_stiffness.hpp
  CHECK_THAT(with_levels.at("effective_bending_stiffness").get<double>(), WithinRel(share, of_the_estimate));
}

}  // namespace bendlab::experiments_effective_stiffness_test
