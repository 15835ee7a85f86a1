// Hard scenes as stated in configs, and the stability metrics of their runs.
#include "experiments/measures/stability.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <set>

#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"

namespace bendlab::stability_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

BuiltScene scene_of(const std::string& rest, const std::string& effects = "[]") {
  return build_scene(parse_experiment(R"({"name": "hard", "defaults": "paper",
          "mesh": {"cells": 8}, "pins": {"vertices": []}, )" +
                                          rest + R"(, "effects": )" + effects + "}",
                                      "test")
                         .runs.front()
                         .scene());
}

std::map<std::string, double> stability_of(const BuiltScene& scene, double duration) {
  StabilityMeter meter(scene, duration);
  const std::unique_ptr<Simulation> simulation = simulation_of(scene);
  meter.look(*simulation);
  while (simulation->time() < duration - 1e-9 && simulation->step()) meter.look(*simulation);
  return meter.summary();
}

}  // namespace

TEST_CASE("start poses: scaling is about the centre or the pins", "[experiments]") {
  const BuiltScene point = scene_of(R"("initial": {"scale": [0, 0, 0]})");
  CHECK(point.input.positions.isZero(0));
  const BuiltScene mirrored = scene_of(R"("initial": {"scale": [-1, 1, 1]})");
  CHECK(mirrored.input.positions.col(0) == -mirrored.rest.positions().col(0));
  const BuiltScene held = build_scene(parse_experiment(
                                          R"({"name": "held", "defaults": "paper",
          "mesh": {"cells": 8}, "pins": {"vertices": ["upper_right"], "ring": 1},
                           "initial": {"scale": [2, 2, 1]}})",
                                          "test")
                                          .runs.front()
                                          .scene());
  const Eigen::RowVector3d corner(0.5, 0.5, 0);
  for (int v = 0; v < held.rest.vertex_count(); ++v) {
    const Eigen::RowVector3d from_pin = held.rest.positions().row(v) - corner;
    CHECK(held.input.positions.row(v) == corner + (held.pins.pinned(v) ? 1 : 2) * from_pin);
  }
}

TEST_CASE("start poses: creases fold every column onto the previous one without stretch", "[experiments]") {
  const BuiltScene scene = scene_of(R"("initial": {"creases": 7})");
  const Positions& start = scene.input.positions;
  CHECK_THAT(start.col(0).maxCoeff() - start.col(0).minCoeff(), WithinRel(1.0 / 8, 1e-12));
  for (const auto& edge : scene.rest.edges().rowwise())
    CHECK_THAT((start.row(edge(0)) - start.row(edge(1))).norm(),
               WithinRel((scene.rest.position(edge(0)) - scene.rest.position(edge(1))).norm(), 1e-12));
  int shut = 0;
  for (const Hinge& hinge : scene.rest.hinges()) {
    const Vector3 edge = start.row(hinge.edge[1]) - start.row(hinge.edge[0]);
    const Vector3 n0 = edge.cross(Vector3(start.row(hinge.opposite[0]) - start.row(hinge.edge[0]))),
                  n1 = -edge.cross(Vector3(start.row(hinge.opposite[1]) - start.row(hinge.edge[0])));
    if (n0.dot(n1) < 0) ++shut;
  }
  CHECK(shut == 7 * 8);  // the edges along y between 8 columns
  CHECK_THROWS_AS(scene_of(R"("initial": {"creases": 3, "folds": 2})"), ConfigError);
}

TEST_CASE("start poses: random positions are in a box, and the same for the same seed", "[experiments]") {
  const auto start = [](int seed) {
    return scene_of(R"("initial": {"random": 10, "seed": )" + std::to_string(seed) + "}").input.positions;
  };
  const double half = 5 * std::numbers::sqrt2;
  CHECK(start(1).cwiseAbs().maxCoeff() <= half);
  CHECK(start(1).cwiseAbs().maxCoeff() > 0.9 * half);  // 243 uniform numbers fail with a probability of 10⁻¹¹
  CHECK(start(1) == start(1));
  CHECK(start(1) != start(2));
}

