// Scenes built from C++.
#include <cmath>
#include <numbers>
#include <random>

#include "bendlab/bendlab.hpp"
#include "bendlab/mesh/files.hpp"
#include "bendlab/scene/energy.hpp"
#include "bendlab/scene/initial_pose.hpp"
#include "bendlab/settings/random_numbers.hpp"
#include "bendlab/solver/time_step.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::simulate_test {

using Catch::Matchers::ContainsSubstring;

namespace {

std::string refused(const Scene& scene) {
  try {
    simulate(scene);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

// The positions of a config's run after `steps` steps.
Positions of_config(const std::string& settings, int steps) {
  const RunConfig run = parse_experiment(R"({"name": "same", )" + settings + "}", "test").runs.front();
  const BuiltScene built = build_scene(run.scene());
  const auto simulation = simulation_of(built);
  for (int step = 0; step < steps; ++step) REQUIRE(simulation->step());
  return simulation->positions();
}

// An effect, a model and a method that are not registered.
struct Push {
  double acceleration = 2;  // m/s²
  static const EffectKind kind;
};

template <class Real>
std::vector<Pass<Real>> compile(const Push& settings, const EffectInput&) {
  return {{"push", Stage::force, [a = settings.acceleration](PassContext<Real>& context) {
             for (int v = 0; v < context.state.vertex_count; ++v)
               context.state.accelerate(static_cast<std::size_t>(v),
                                        {0, 0, static_cast<Real>(a) * context.substep});
           }}};
}

constexpr std::array push_fields = {field<&Push::acceleration>({.name = "acceleration"})};
const EffectKind Push::kind{.name = "push",
                            .settings = table_of<Push>(push_fields),
                            .compile_float = erased<compile<float>>,
                            .compile_double = erased<compile<double>>};

struct Loose {
  static const BendingKind kind;
};
const BendingKind Loose::kind{.name = "loose",
                              .label = "loose",
                              .settings = table_of<Loose>({}),
                              .build = [](const void*, const BendingInput&) { return BendingConstraints{}; }};

// x += h v without constraints.
struct Ballistic {
  static const MethodKind kind;
};

class BallisticStep final : public TimeStep<double> {
 public:
  BallisticStep(const SimulationInput& input, std::vector<Pass<double>> effects) : TimeStep(input, {}) {
    append_effects(plan_, effects, Stage::force);
  }

 private:
  void substep(PassContext<double>& context) override {
    run(plan_, context);
    for (auto v = 0ul; v < state_.mass.size(); ++v)
      state_.position[v].set(state_.position[v].vector() + context.substep * state_.velocity[v].vector());
    find_divergence();
  }
  std::uint64_t projections_per_substep() const override { return 0; }
  Passes plan_;
};
const MethodKind Ballistic::kind{.name = "ballistic",
                                 .settings = table_of<Ballistic>({}),
                                 .default_substeps = 4,
                                 .mesh_order = true,
                                 .make_double = make_step<BallisticStep>};

}  // namespace

TEST_CASE("normals at a clamp turn with the clamp", "[scene]") {
  for (const std::string_view model : {"mid_edge", "dkt"})
    for (const std::string_view method : {"quasi_newton", "newton"}) {
      INFO(model << " " << method);
      Scene scene;
      scene.mesh = grid(0.2, 0.05, 8);
      scene.pins.vertices = {Place::left}, scene.pins.ring = 1;
      scene.bending.model = BendingModel(*find_bending_model(model));
      scene.bending.flexural_rigidity = 1e-3;
      scene.solver.method = Method(*find_method(method));
      scene.effects = {MovingPins{.times = {0, 0.5}, .angles = {0, 90}, .axis = {0, 1, 0}},
                       ViscousDrag{.coefficient = 2.5}};  // critical for ω = 3.5 √(B/ρ) / L² = 6 /s
      Cloth cloth = simulate(scene);
      const auto bending = [&](const Positions& pose) {
        return energy_parts(cloth.scene().input, pose).back().energy;
      };
      // A quarter of a circle over the whole strip would have ½ B (π / 2 L)² times the area.
      const double quarter = 0.5 * 1e-3 * std::pow(std::numbers::pi / 2 / 0.2, 2) * 0.2 * 0.05;
      const Eigen::Matrix3d turn = Eigen::AngleAxisd(2, Vector3(1, 2, 3).normalized()).toRotationMatrix();
      CHECK(bending(cloth.positions() * turn.transpose()) < 1e-12 * quarter);  // rounding
      // The clamp turns by a right angle, and the sheet follows it and comes to rest: in the last 2.5 s its
      // energy falls by e^(-2 · 6 · 2.5). With few iterations, quasi_newton comes to rest later.
      cloth.run(method == "newton" ? 3 : 60);
      CHECK(bending(cloth.positions()) < 1e-4 * quarter);
      const Vector3 extent =
          (cloth.positions().colwise().maxCoeff() - cloth.positions().colwise().minCoeff()).transpose();
      CHECK(extent.x() < 0.01 * extent.z());
    }
}

TEST_CASE("a disturbed pose is the same on every compiler and processor", "[scene]") {
  Scene scene;
  scene.mesh.width = scene.mesh.height = 1.5;
  scene.mesh.cells = 60;  // so many vertices that another rounding of a product would change a few
  scene.initial.perturbation = 1e-4;
  scene.initial.seed = 1;
  const BuiltScene built = build_scene(scene);
  const RestMesh& rest = built.rest;
  std::mt19937_64 numbers(1);
  Positions expected = rest.positions();
  for (int v = 0; v < rest.vertex_count(); ++v)
    for (int axis = 0; axis < 3; ++axis) {
      const double random = 2 * uniform(numbers) - 1;
      if (!built.pins.pinned(v)) expected(v, axis) = std::fma(1e-4 * rest.size(), random, expected(v, axis));
    }
  CHECK(initial_positions(scene.initial, rest, built.pins, scene.folder) == expected);
}

TEST_CASE("a cloth starts with the points of a mesh file", "[scene]") {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "bendlab_start_pose.obj";
  Scene scene;
  scene.mesh.cells = 5;
  scene.initial.surface = {.shape = SurfaceShape::cylinder, .radius = 0.3};
  const BuiltScene rolled = build_scene(scene);
  TriangleMesh pose = rolled.rest.mesh();
  pose.positions = rolled.input.positions;
  write_mesh(file, pose);
  scene.initial = {.file = file.string()};
  const BuiltScene from_file = build_scene(scene);
  CHECK(from_file.input.positions == rolled.input.positions);
  CHECK(from_file.input.rest == rolled.input.rest);

  // Another order of the triangles is another numbering.
  pose.triangles.row(0).swap(pose.triangles.row(1));
  write_mesh(file, pose);
  CHECK_THROWS_WITH(build_scene(scene), ContainsSubstring("triangle 0 with other vertices"));
  std::filesystem::remove(file);
}

TEST_CASE("simulate: a default scene and a default config give the same bits", "[scene]") {
  Cloth cloth = simulate(Scene{});
  for (int step = 0; step < 10; ++step) cloth.step();
  CHECK(cloth.time() == 10 * Scene{}.solver.dt);
  CHECK(cloth.positions() == of_config(R"("description": "")", 10));
}

TEST_CASE("simulate: members of a scene and settings of a config give the same bits", "[scene]") {
  Scene scene;
  scene.mesh = grid(1, 0.5, 12, Diagonal::alternating);
  scene.pins.vertices = {Place::upper_left, Place::upper_right};
  scene.bending.model = Dihedral{.weight = Dihedral::Weight::area};
  scene.bending.flexural_rigidity = 1e-4;
  scene.solver.method = QuasiNewton{.history = 8};
  scene.solver.iterations = 12;
  scene.effects = {Gravity{}, Wind{.velocity = {0, 3, 0}}, Sphere{.centre = {0, 0, -0.4}}};
  Cloth cloth = simulate(scene);
  cloth.run(0.3);
  CHECK(cloth.positions() == of_config(R"("mesh": {"width": 1, "height": 0.5, "cells": 12,
      "diagonal": "alternating"}, "pins": {"vertices": ["upper_left", "upper_right"]},
      "bending": {"model": "dihedral", "flexural_rigidity": 1e-4, "dihedral": {"weight": "area"}},
      "solver": {"method": "quasi_newton", "history": 8, "iterations": 12},
      "effects": [{"type": "gravity"}, {"type": "wind", "velocity": [0, 3, 0]},
                  {"type": "sphere", "centre": [0, 0, -0.4]}])",
                                       18));
}

