// A membrane whose stiffness is stated in N/m.
#include <fmt/format.h>

#include <string>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::membrane_stiffness_test {
namespace {

RunConfig with(const std::string& strain, const std::string& method) {
  return parse_experiment(fmt::format(R"({{"name": "membrane", "mesh": {{"cells": 5}}, "duration": 0.1,
          "effects": [{{"type": "gravity"}}], "bending": {{"model": "dihedral"}},
          "material": {{"strain": {}}}, "solver": {{"method": "{}"}}}})",
                                      strain, method),
                          "test")
      .runs.front();
}

Positions after_steps(const RunConfig& config) {
  const auto simulation = simulation_of(build_scene(config.scene()));
  for (int step = 0; step < 5; ++step) REQUIRE(simulation->step());
  return simulation->positions();
}

}  // namespace

TEST_CASE("with every method, a membrane of Y N/m equals a membrane with the compliance 1/Y",
          "[experiments]") {
  for (const std::string method : {"pbd", "quasi_newton", "newton", "vbd"}) {
    CAPTURE(method);
    const Positions stated = after_steps(with(R"({"membrane_stiffness": 8192})", method)),
                    inverse = after_steps(
                        with(R"({"stiffness": "compliance", "compliance": 0.0001220703125})", method));
    CHECK(stated == inverse);  // 1/8192 is exact
  }
}

TEST_CASE("`physical` without a value is a membrane of 10 000 N/m", "[experiments]") {
  const RunConfig config = with(R"({"stiffness": "physical"})", "newton");
  CHECK(config.scene().material.strain.membrane_stiffness == 1e4);
  CHECK(build_scene(config.scene()).input.strain_stiffness.compliance == 1 / 1e4);
}

TEST_CASE("the stiffness of a membrane must be above 0, and methods that need it name the setting",
          "[experiments]") {
  using Catch::Matchers::Contains;
  CHECK_THROWS_WITH(with(R"({"membrane_stiffness": 0})", "pbd"),
                    Contains("/material/strain/membrane_stiffness"));
  CHECK_THROWS_WITH(with(R"({"stiffness": "k"})", "newton"), Contains("\"physical\""));
}

}  // namespace bendlab::membrane_stiffness_test