TEST_CASE("start velocities: a translation plus a spin about the centre", "[experiments]") {
  const BuiltScene scene = scene_of(R"("initial": {"velocity": [1, 2, 3], "spin": [0, 0, 4]})");
  for (int v = 0; v < scene.rest.vertex_count(); ++v) {
    const Vector3 p = scene.rest.position(v);
    CHECK(scene.input.velocities.row(v) == Eigen::RowVector3d(1 - 4 * p.y(), 2 + 4 * p.x(), 3));
  }
  CHECK(scene_of(R"("duration": 1)").input.velocities.rows() == 0);
}

TEST_CASE("density_ratio makes one half of the cloth heavier by this factor", "[experiments]") {
  const BuiltScene scene = scene_of(R"("material": {"density": 0.2, "density_ratio": 1000000})");
  double left = 0, right = 0;  // without the seam, whose vertices belong to both halves
  for (int v = 0; v < scene.rest.vertex_count(); ++v) {
    const double x = scene.rest.position(v).x(), mass = scene.input.mass[static_cast<std::size_t>(v)];
    if (x < -0.01) left += mass;
    if (x > 0.01) right += mass;
  }
  CHECK_THAT(right / left, WithinRel(1e6, 1e-9));
  CHECK_THAT(left, WithinRel(0.2 * (0.5 - 1.0 / 16), 1e-2));  // about half a column's mass is at the seam
}

TEST_CASE("configs can ask for a mesh far from the origin and for a flawed mesh", "[experiments]") {
  const BuiltScene far = build_scene(parse_experiment(R"({"name": "far", "defaults": "paper",
          "mesh": {"cells": 4, "scale": 2, "offset": [1000000, 0, -5]}})",
                                                      "test")
                                         .runs.front()
                                         .scene());
  CHECK(far.rest.centre() == Vector3(1e6, 0, -5));
  const auto flawed = [](const std::string& policy) {
    return build_scene(parse_experiment(
                           R"({"name": "flawed", "defaults": "paper",
          "mesh": {"flaw": "degenerate", "bad_triangles": ")" +
                               policy + R"("}})",
                           "test")
                           .runs.front()
                           .scene());
  };
  CHECK_THROWS_AS(flawed("refuse"), MeshError);
  CHECK(flawed("regularise").rest.triangle_count() == 2048);
}

TEST_CASE("vertices cannot be pinned by number if a repair renumbered them", "[experiments]") {
  const auto pinned = [](const std::string& policy) {
    return build_scene(parse_experiment(R"({"name": "flawed", "defaults": "paper",
          "pins": {"vertices": [], "indices": [3]},
          "mesh": {"flaw": "degenerate", "bad_triangles": ")" +
                                            policy + R"("}})",
                                        "test")
                           .runs.front()
                           .scene());
  };
  CHECK(pinned("regularise").pins.pinned(3));
  CHECK_THROWS_WITH(pinned("repair"), ContainsSubstring("/pins/indices"));
}

TEST_CASE("a sweep can run over all choices of a setting that the config allows", "[experiments]") {
  std::set<std::string> models;
  for (const RunConfig& run : parse_experiment(R"({"name": "all", "defaults": "paper",
          "sweep": {"/bending/model": "all"}})",
                                               "test")
                                  .runs)
    models.emplace(run.scene().bending.model.name());
  CHECK(models.size() == bending_models().size() - 1);  // k has no energy, which dkt needs
  CHECK_THROWS_WITH(parse_experiment(R"({"name": "all", "defaults": "paper",
          "sweep": {"/mesh/cells": "all"}})",
                                     "test"),
                    ContainsSubstring("/sweep/~1mesh~1cells"));
}