TEST_CASE("simulate: the JSON of a scene gives the same scene", "[scene]") {
  Scene scene;
  scene.bending.model = Lod{.t = 3};
  scene.bending.stiffness = Stiffness::compliance, scene.bending.compliance = 0.1;
  scene.solver.method = Newton{.integrator = Integrator::euler};
  scene.effects = {Gravity{.acceleration = {0, -9.81, 0}}, Friction{.at_rest = 0.3},
                   Plane{.point = {0, 0, -1}}};
  ConfigProblems problems;
  const Scene again = read_scene(to_json(scene), {}, problems);
  CHECK(problems.empty());
  CHECK(to_json(again) == to_json(again));
  CHECK(again.bending.model.as<Lod>()->t == 3);
  CHECK(again.effects.at(1).as<Friction>()->at_rest == 0.3);
  CHECK(again.solver.method.as<Newton>()->integrator == Integrator::euler);
}

TEST_CASE("simulate: all mistakes of a scene are reported at once, with pointers", "[scene]") {
  Scene scene;
  scene.mesh.cells = 0;
  scene.material.density = -1;
  scene.effects = {Gravity{}, Gravity{}, ViscousDrag{.coefficient = -2}};
  const std::string text = refused(scene);
  CHECK_THAT(text, ContainsSubstring("/mesh/cells") && ContainsSubstring("/material/density") &&
                       ContainsSubstring("/effects/1") && ContainsSubstring("/effects/2/coefficient"));
}

