// A cantilever from its config to `bendlab stiffness`, and runs that end when the cloth is at rest.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <string>

#include "bendlab/io/run_file.hpp"
#include "bendlab/mesh/generators.hpp"
#include "experiments/config/experiment.hpp"
#include "experiments/measures/strip.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/workplace.hpp"

namespace bendlab::experiments_stiffness_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using nlohmann::json;
using test::Workplace;

// A lattice strip of 12 rows, h = 0.021650635 m apart. Two rows of vertices are pinned, so 11 h are free.
constexpr const char* cantilever = R"({"name": "tiny", "defaults": "paper",
          "duration": 10, "settled_speed": 0.005,
  "mesh": {"generator": "equilateral", "width": 0.25, "height": 0.14, "cells": 10, "rows": "perpendicular"},
  "pins": {"vertices": ["left"], "ring": 1},
  "effects": [{"type": "gravity", "acceleration": [0, 0, -9.81]}, {"type": "rigid_damping", "rate": 5}],
  "solver": {"iterations": 400, "sweep": "symmetric"},
  "output": {"frames_per_second": 10, "measures": ["stiffness"]},
  "bending": {"model": "discrete_shells", "stiffness": "compliance", "compliance": 1000}})";
constexpr double row = 0.021650635;

RunConfig strip_config(const std::string& bending) {
  return parse_experiment(
             R"({"name": "strip", "defaults": "paper",
          "pins": {"vertices": ["left"], "ring": 4}, "bending": )" +
                 bending + "}",
             "strip")
      .runs.at(0);
}

}  // namespace

TEST_CASE("The stiffness of a cantilever is measured", "[command line]") {
  Workplace here;
  here.write("tiny.json", cantilever);
  REQUIRE(here.run("run tiny.json --json") == 0);
  const json run = here.out_lines().at(0), summary = run.at("summary");

  REQUIRE(here.run("stiffness results/tiny --json --profile") == 0);
  const json strip = here.out_lines().at(0);
  CHECK(strip.at("id") == run.at("id"));
  CHECK_THAT(strip.at("length").get<double>(), WithinRel(11 * row, 1e-6));
  // A hinge on the last pinned row spans a row on either side. This adds half a row to the length.
  CHECK_THAT(strip.at("effective_length").get<double>(), WithinRel(11.5 * row, 1e-6));
  CHECK_THAT(strip.at("exclude").get<double>(), WithinRel(2 * row, 1e-6));
  // D = 1 / compliance. Eleven rows, 800 projections per step, and free sides that also bend the other way
  // cause errors of a few per cent, and more in the fit.
  CHECK_THAT(strip.at("flexural_rigidity").get<double>(), WithinRel(1e-3, 0.05));
  CHECK_THAT(strip.at("fit_exponent").get<double>(), WithinAbs(1, 0.15));
  CHECK_THAT(strip.at("fit_B").get<double>(), WithinRel(1e-3, 0.15));
  CHECK(strip.at("settling").get<double>() < 0.05);
  CHECK(strip.at("profile").size() == 10);
  // The file has single precision, but the summary was computed before rounding. 10⁻⁷ of a coordinate is 10⁻⁵
  // of a curvature.
  for (const auto& [name, column] : {std::pair{"stiffness_flexural_rigidity", "flexural_rigidity"},
                                     {"stiffness_quartic", "quartic"},
                                     {"stiffness_fit_exponent", "fit_exponent"},
                                     {"stiffness_fit_B", "fit_B"},
                                     {"stiffness_fit_C", "fit_C"},
                                     {"stiffness_height_over_width", "height_over_width"},
                                     {"stiffness_gamma", "gamma"},
                                     {"stiffness_bending_length", "bending_length"}})
    CHECK_THAT(summary.at(name).get<double>(), WithinRel(strip.at(column).get<double>(), 1e-3));

  // The cloth came to rest: the file ends after a calm half second.
  const double settled_at = summary.at("settled_at").get<double>();
  CHECK(settled_at > 1);
  CHECK_THAT(strip.at("time").get<double>(), WithinAbs(settled_at + 0.5, 0.02));  // checked every 1/60 s
  CHECK(strip.at("time").get<double>() < 10);

  SECTION("as a table, for another frame, with another clamp") {
    REQUIRE(here.run("stiffness " + run.at("id").get<std::string>()) == 0);
    CHECK_THAT(here.out(), ContainsSubstring("flexural_rigidity") && ContainsSubstring("N m"));
    REQUIRE(here.run("stiffness results/tiny --json --frame 1 --clamp-offset 0 --exclude 0.01") == 0);
    const json early = here.out_lines().at(0);
    CHECK(early.at("effective_length") == early.at("length"));
    CHECK(early.at("exclude") == 0.01);
    CHECK(early.at("drop").get<double>() < strip.at("drop").get<double>());
    CHECK(here.run("stiffness results/tiny --frame 1000") == 2);
    CHECK(here.run("stiffness results/tiny --clamp-offset -1") == 2);
    CHECK(here.run("stiffness nothing") == 2);
  }
}

