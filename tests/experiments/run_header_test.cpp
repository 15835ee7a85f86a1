// The constraints in a run file: all of them in the order of the solver, and a hash that changes with every
// change of the list.
#include "experiments/run/run_header.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::run_header_test {
namespace {

Experiment experiment_of(const std::string& bending, const std::string& solver) {
  return parse_experiment(R"({"name": "t", "defaults": "paper",
          "mesh": {"cells": 3}, "output": {"constraints": true},
                              "material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}},
                              "bending": )" +
                              bending + R"(, "solver": )" + solver + "}",
                          "test");
}

const std::string hinges = R"({"model": "discrete_shells", "stiffness": "compliance", "compliance": 1})",
                  springs = R"({"model": "crossover", "stiffness": "compliance", "compliance": 1})";

// The record of the constraints of this kind, in a run of the scene after `change` was applied.
template <class Change>
ConstraintRecord record_of(const std::string& kind, const Experiment& experiment, const Change& change) {
  BuiltScene scene = build_scene(experiment.runs.front().scene());
  change(scene.input);
  const auto simulation = simulation_of(scene);
  const RunConfig& config = experiment.runs.front();
  const RunHeader header = header_of(experiment, config, "id", scene, *simulation, Recorder(config, scene));
  const auto record = std::ranges::find(header.constraints, kind, &ConstraintRecord::kind);
  REQUIRE(record != header.constraints.end());
  return *record;
}

ConstraintRecord record_of(const std::string& kind, const Experiment& experiment) {
  return record_of(kind, experiment, [](SimulationInput&) {});
}

template <std::size_t N>
std::vector<int> flat(const std::vector<std::array<int, N>>& vertices) {
  std::vector<int> all;
  for (const auto& corners : vertices) all.insert(all.end(), corners.begin(), corners.end());
  return all;
}

auto& hinge_list(SimulationInput& input) {
  return std::get<ElementList<HingeAngle>>(input.elements);
}

RunHeader header_of(const Experiment& experiment) {
  const RunConfig& config = experiment.runs.front();
  const BuiltScene scene = build_scene(config.scene());
  return header_of(experiment, config, "id", scene, *simulation_of(scene), Recorder(config, scene));
}

}  // namespace

TEST_CASE("a run file states the unit of every metric of its summary and of every setting", "[io]") {
  const Experiment experiment = parse_experiment(
      R"({"name": "t", "mesh": {"cells": 12},
          "bending": {"model": "discrete_shells", "stiffness": "physical", "flexural_rigidity": 1e-4},
          "effects": [{"type": "gravity"}, {"type": "sphere"}]})",
      "test");
  const RunConfig& config = experiment.runs.front();
  const BuiltScene scene = build_scene(config.scene());
  const auto simulation = simulation_of(scene);
  const RunHeader header = header_of(experiment, config, "id", scene, *simulation, Recorder(config, scene));
  const Json about = Json::parse(header.about);
  const auto unit = [&](const char* part, const std::string& name) {
    return about.at(part).at(name).at(0).get<std::string>();
  };
  CHECK(unit("summary", "edge_length") == "m");                         // of the scene
  CHECK(unit("summary", "kinetic_energy") == "J");                      // of a measure
  CHECK(unit("summary", "model_small_deflection_ends") == "√(N/m)/m");  // of the bending model
  CHECK(unit("settings", "/duration") == "s");
  CHECK(unit("settings", "/material/density") == "kg/m²");
  CHECK(unit("settings", "/effects/0/acceleration") == "m/s²");
  CHECK(unit("settings", "/effects/1/radius") == "m");
  CHECK(!about.at("settings").contains("/bending/model"));  // not a number
  for (const auto& [name, entry] : about.at("summary").items())
    CHECK(!entry.at(1).get<std::string>().empty());
}