TEST_CASE("simulate: a setting that nothing reads is refused", "[scene]") {
  Scene scene;
  scene.bending.k = 0.7;  // but its stiffness is physical
  CHECK_THAT(refused(scene),
             ContainsSubstring("/bending/k") && ContainsSubstring("nothing reads this setting"));
  scene.bending.stiffness = Stiffness::k;
  CHECK_THAT(refused(scene), ContainsSubstring("/bending/stiffness"));  // quasi_newton does not support k
}

TEST_CASE("simulate: a user's structs need no registration", "[scene]") {
  Scene scene;
  scene.pins.vertices = {};
  scene.bending.model = Loose{};
  scene.effects = {Push{.acceleration = 3}};
  scene.solver.method = Ballistic{};
  Cloth cloth = simulate(scene);
  cloth.run(0.5);
  // v += h a comes before x += h v, so vertices move by a h² n (n + 1) / 2 in n substeps of h.
  const double n = 0.5 * 60 * 4, h = 0.5 / n;
  const double moved = 3 * h * h * n * (n + 1) / 2;
  CHECK((cloth.positions().col(2).array() - moved).abs().maxCoeff() < 1e-12);
}

TEST_CASE("simulate: a scene may have a user's mesh", "[scene]") {
  Scene scene;
  scene.mesh.given = std::make_shared<TriangleMesh>(equilateral(1, 1, 8));
  scene.pins = {.vertices = {}, .indices = {0}};
  Cloth cloth = simulate(scene);
  CHECK(cloth.positions().isApprox(scene.mesh.given->positions, 1e-6));  // rounding of single precision
  cloth.step();
  CHECK(cloth.triangles() == scene.mesh.given->triangles);
}

}  // namespace bendlab::simulate_test
