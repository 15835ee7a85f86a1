// Sheets under large forces: pins that are suddenly pulled away, and a storm.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::large_forces_test {
namespace {

// The largest ratio of an edge to its rest length over all steps.
double longest_edge(std::string_view pins, std::string_view effects, std::string_view form,
                    std::string_view solver, double duration) {
  const Experiment experiment = parse_experiment(
      fmt::format(
          R"({{"name": "large_forces", "duration": {}, "mesh": {{"cells": 24}}, "pins": {{"vertices": [{}]}},
          "material": {{"strain": {{"form": "{}", "stiffness": "compliance", "compliance": 1e-4}}}},
          "effects": [{{"type": "gravity"}}, {}], "solver": {{"method": "quasi_newton", {}}}}})",
          duration, pins, form, effects, solver),
      "test");
  const BuiltScene scene = build_scene(experiment.runs.front().scene());
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  const Positions& rest = scene.rest.positions();
  double longest = 0;
  for (int step = 0; step < std::lround(duration * 60); ++step) {
    REQUIRE(simulation->step());
    const Positions now = simulation->positions();
    for (const auto edge : scene.rest.edges().rowwise())
      longest = std::max(longest, (now.row(edge(0)) - now.row(edge(1))).norm() /
                                      (rest.row(edge(0)) - rest.row(edge(1))).norm());
  }
  return longest;
}

const std::vector<std::string_view> solvers = {
    R"("iterations": 5)", R"("iterations": 10)", R"("iterations": 5, "membrane": "auto")",
    R"("iterations": 5, "membrane": "auto", "membrane_error": 0.01)", R"("substeps": 2, "iterations": 5)"};

}  // namespace

TEST_CASE("pins that are suddenly pulled away do not tear a sheet", "[solver]") {
  // A smooth step of 0.85 m in 0.1 s has an acceleration of at most 6 · 0.85 m / (0.1 s)². With 0.2 kg, each
  // of two corners then carries 51 N. This strains the triangle there, 1/24 m of 10⁴ N/m, by 0.12. A sudden
  // load strains twice as much. Another factor of two is allowed for steps that have not converged.
  constexpr double most = 1 + 4 * 0.12;
  for (const std::string_view form : {"green", "angle"})
    for (const std::string_view solver : solvers) {
      CAPTURE(form, solver);
      CHECK(longest_edge(R"("upper_left", "upper_right")",
                         R"({"type": "moving_pins", "times": [0.2, 0.3], "offsets": [0, 0, 0, 0.6, 0, 0.6],
                             "interpolation": "smooth"})",
                         form, solver, 1.5) <= most);
    }
}

TEST_CASE("a storm does not tear a sheet", "[solver]") {
  // Gusts of up to 30 m/s press with at most ½ · 1.2 kg/m³ · 1.3 · (30 m/s)², or 700 N/m². A sheet held along
  // 1 m is strained by 700 N / (10⁴ N/m) = 0.07. A factor of two accounts for sudden loads, and another one
  // for the corners.
  constexpr double most = 1 + 4 * 0.07;
  for (const std::string_view form : {"green", "angle"})
    for (const std::string_view solver : solvers) {
      CAPTURE(form, solver);
      CHECK(longest_edge(R"("left")", R"({"type": "wind", "velocity": [20, 5, 0], "gust_amplitude": 0.5})",
                         form, solver, 2) <= most);
    }
}

}  // namespace bendlab::large_forces_test