TEST_CASE("run header: the surface of each obstacle is recorded with its index among the effects", "[run]") {
  const RunHeader header = header_of(parse_experiment(
      R"({"name": "t", "mesh": {"cells": 3}, "effects": [{"type": "gravity"},
          {"type": "sphere", "centre": [1, 2, -3], "radius": 0.5, "velocity": [0, 0, 1]},
          {"type": "plane"}]})",
      "test"));
  REQUIRE(header.obstacles.size() == 2);
  const ObstacleRecord& ball = header.obstacles[0];
  CHECK(ball.effect == 1);
  CHECK(ball.velocity == std::vector<double>{0, 0, 1});
  REQUIRE(ball.positions.size() % 3 == 0);
  for (std::size_t k = 0; k < ball.positions.size(); k += 3)
    CHECK_THAT(std::hypot(ball.positions[k] - 1, ball.positions[k + 1] - 2, ball.positions[k + 2] + 3),
               Catch::Matchers::WithinRel(0.5, 1e-14));
  CHECK(header.obstacles[1].effect == 2);
}

TEST_CASE("run header: the constraints of an equilibrium are recorded in the order of their lists", "[run]") {
  const Experiment experiment = experiment_of(hinges, R"({"method": "equilibrium"})");
  BuiltScene scene = build_scene(experiment.runs.front().scene());
  REQUIRE(hinge_list(scene.input).size() > 0);
  CHECK(record_of("strain", experiment).vertices == flat(scene.input.strain.vertices));
  CHECK(record_of("hinge", experiment).vertices == flat(hinge_list(scene.input).vertices));
}

TEST_CASE("run header: the hash depends on every rest value and on the softness", "[run]") {
  for (const char* solver : {R"({"method": "pbd"})", R"({"method": "equilibrium"})"}) {
    const Experiment experiment = experiment_of(hinges, solver);
    std::set<std::string> hashes = {record_of("hinge", experiment).hash};
    CHECK(hashes.contains(record_of("hinge", experiment).hash));  // the same hash again
    for (std::size_t value = 0; value < HingeAngle::rest_values; ++value)
      hashes.insert(record_of("hinge", experiment, [&](SimulationInput& input) {
                      hinge_list(input).rest.back()[value] += 0.01;
                    }).hash);
    hashes.insert(record_of("hinge", experiment, [](SimulationInput& input) {
                    hinge_list(input).softness.back() *= 2;
                  }).hash);
    CHECK(hashes.size() == 2 + HingeAngle::rest_values);
  }
  const Experiment experiment = experiment_of(springs, "{}");
  std::set<std::string> hashes;
  for (const double softness : {1.0, 2.0})
    hashes.insert(record_of("distance", experiment, [&](SimulationInput& input) {
                    input.distance.softness.assign(input.distance.size(), softness);
                  }).hash);
  CHECK(hashes.size() == 2);
}

TEST_CASE("run header: all rest values of a constraint are recorded", "[run]") {
  const Experiment experiment = experiment_of(hinges, R"({"method": "equilibrium"})");
  BuiltScene scene = build_scene(experiment.runs.front().scene());
  std::vector<double> rest;
  for (const auto& of_one : hinge_list(scene.input).rest)
    rest.insert(rest.end(), of_one.begin(), of_one.end());
  CHECK(record_of("hinge", experiment).rest == rest);
  CHECK(record_of("strain", experiment).rest.size() == scene.input.strain.size());  // areas
}

TEST_CASE("run header: the hash distinguishes triangles of equal area and different shape", "[run]") {
  const Experiment experiment = experiment_of(hinges, R"({"method": "pbd"})");
  const ConstraintRecord whole = record_of("strain", experiment);
  const ConstraintRecord sheared = record_of("strain", experiment, [](SimulationInput& input) {
    InverseRest& q = input.strain.inverse_rest.front();
    q[0] += q[2], q[1] += q[3];  // the determinant does not change
  });
  CHECK_THAT(sheared.rest.front(), Catch::Matchers::WithinRel(whole.rest.front(), 1e-14));  // a few roundings
  CHECK(sheared.hash != whole.hash);
}

}  // namespace bendlab::run_header_test
