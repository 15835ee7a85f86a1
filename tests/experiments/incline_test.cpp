// Coulomb's law on an incline, for every method that supports friction. A free sheet lies on a plane, and
// gravity is tilted by 30 degrees.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::incline_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double down = 4.905, into = 8.4957;  // m/s²: gravity along the plane and into the plane
constexpr double duration = 1, dt = 1.0 / 60;  // s

// How far the sheet moves along the plane, m.
double way(const std::string& solver, const std::string& effects, double along = down) {
  const Experiment experiment = parse_experiment(
      fmt::format(
          R"({{"name": "incline", "defaults": "paper", "duration": {}, "mesh": {{"cells": 4, "width": 0.4,
          "height": 0.4}}, "pins": {{"vertices": []}}, "bending": {{"model": "none"}},
          "material": {{"strain": {{"stiffness": "compliance", "compliance": 1e-4}}}}, "solver": {},
          "effects": [{{"type": "gravity", "acceleration": [{}, 0, {}]}}, {}]}})",
          duration, solver, along, -into, effects),
      "test");
  const BuiltScene scene = build_scene(experiment.runs.front().scene());
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  const Eigen::RowVector3d start = simulation->positions().colwise().mean();
  for (int step = 0; step < std::lround(duration / dt); ++step) REQUIRE(simulation->step());
  CHECK((simulation->positions().col(2).array() - start.z()).abs().maxCoeff() <
        1e-4);  // the sheet stays on the plane
  return simulation->positions().col(0).mean() - start.x();
}

std::string friction(double at_rest, double sliding) {
  return fmt::format(R"(, {{"type": "friction", "static": {}, "kinetic": {}}})", at_rest, sliding);
}
std::string friction(double coefficient) {
  return friction(coefficient, coefficient);
}

// The mean velocity of a sheet after `time`, m/s. `scene` holds settings of its config.
Eigen::RowVector3d drift(const std::string& solver, const std::string& scene, double time) {
  const Experiment experiment = parse_experiment(
      fmt::format(R"({{"name": "landing", "defaults": "paper", "duration": 9, "pins": {{"vertices": []}},
          "mesh": {{"cells": 4, "width": 0.4, "height": 0.4}}, "bending": {{"model": "none"}},
          "material": {{"strain": {{"stiffness": "compliance", "compliance": 1e-4}}}}, "solver": {}, {}}})",
                  solver, scene),
      "test");
  const BuiltScene built = build_scene(experiment.runs.front().scene());
  const std::unique_ptr<Simulation> simulation = simulation_of(built);
  for (int step = 0; step < std::lround(time / dt); ++step) REQUIRE(simulation->step());
  const Eigen::Map<const Eigen::VectorXd> mass(built.input.mass.data(),
                                               static_cast<Eigen::Index>(built.input.mass.size()));
  return mass.transpose() * simulation->velocities() / mass.sum();
}

// The way after n substeps of a method of first order, Σ a h² k = ½ a t² (1 + 1/n), m.
double slid(double acceleration, int substeps) {
  return 0.5 * acceleration * duration * duration * (1 + dt / substeps / duration);
}

struct Setting {
  const char* solver;
  int substeps;
};
constexpr Setting settings[] = {
    {R"({"method": "pbd", "substeps": 8, "iterations": 1})", 8},
    {R"({"method": "quasi_newton", "membrane": "stated", "iterations": 10, "history": 10})", 1},
    {R"({"method": "quasi_newton", "integrator": "bdf2", "membrane": "stated", "iterations": 10,
         "history": 10})",
     1},
    {R"({"method": "newton"})", 1},
    {R"({"method": "newton", "integrator": "euler"})", 1},
    {R"({"method": "newton", "substeps": 8})", 8},
    {R"({"method": "vbd"})", 1}};
const std::string plane = R"({"type": "plane", "point": [0, 0, -0.005]})";

}  // namespace

TEST_CASE("without friction a sheet slides down an incline like a rigid body", "[solver]") {
  for (const Setting& setting : settings) {
    CAPTURE(setting.solver);
    CHECK_THAT(way(setting.solver, plane), WithinRel(slid(down, setting.substeps), 1e-3));
  }
}

TEST_CASE("friction slows a sheet on an incline by its coefficient, or holds the sheet", "[solver]") {
  for (const Setting& setting : settings) {
    CAPTURE(setting.solver);
    CHECK_THAT(way(setting.solver, plane + friction(0.3)),
               WithinRel(slid(down - 0.3 * into, setting.substeps), 2e-3));
    // tan 30° = 0.577 < 0.8. The iterations of vbd leave a small slip in each step.
    CHECK_THAT(way(setting.solver, plane + friction(0.8)), WithinAbs(0, 0.006));
  }
}

