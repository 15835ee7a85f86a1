// Solver methods in whole scenes.
#include <fmt/format.h>

#include <algorithm>

#include "bendlab/effects/effect.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/config.hpp"
#include "experiments/scene/scene.hpp"
#include "tests/catch.hpp"

namespace bendlab {
namespace {

bool takes(const Method& method, std::string_view effect) {
  return method.takes_effect(effect, find_effect(effect)->needs_projection);
}

// Twice as wide as high, so that pbd gives the vertices another order than the mesh.
Scene wide_sheet(const Method& method, const std::string& rest) {
  const std::string text = fmt::format(
      R"({{"name": "wide", "defaults": "paper", "mesh": {{"cells": 8, "width": 0.5, "height": 0.25}},
           "material": {{"strain": {{"stiffness": "compliance", "compliance": 1e-3}}}},
           "bending": {{"model": "none"}}, "solver": {{"method": "{}"}}, {}}})",
      method.name, rest);
  return build_scene(parse_experiment(text, "test").runs.front());
}

Positions after_steps(const Scene& scene, int steps) {
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  for (int step = 0; step < steps; ++step) REQUIRE(simulation->step());
  return simulation->positions();
}

}  // namespace

TEST_CASE("effects act on the vertices that they name, whatever the method's order of vertices") {
  REQUIRE_FALSE(wide_sheet(*find_method("pbd"), R"("effects": [])").input.permutation.empty());
  for (const Method* method : methods()) {
    INFO(method->name);
    if (method->has_motion && takes(*method, "moving_pins")) {
      const Scene scene = wide_sheet(*method, R"("pins": {"vertices": ["left"], "distance": 0},
          "effects": [{"type": "moving_pins", "times": [0, 0.05], "offsets": [0, 0, 0, 0, 0.1, 0]}])");
      const Positions end = after_steps(scene, 4);
      for (const int pin : scene.pins.all) {
        const Vector3 moved = end.row(pin) - scene.input.positions.row(pin);
        CHECK((moved - Vector3(0, 0.1, 0)).norm() <= 1e-6);  // roundings of metres in single precision
      }
    }
    if (method->has_motion && takes(*method, "self_collision")) {
      const Scene scene = wide_sheet(
          *method, R"("pins": {"vertices": [], "distance": 0}, "effects": [{"type": "self_collision"}])");
      CHECK((after_steps(scene, 4) - scene.input.positions).cwiseAbs().maxCoeff() <= 1e-6);
    }
  }
}

TEST_CASE("a method of the mesh's order takes no other") {
  Scene scene = wide_sheet(*find_method("newton"), R"("effects": [])");
  CHECK(scene.input.permutation.empty());
  scene.input.permutation = wide_sheet(*find_method("pbd"), R"("effects": [])").input.permutation;
  CHECK_THROWS_AS(simulation_of(scene), std::invalid_argument);
}

}  // namespace bendlab
