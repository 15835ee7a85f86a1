// Solver methods in whole scenes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bendlab/bending/model.hpp"
#include "bendlab/effects/effect.hpp"
#include "bendlab/scene/built_scene.hpp"
#include "bendlab/solver/method.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::methods_test {
namespace {

using Catch::Matchers::WithinAbs;

bool takes(const MethodKind& method, std::string_view effect) {
  const EffectKind& kind = *find_effect(effect);
  return method.takes_effect(kind.needs_projection, kind.acts_in_iterations);
}

// A sheet twice as wide as high, so pbd orders the vertices differently than the mesh.
BuiltScene wide_sheet(const MethodKind& method, const std::string& rest) {
  const std::string text = fmt::format(
      R"({{"name": "wide", "defaults": "paper", "mesh": {{"cells": 8, "width": 0.5, "height": 0.25}},
           "material": {{"strain": {{"stiffness": "compliance", "compliance": 1e-3}}}},
           "bending": {{"model": "none"}}, "solver": {{"method": "{}"}}, {}}})",
      method.name, rest);
  return build_scene(parse_experiment(text, "test").runs.front().scene());
}

Positions after_steps(const BuiltScene& scene, int steps) {
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  for (int step = 0; step < steps; ++step) REQUIRE(simulation->step());
  return simulation->positions();
}

// The angle to the vertical at which a stiff plate that hangs from its top rests in a horizontal wind.
double angle_in_wind(const std::string& solver, const std::string& effects) {
  const std::string text = fmt::format(
      R"({{"name": "plate", "defaults": "paper", "mesh": {{"cells": 4}},
           "pins": {{"vertices": ["top"], "ring": 0}},
           "initial": {{"tilt": 90, "perturbation": 0}}, "material": {{"density": 0.2,
           "strain": {{"stiffness": "compliance", "compliance": 1e-6}}}}, "solver": {},
           "bending": {{"model": "dihedral", "stiffness": "physical", "flexural_rigidity": 1}}, {}}})",
      solver, effects);
  const BuiltScene scene = build_scene(parse_experiment(text, "test").runs.front().scene());
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  for (int step = 0; step < 600 && !simulation->settled(); ++step) REQUIRE(simulation->step());
  const Positions end = simulation->positions();
  const Eigen::RowVector3d along = end.row(0) - end.row(end.rows() - 1);  // lower_left, upper_right
  return std::atan2(std::abs(along.y()), std::abs(along.z())) * 180 / std::numbers::pi;
}

}  // namespace

TEST_CASE("wind holds a plate at the same angle for any time step and order of effects", "[effects]") {
  // Weight ρ g and drag ½ ρ_air C_D v² cos θ are uniform over the plate. Their moments balance if sin θ /
  // cos² θ = ½ ρ_air C_D v² / (ρ g).
  constexpr double drag = 0.5 * 1.204 * 1.28 * 2 * 2 / (0.2 * 9.81);
  double theta = 0.8;
  for (int i = 0; i < 50; ++i)  // Newton's method
    theta -= (std::sin(theta) - drag * std::pow(std::cos(theta), 2)) /
             (std::cos(theta) + drag * std::sin(2 * theta));
  const std::string wind = R"({"type": "wind", "velocity": [0, 2, 0], "lift_coefficient": 0})",
                    gravity = R"({"type": "gravity"})";
  for (const std::string& effects : {wind + ", " + gravity, gravity + ", " + wind})
    for (const char* dt : {"0.1", "0.01"}) {
      CAPTURE(effects, dt);
      CHECK_THAT(angle_in_wind(fmt::format(R"({{"method": "equilibrium", "dt": {}}})", dt),
                               fmt::format(R"("effects": [{}])", effects)),
                 WithinAbs(theta * 180 / std::numbers::pi, 0.05));  // degrees; the plate bends a little
    }
}

TEST_CASE("with every model, steps of the smallest meshes give finite positions", "[scene]") {
  for (const char* generator : {"grid", "equilateral", "delaunay", "disc", "tube"})
    for (int cells = 1; cells <= 6; ++cells)
      for (const BendingKind* model : bending_models()) {
        const std::string_view name = generator;
        if (model->needs_energy) continue;                                           // k has no energy
        if (cells < (name == "tube" ? 3 : name == "equilateral" ? 2 : 1)) continue;  // refused as too small
        CAPTURE(generator, cells, model->name);
        const std::string text = fmt::format(
            R"({{"name": "small", "mesh": {{"generator": "{}", "cells": {}}},
                 "effects": [{{"type": "gravity"}}],
                 "bending": {{"model": "{}", "stiffness": "k", "k": 0.5}}}})",
            generator, cells, model->name);
        const BuiltScene scene = build_scene(parse_experiment(text, "test").runs.front().scene());
        CHECK(after_steps(scene, 2).allFinite());
      }
}

TEST_CASE("effects act on the vertices that they name, for any vertex order of the method") {
  REQUIRE_FALSE(wide_sheet(*find_method("pbd"), R"("effects": [])").input.permutation.empty());
  for (const MethodKind* method : methods()) {
    INFO(method->name);
    if (method->has_motion && takes(*method, "moving_pins")) {
      const BuiltScene scene = wide_sheet(*method, R"("pins": {"vertices": ["left"], "distance": 0},
          "effects": [{"type": "moving_pins", "times": [0, 0.05], "offsets": [0, 0, 0, 0, 0.1, 0]}])");
      const Positions end = after_steps(scene, 4);
      for (const int pin : scene.pins.all) {
        const Vector3 moved = end.row(pin) - scene.input.positions.row(pin);
        CHECK((moved - Vector3(0, 0.1, 0)).norm() <= 1e-6);  // rounding of metres in single precision
      }
    }
    if (method->has_motion && takes(*method, "self_collision")) {
      const BuiltScene scene = wide_sheet(
          *method, R"("pins": {"vertices": [], "distance": 0}, "effects": [{"type": "self_collision"}])");
      CHECK((after_steps(scene, 4) - scene.input.positions).cwiseAbs().maxCoeff() <= 1e-6);
    }
  }
}

TEST_CASE("a method that needs the mesh's vertex order refuses another order") {
  BuiltScene scene = wide_sheet(*find_method("newton"), R"("effects": [])");
  CHECK(scene.input.permutation.empty());
  scene.input.permutation = wide_sheet(*find_method("pbd"), R"("effects": [])").input.permutation;
  CHECK_THROWS_AS(simulation_of(scene), ConfigError);
}

}  // namespace bendlab::methods_test
