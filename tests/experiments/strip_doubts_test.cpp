// How the stiffness of a strip is measured, and when the measurement is doubtful.
#include <cmath>
#include <string>

#include "experiments/config/experiment.hpp"
#include "experiments/measures/strip_doubts.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::strip_doubts_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;
using nlohmann::json;
using test::Workplace;

constexpr double rigidity = 2e-5;  // N m

// A strip of 0.11 m that hangs at rest from its left side, with H/W = 6 (Γ = 98).
std::string hanging(const std::string& mesh, const std::string& more = "") {
  return R"({"name": "strip", "mesh": {"generator": "equilateral", "width": 0.12, "height": 0.05, )" + mesh +
         R"(}, "pins": {"vertices": ["left"], "distance": 0.01},
    "material": {"density": 0.15, "strain": {"stiffness": "compliance", "compliance": 1e-4}},
    "bending": {"model": "dihedral", "flexural_rigidity": 2e-5}, "effects": [{"type": "gravity"}],
    "solver": {"method": "equilibrium"}, "output": {"measures": ["stiffness"]})" +
         more + "}";
}

std::string rows_of(const std::string& mesh, const std::string& pins) {
  const Experiment experiment = parse_experiment(R"({"name": "rows", "mesh": {"generator": "equilateral", )" +
                                                     mesh + R"(}, "pins": {"vertices": )" + pins + "}}",
                                                 "rows");
  return experiment.runs.at(0).resolved().at("mesh").at("rows").get<std::string>();
}

bool warned_of(const json& run, const std::string& code) {
  for (const json& warning : run.at("warnings"))
    if (warning.at("code") == code) return true;
  return false;
}

TEST_CASE("By default the rows of a lattice lie along the pinned sides", "[strip]") {
  // Rows are straight, and the sides across the rows zigzag.
  CHECK(rows_of(R"("width": 2, "height": 1)", R"(["left"])") == "perpendicular");
  CHECK(rows_of(R"("width": 1, "height": 2)", R"(["left", "right"])") == "parallel");
  CHECK(rows_of(R"("width": 2, "height": 1)", R"(["top"])") == "parallel");
  CHECK(rows_of(R"("width": 1, "height": 2)", R"(["bottom"])") == "perpendicular");
  CHECK(rows_of(R"("height": 1)", R"(["right"])") == "perpendicular");  // the width is 1
  // Without a pinned side, or with two adjacent pinned sides, the rows have their usual default.
  CHECK(rows_of(R"("width": 2, "height": 1)", R"(["upper_left"])") == "parallel");
  CHECK(rows_of(R"("width": 2, "height": 1)", R"(["left", "top"])") == "parallel");
  // A direction that the config states is kept.
  CHECK(rows_of(R"("width": 2, "height": 1, "rows": "parallel")", R"(["left"])") == "parallel");
}

TEST_CASE("Both measurements of a lattice strip give the stated rigidity", "[strip]") {
  Workplace here;
  here.write("strip.json", hanging(R"("cells": 12)", R"(, "sweep": {"/mesh/cells": [12, 24]})"));
  REQUIRE(here.run("run strip.json --json") == 0);
  for (const json& run : here.out_lines()) {
    INFO(run);
    const json& summary = run.at("summary");
    // An edge is a twelfth of the strip, and the strip turns downwards within a seventh. This causes an error
    // of a few percent.
    CHECK_THAT(summary.at("stiffness_flexural_rigidity").get<double>(), WithinRel(rigidity, 0.06));
    CHECK_THAT(summary.at("stiffness_fit_B").get<double>(), WithinRel(rigidity, 0.06));
    CHECK_FALSE(warned_of(run, "doubtful_stiffness"));
  }
}

TEST_CASE("A strip behind a zigzag clamp gets a warning and cannot be a reference", "[strip]") {
  Workplace here;
  here.write("strip.json", hanging(R"("cells": 12, "rows": "parallel")"));
  REQUIRE(here.run("run strip.json --json") == 0);
  const json run = here.out_lines().at(0), &summary = run.at("summary");
  // The moments do not depend on the clamp. But a vertex beside the clamp is joined to three pinned vertices.
  // So the strip is stiff there and hangs like a stiffer strip.
  CHECK_THAT(summary.at("stiffness_fit_B").get<double>(), WithinRel(rigidity, 0.06));
  CHECK(summary.at("stiffness_flexural_rigidity").get<double>() > 1.2 * rigidity);
  CHECK(warned_of(run, "doubtful_stiffness"));
  CHECK_THAT(run.at("warnings").dump(), ContainsSubstring("zigzags") && ContainsSubstring("/mesh/rows"));

  here.write(
      "error.json",
      hanging(R"("cells": 12, "rows": "parallel")",
              R"(, "accuracy": {"physical": ["/mesh/cells=24"], "solver": ["/output/constraints=true"]})"));
  REQUIRE(here.run("run error.json --json") == 0);
  const json compared = here.out_lines().at(0);
  CHECK_FALSE(compared.at("summary").contains("error_physical_rms"));
  CHECK(compared.at("summary").contains("error_solver_rms"));  // the solver's error is valid on any mesh
  CHECK_THAT(compared.at("message").get<std::string>(), ContainsSubstring("cannot serve"));

  here.write("error.json", hanging(R"("cells": 12)", R"(, "accuracy": {"physical": ["/mesh/cells=24"]})"));
  REQUIRE(here.run("run error.json --json") == 0);
  CHECK(here.out_lines().at(0).at("summary").contains("error_physical_rms"));
}

