// A run that starts where another run ends.
#include "bendlab/scene/start_after.hpp"

#include <numbers>

#include "experiments/config/experiment.hpp"
#include "experiments/config/references.hpp"
#include "experiments/run/run_id.hpp"
#include "tests/catch.hpp"

namespace bendlab::start_after_test {
namespace {

RunConfig config_of(const std::string& settings) {
  return parse_experiment(R"({"name": "after", "defaults": "paper", )" + settings + "}", "test").runs.front();
}

BuiltScene started(const std::string& settings) {
  const RunConfig config = config_of(settings);
  BuiltScene scene = build_scene(config.scene());
  start_after(config.scene(), scene);
  return scene;
}

std::string problem(const std::string& settings) {
  try {
    started(settings);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE(
    "a pose is interpolated on another mesh of the sheet, and extrapolated linearly beyond its outline") {
  // No force acts in the run before, so it ends as it starts: turned by 30 degrees, which is a linear pose.
  // The outlines of the two lattices differ by half a row.
  for (const char* generator : {"equilateral", "grid", "delaunay", "disc"}) {
    const std::string mesh =
        std::string(R"("duration": 0.1, "effects": [], "pins": {"vertices": []}, "mesh": {"cells": 31,
        "generator": ")") +
        generator + R"("}, "solver": {"precision": "double"}, )";
    const std::string after = mesh + R"("initial": {"after": ["/mesh/cells=12", "/initial/tilt=30"]})";
    const BuiltScene scene = started(after);
    // The centres of the two boxes are the same place of the sheet. It stays where the first mesh has it.
    const Vector3 centre = scene.rest.centre(),
                  stays = build_scene(run_before(config_of(after))->scene()).rest.centre();
    const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
    double worst = 0;
    for (int v = 0; v < scene.rest.vertex_count(); ++v) {
      const Vector3 arm = scene.rest.position(v) - centre;
      const Vector3 turned = stays + Vector3(arm.x(), c * arm.y(), s * arm.y());
      worst = std::max(worst, (scene.input.positions.row(v).transpose() - turned).norm());
    }
    INFO(generator << ": " << worst);
    // Lengths of a metre have a rounding of 1e-16. 6 steps of ten iterations with about ten projections add
    // at most 600 roundings, and linear extrapolation by up to two edges multiplies this by less than ten.
    CHECK(worst < 1e-12);
  }
}

TEST_CASE("a run on the same mesh starts exactly where the run before ends") {
  const std::string fall = R"("mesh": {"cells": 6}, "solver": {"precision": "double"}, "duration": 0.5)";
  const RunConfig alone = config_of(fall);
  const BuiltScene scene = build_scene(alone.scene());
  const auto simulation = simulation_of(scene);
  for (int step = 0; step < 30; ++step) REQUIRE(simulation->step());
  const BuiltScene after = started(fall + R"(, "initial": {"after": ["/duration=0.5"]})");
  CHECK(after.input.positions == simulation->positions());
}

TEST_CASE("an equilibrium does not depend on the start of its search") {
  const std::string strip =
      R"("duration": 10, "mesh": {"generator": "equilateral", "width": 0.23, "height": 0.12,
      "rows": "perpendicular", "cells": 12}, "pins": {"vertices": ["left"], "ring": 1},
      "material": {"strain": {"stiffness": "compliance", "compliance": 1e-6}},
      "bending": {"model": "discrete_shells", "stiffness": "compliance", "compliance": 1000},
      "solver": {"method": "equilibrium"})";
  const auto tip = [](const std::string& settings) {
    const BuiltScene scene = started(settings);
    const auto simulation = simulation_of(scene);
    for (int step = 0; step < 200 && !simulation->settled(); ++step) REQUIRE(simulation->step());
    REQUIRE(simulation->settled());
    return simulation->positions().col(2).minCoeff();
  };
  // The last step of a settled search moves the cloth by at most 1e-6 of its size of 0.26 m, and a further
  // step by less. So two searches end within 5.2e-7 m of each other. The sag is more than half the length,
  // 0.115 m.
  CHECK_THAT(tip(strip + R"(, "initial": {"after": ["/mesh/cells=8"]})"),
             Catch::Matchers::WithinRel(tip(strip), 5e-6));
}

TEST_CASE("mistakes in the run before are reported when the config is read") {
  using Catch::Matchers::ContainsSubstring;
  CHECK_THAT(problem(R"("initial": {"after": ["/mesh/cels=3"]})"),
             ContainsSubstring("/mesh/cels") && ContainsSubstring("did you mean 'cells'"));
  CHECK_THAT(problem(R"("initial": {"after": ["cells"]})"), ContainsSubstring("not of the form"));
  CHECK_THAT(
      problem(
          R"("mesh": {"generator": "tube", "cells": 12}, "duration": 0.1, "pins": {"vertices": ["top_rim"]},
      "initial": {"after": ["/mesh/cells=14"]})"),
      ContainsSubstring("one flat sheet"));
  CHECK_THAT(problem(R"("duration": 0.1, "initial": {"after": ["/mesh/width=0.5"]})"),
             ContainsSubstring("outside"));
}

TEST_CASE("the id of a run depends on the run before") {
  const auto id = [](const std::string& settings) { return run_id(config_of(settings)); };
  CHECK(id(R"("initial": {"after": ["/mesh/cells=4"]})") != id(R"("duration": 4)"));
  CHECK(id(R"("initial": {"after": ["/mesh/cells=4"]})") != id(R"("initial": {"after": ["/mesh/cells=5"]})"));
}

}  // namespace bendlab::start_after_test