TEST_CASE("stability: the metrics of a free fall agree with the closed form of the step", "[experiments]") {
  // v = g h n, x = g h² n (n + 1) / 2 after n steps. So the energy per mass falls by g² h² / 2 in each step.
  const int steps = 60;
  const double h = 1.0 / 60, g = 9.81, size = std::numbers::sqrt2;
  const auto seen =
      stability_of(scene_of(R"("bending": {"model": "dihedral"}, "solver": {"precision": "double"})",
                            R"([{"type": "gravity"}])"),
                   1);
  CHECK(seen.at("stability_steps") == steps);
  CHECK_THAT(seen.at("stability_reach"), WithinRel(0.5, 1e-9));
  CHECK(seen.at("stability_recovered_at") == 0);
  CHECK_THAT(seen.at("stability_rest_distance"), WithinAbs(0, 1e-12));
  CHECK(seen.at("stability_momentum_drift") < 1e-10);
  CHECK_THAT(seen.at("stability_energy_gain"), WithinAbs(0, 1e-12));
  CHECK(seen.at("stability_energy_rises") == 0);
  CHECK_THAT(seen.at("stability_energy_scale"), WithinRel(0.2 * g * size, 1e-9));
  const auto fallen = [&](int n) { return g * h * h * n * (n + 1) / 2; };
  CHECK_THAT(seen.at("stability_creep"), WithinRel((fallen(60) - fallen(30)) / size, 1e-9));
  CHECK(seen.at("stability_shut_hinges") == 0);
  const auto half =
      stability_of(scene_of(R"("solver": {"precision": "double"})", R"([{"type": "gravity"}])"), 0.5);
  CHECK_THAT(half.at("stability_creep"), WithinRel((fallen(30) - fallen(15)) / size, 1e-9));
}

TEST_CASE("stability: cloth without bending stays folded, and pinned cloth has no momentum drift",
          "[experiments]") {
  // Without bending resistance a creased sheet has no strain and no force, so it does not move.
  const auto folded =
      stability_of(scene_of(R"("initial": {"creases": 7}, "bending": {"model": "none"})"), 0.5);
  const double interior = 3 * 8 * 8 - 2 * 8;
  CHECK_THAT(folded.at("stability_shut_hinges"), WithinRel(7 * 8 / interior, 1e-9));
  CHECK(folded.at("stability_rest_distance") > 0.1);
  CHECK(folded.count("stability_recovered_at") == 0);
  CHECK(folded.at("stability_creep") == 0);

  const BuiltScene pinned = build_scene(parse_experiment(R"({"name": "pinned", "defaults": "paper",
          "mesh": {"cells": 8}})",
                                                         "test")
                                            .runs.front()
                                            .scene());
  const auto held = stability_of(pinned, 0.5);
  CHECK(held.count("stability_momentum_drift") == 0);  // pins exert forces
  CHECK(held.count("stability_energy_gain") == 1);
}

TEST_CASE("stability: the energy of a tumbling sheet is elastic or kinetic, and never exceeds the start",
          "[experiments]") {
  const std::string tumbling =
      R"("initial": {"spin": [5, 0, 0]},
         "bending": {"model": "discrete_shells", "stiffness": "compliance", "compliance": 100000},
         "material": {"strain": {"stiffness": "compliance", "compliance": 0.001}},
         "solver": {"substeps": 8, "precision": "double"})";
  const auto seen = stability_of(scene_of(tumbling), 1);
  // The sheet starts flat, so its energy at the start is ½ I ω². I = ρ h ∫ y² for point masses on lines 1/8
  // apart.
  double inertia = 0;
  for (int row = 0; row <= 8; ++row) {
    const double y = -0.5 + row / 8.0, mass = 0.2 / 8 * (row == 0 || row == 8 ? 0.5 : 1);
    inertia += mass * y * y;
  }
  CHECK_THAT(seen.at("stability_energy_scale"), WithinRel(0.5 * inertia * 25, 1e-9));
  CHECK(seen.at("stability_energy_gain") < 0.01);
  CHECK(seen.at("stability_spin_kept") > 0.5);
  CHECK(seen.at("stability_spin_kept") < 1.001);
}

}  // namespace bendlab::stability_test