// tan 25° = 0.466 and tan 27° = 0.510. The slip that the last iteration leaves adds up to less than a
// millimetre over 60 steps.
TEST_CASE(
    "friction holds up to its static coefficient, and beyond it the sheet slides with the kinetic "
    "coefficient",
    "[solver]") {
  constexpr double gravity = 9.81, degree = std::numbers::pi / 180;
  const auto on = [&](double angle, const std::string& solver) {
    const std::string tilted = fmt::format(R"({{"type": "gravity", "acceleration": [{}, 0, {}]}}, {})",
                                           gravity * std::sin(angle * degree),
                                           -gravity * std::cos(angle * degree), plane + friction(0.5, 0.4));
    return drift(solver, "\"effects\": [" + tilted + "]", duration).x();
  };
  for (const Setting& setting : settings) {
    CAPTURE(setting.solver);
    CHECK_THAT(on(25, setting.solver), WithinAbs(0, 1e-3));
    const double slides = gravity * (std::sin(27 * degree) - 0.4 * std::cos(27 * degree));
    CHECK_THAT(on(27, setting.solver), WithinRel(slides * duration, 0.05));  // vbd starts 1.4 steps late
  }
}

// The plane stops the normal speed of 1 m/s. Friction reduces the sliding speed by the kinetic coefficient
// times 1 m/s.
TEST_CASE("a sheet that slides when it lands loses speed by its kinetic coefficient", "[solver]") {
  const std::string landing = R"("initial": {"velocity": [2, 0, -1]}, "effects": [)";
  for (const Setting& setting : settings)
    for (const auto& [at_rest, sliding] : {std::pair(1.5, 0.1), std::pair(0.5, 0.4)}) {
      CAPTURE(setting.solver, sliding);
      CHECK_THAT(drift(setting.solver, landing + plane + friction(at_rest, sliding) + "]", 0.1).x(),
                 WithinAbs(2 - sliding, 1e-3));
    }
}

// The layers of a folded strip are nearer than their thickness and push each other. Friction acts only
// between cloth and obstacles, and the plane is far away.
TEST_CASE("friction holds a sheet near its limit with the precision that a scene chooses", "[scene]") {
  // The slope is 0.9 of the static coefficient. In single precision the sheet would slide by 0.1 to 0.4 m
  // with 32 substeps.
  for (const auto& [substeps, iterations] : {std::pair(1, 10), {8, 1}, {32, 1}, {32, 8}}) {
    CAPTURE(substeps, iterations);
    const std::string solver = fmt::format(R"({{"substeps": {}, "iterations": {}}})", substeps, iterations);
    CHECK_THAT(way(solver, plane + friction(0.5), 0.45 * into), WithinAbs(0, 0.002));
  }
}

TEST_CASE("friction does not act on flying layers that push each other", "[solver]") {
  const std::string flying = R"("initial": {"folds": 2, "fold_gap": 0.004, "velocity": [1, 0, 0]},
      "effects": [{"type": "plane", "point": [0, 0, -9]}, {"type": "self_collision", "thickness": 0.006})";
  for (const Setting& setting : settings) {
    CAPTURE(setting.solver);
    const Eigen::RowVector3d with = drift(setting.solver, flying + friction(0.5) + "]", 0.25),
                             without = drift(setting.solver, flying + "]", 0.25);
    CHECK((with - without).norm() <= 1e-5);    // with friction, pbd uses double precision
    CHECK_THAT(with.x(), WithinAbs(1, 0.01));  // remaining forces between the layers
  }
}

// No force acts along the plane.
TEST_CASE("a smooth plane gives a crumpling sheet no momentum along the plane", "[solver]") {
  const std::string falling = R"("initial": {"tilt": 30}, "effects": [{"type": "gravity"},
                                 {"type": "plane", "point": [0, 0, -0.3]}])";
  for (const Setting& setting : settings) {
    if (std::string_view(setting.solver).find("quasi_newton") != std::string_view::npos)
      continue;  // 10 iterations
    CAPTURE(setting.solver);
    const Eigen::RowVector3d velocity = drift(setting.solver, falling, 1);
    CHECK_THAT(velocity.head<2>().norm(), WithinAbs(0, 1e-3));  // vertices have up to 2 m/s
  }
}

// The belt drags the sheet over the way v²/2μg until it has the belt's speed v. Then it moves with the belt.
TEST_CASE("a belt carries a sheet along", "[solver]") {
  const double v = 0.5, coefficient = 0.3;
  const std::string belt = R"({"type": "plane", "point": [0, 0, -0.005], "velocity": [0.5, 0, 0]})";
  for (const Setting& setting : settings) {
    CAPTURE(setting.solver);
    const double expected = v * duration - v * v / (2 * coefficient * into);
    CHECK_THAT(way(setting.solver, belt + friction(coefficient), 0),
               WithinAbs(expected, 0.5 * v * dt / setting.substeps + 1e-3));  // of first order
  }
}

}  // namespace bendlab::incline_test