TEST_CASE("A run that is no cantilever has no measured stiffness", "[command line]") {
  Workplace here;
  here.write("cloth.json", R"({"name": "cloth", "defaults": "paper",
          "duration": 0.1, "mesh": {"cells": 8}})");
  REQUIRE(here.run("run cloth.json --json") == 0);
  CHECK_FALSE(here.out_lines().at(0).at("summary").contains("settled_at"));
  CHECK(here.run("stiffness results/cloth") == 1);
  CHECK_THAT(here.err(), ContainsSubstring("pin one whole side"));
  CHECK(here.run("run cloth.json --set '/output/measures=[\"stiffness\"]'") ==
        3);  // refused before the run starts
  CHECK_THAT(here.err(), ContainsSubstring("/output/measures") && ContainsSubstring("pin one whole side"));
  CHECK(here.run(
            "run cloth.json --set '/output/measures=[\"stiffness\"]' --set '/pins/vertices=[\"left\"]' --set "
            "/initial/tilt=30") == 3);
  CHECK_THAT(here.err(), ContainsSubstring("moved or turned"));
}

TEST_CASE("The clamp's offset follows from the reach of the bending model", "[stiffness]") {
  // Springs of ring t span t rows, which are h apart, and hinges span two rows.
  const RestMesh rest(equilateral(0.25, 0.14, 10, Rows::perpendicular));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 4);
  const auto options = [&](const std::string& bending) {
    return strip_of(strip_config(bending), rest, pins).options;
  };
  CHECK_THAT(options(R"({"model": "crossover"})").clamp_offset, WithinRel(2 * row / 4, 1e-6));
  CHECK_THAT(options(R"({"model": "dihedral"})").clamp_offset, WithinRel(2 * row / 4, 1e-6));
  CHECK_THAT(options(R"({"model": "k_ring", "k_ring": {"k": 3}})").clamp_offset,
             WithinRel(3 * row / 4, 1e-6));
  CHECK_THAT(options(R"({"model": "k_ring", "k_ring": {"k": 4}})").exclude, WithinRel(4 * row, 1e-6));
  CHECK(options(R"({"model": "none"})").clamp_offset == 0);
  CHECK(
      options(R"({"model": "dihedral", "stiffness": "physical", "flexural_rigidity": 1e-3})").clamp_offset ==
      0);
  // The numbers of vertices do not matter.
  TriangleMesh mesh = equilateral(0.25, 0.14, 10, Rows::perpendicular);
  std::vector<int> number(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), std::mt19937(1));
  const Positions positions = mesh.positions;
  for (Eigen::Index v = 0; v < positions.rows(); ++v)
    mesh.positions.row(number[static_cast<std::size_t>(v)]) = positions.row(v);
  mesh.triangles =
      mesh.triangles.unaryExpr([&](int v) { return number[static_cast<std::size_t>(v)]; }).eval();
  const RestMesh mixed(mesh);
  const Pins mixed_pins = make_pins(mixed, select_vertices(mixed, Place::left), 4);
  CHECK_THAT(strip_of(strip_config(R"({"model": "crossover"})"), mixed, mixed_pins).options.clamp_offset,
             WithinRel(2 * row / 4, 1e-6));
  const StripOptions set =
      strip_of(strip_config(R"({"model": "crossover"})"), rest, pins, {.clamp_offset = 0.5, .exclude = 0.25})
          .options;
  CHECK(set.clamp_offset == 0.5);
  CHECK(set.exclude == 0.25);
}

}  // namespace bendlab::experiments_stiffness_test