TEST_CASE("A strip that cannot show its stiffness gets a warning that recommends a better strip", "[strip]") {
  Workplace here;
  const auto strip = [&](const std::string& width, const std::string& b, const std::string& cells,
                         const std::string& precision) {
    here.write("strip.json", R"({"name": "strip", "duration": 0.05,
        "mesh": {"generator": "grid", "width": )" +
                                 width + R"(, "height": 0.03, "cells": )" + cells +
                                 R"(}, "pins": {"vertices": ["left"], "ring": 1},
        "material": {"density": 0.2, "strain": {"stiffness": "compliance", "compliance": 1e-4}},
        "bending": {"flexural_rigidity": )" +
                                 b + R"(},
        "effects": [{"type": "gravity"}], "solver": {"precision": ")" +
                                 precision + R"("}, "output": {"measures": ["stiffness"]}})");
    REQUIRE(here.run("validate strip.json") == 0);
    return here.out() + here.err();
  };
  // Too soft: the strip turns downwards within √(2 B / ρ g L) = 0.6 mm of the clamp, but an edge is 2.5 mm
  // long.
  const std::string soft = strip("0.3", "1e-7", "120", "auto");
  CHECK_THAT(soft, ContainsSubstring("strip_out_of_range") && ContainsSubstring("too soft"));
  // Too stiff: Γ = ρ g L³ / B = 1.6e-5, so the strip drops by only 2e-6 of its length.
  CHECK_THAT(strip("0.02", "1", "40", "single"), ContainsSubstring("too stiff"));
  CHECK_THAT(strip("0.02", "1", "40", "double"), !ContainsSubstring("strip_out_of_range"));
  CHECK_THAT(strip("0.12", "2e-5", "24", "auto"), !ContainsSubstring("strip_out_of_range"));

  // The recommended strip for B = 1e-7: the heavy elastica with H/W = 1 has Γ = ρ g L³ / B = 9.3, so L = 7.8
  // mm.
  CHECK_THAT(soft, ContainsSubstring("about 0.0078 m"));
}

TEST_CASE("The measured rigidity of the recommended strip is right within 3 %", "[strip]") {
  // B = 1e-3 N m and ρ g = 0.2 · 9.81 give L = (9.3 B / ρ g)^(1/3) = 0.168 m, in 14 rows behind two rows of
  // the clamp.
  Workplace here;
  here.write("strip.json", R"({"name": "strip",
      "mesh": {"generator": "equilateral", "width": 0.182, "height": 0.06, "cells": 13},
      "pins": {"vertices": ["left"], "distance": 0.0135},
      "material": {"density": 0.2, "strain": {"stiffness": "compliance", "compliance": 1e-5}},
      "bending": {"flexural_rigidity": 1e-3}, "effects": [{"type": "gravity"}],
      "solver": {"method": "equilibrium"}, "output": {"measures": ["stiffness"]}})");
  REQUIRE(here.run("run strip.json --json") == 0);
  const json run = here.out_lines().at(0), &summary = run.at("summary");
  CHECK_THAT(summary.at("stiffness_height_over_width").get<double>(), WithinRel(1, 0.05));
  CHECK_THAT(summary.at("stiffness_flexural_rigidity").get<double>(), WithinRel(1e-3, 0.03));
  CHECK_THAT(summary.at("stiffness_fit_B").get<double>(), WithinRel(1e-3, 0.03));
  CHECK(run.at("warnings").empty());
}

TEST_CASE("Measurements are compared by the law that the shape shows", "[strip]") {
  const auto summary = [](double exponent, double b, double fit_b, double c, double fit_c) {
    return std::map<std::string, double>{{"stiffness_fit_exponent", exponent},
                                         {"stiffness_flexural_rigidity", b},
                                         {"stiffness_fit_B", fit_b},
                                         {"stiffness_quartic", c},
                                         {"stiffness_fit_C", fit_c}};
  };
  CHECK(ratio_of_readings(summary(1.1, 2, 1, 5, 1)) == 2.0);
  CHECK(ratio_of_readings(summary(2.9, 2, 1, 5, 1)) == 5.0);
  CHECK(ratio_of_readings(summary(2, 2, 1, 5, 1)) == std::nullopt);
  CHECK(ratio_of_readings({}) == std::nullopt);
  CHECK(readings_disagree(summary(1, 1.04, 1, 1, 1)));
  CHECK(readings_disagree(summary(1, 1, 1.04, 1, 1)));
  CHECK_FALSE(readings_disagree(summary(1, 1.02, 1, 9, 1)));
  CHECK_FALSE(readings_disagree(summary(3, 9, 1, 1.04, 1)));
  CHECK(readings_disagree(summary(3, 1, 1, 1.06, 1)));
}

}  // namespace
}  // namespace bendlab::strip_doubts_test
