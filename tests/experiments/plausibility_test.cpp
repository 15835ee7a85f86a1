// Every bound is broken by a pose that must break it, and kept by a pose that must keep it.
#include "experiments/run/plausibility.hpp"

#include <cmath>

#include "experiments/config/experiment.hpp"
#include "experiments/run/recorder.hpp"
#include "experiments/run/remedies.hpp"
#include "experiments/run/run.hpp"
#include "tests/catch.hpp"

namespace bendlab::plausibility_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

constexpr double g = 9.81;  // m/s², the default of gravity

BuiltScene scene_of(const std::string& settings) {
  return build_scene(parse_experiment(R"({"name": "bound", "defaults": "paper",
          )" + settings + "}",
                                      "test")
                         .runs.front()
                         .scene());
}

// A sheet of a metre that hangs on a corner, and a sheet without pins.
const std::string on_a_corner = R"("mesh": {"cells": 4}, "pins": {"vertices": ["upper_right"], "ring": 0})",
                  unpinned = R"("mesh": {"cells": 4}, "pins": {"vertices": []})";

Positions still(const BuiltScene& scene) {
  return Positions::Zero(scene.rest.vertex_count(), 3);
}

std::optional<BrokenBound> after(const BuiltScene& scene, double time, const Positions& positions,
                                 const Positions& velocities) {
  Plausibility plausibility(scene);
  plausibility.look(0, scene.input.positions, still(scene));
  plausibility.look(time, positions, velocities);
  return plausibility.broken();
}

// All vertices fall, but only by this share of the way and speed of a free fall.
std::optional<BrokenBound> falling(const BuiltScene& scene, double time, double share) {
  Positions positions = scene.input.positions, velocities = still(scene);
  positions.col(2).array() -= share * 0.5 * g * time * time;
  velocities.col(2).array() -= share * g * time;
  return after(scene, time, positions, velocities);
}

// A mean strain and a largest stretch from time `from` until `until`, checked at 30 frames per second.
std::optional<BrokenBound> stretched(const BuiltScene& scene, double from, double until, double largest,
                                     double mean) {
  Plausibility plausibility(scene);
  std::vector<PrincipalStretches> stretches(static_cast<std::size_t>(scene.rest.triangle_count()));
  for (int frame = 0; frame <= 60; ++frame) {
    const double time = frame / 30.0;
    const bool now = time >= from - 1e-9 && time <= until + 1e-9;
    stretches[5].largest = now ? largest : 1;
    plausibility.look_at_stretch(time, now ? mean : 0, stretches, scene.input.positions);
  }
  return plausibility.broken();
}

Bound bound_of(const std::optional<BrokenBound>& broken) {
  REQUIRE(broken);
  return broken->bound;
}

}  // namespace

TEST_CASE("plausible: a value that is not finite is reported with its vertex", "[plausibility]") {
  const BuiltScene scene = scene_of(on_a_corner);
  Positions positions = scene.input.positions;
  CHECK_FALSE(after(scene, 0.1, positions, still(scene)));
  positions(7, 1) = NAN;
  const auto broken = after(scene, 0.1, positions, still(scene));
  CHECK(bound_of(broken) == Bound::finite);
  CHECK(broken->vertex == 7);
  CHECK(broken->time == 0.1);
}

TEST_CASE("plausible: no vertex is farther from its pin than the length of cloth between them",
          "[plausibility]") {
  const BuiltScene scene = scene_of(on_a_corner + R"(, "bending": {"model": "none"})");
  const int far_corner = 0;  // lower left: diagonally opposite to the pin
  Positions positions = scene.input.positions;
  // On the other side of the pin, at the distance of the cloth's length: a possible pose.
  positions.row(far_corner) = Eigen::RowVector3d(0.5, 0.5, 0) + Eigen::RowVector3d(1, 1, 0);
  CHECK_FALSE(after(scene, 1, positions, still(scene)));
  positions.row(far_corner) = Eigen::RowVector3d(0.5, 0.5, -4);
  const auto broken = after(scene, 1, positions, still(scene));
  CHECK(bound_of(broken) == Bound::reach);
  CHECK(broken->vertex == far_corner);
  CHECK_THAT(broken->measured, WithinRel(4.0, 1e-12));
  CHECK(broken->limit > std::sqrt(2));
  CHECK(broken->correction.kind == "strain");  // its two triangles are torn
  CHECK(broken->correction.length > 1);
  CHECK_THAT(text_of(*broken), ContainsSubstring("at t = 1 s vertex 0 is 4 m away"));
}

TEST_CASE("plausible: pins that move apart may stretch the cloth between them by their own move",
          "[plausibility]") {
  const std::string pins = R"("mesh": {"cells": 4}, "pins": {"vertices": ["left", "right"], "ring": 0})";
  const BuiltScene moved = scene_of(pins + R"(, "effects": [{"type": "gravity"}, {"type": "moving_pins",
    "vertices": ["right"], "times": [0, 1], "offsets": [0, 0, 0, 5, 0, 0]}])");
  const BuiltScene held = scene_of(pins);
  Positions apart = held.input.positions;  // six times as wide, like the pins
  apart.col(0) *= 6;
  CHECK_FALSE(after(moved, 1, apart, still(moved)));
  Positions gone = apart;
  gone(12, 2) = -40;  // from the middle of the sheet
  CHECK(bound_of(after(moved, 1, gone, still(moved))) == Bound::reach);
  CHECK(bound_of(after(held, 1, gone, still(held))) == Bound::reach);
}

TEST_CASE("plausible: unpinned cloth falls freely", "[plausibility]") {
  const BuiltScene scene = scene_of(unpinned);
  CHECK_FALSE(falling(scene, 0.5, 1));
  CHECK_FALSE(falling(scene, 0.5, 1.005));
  // Wrong free falls that occurred in single precision: 1.201 m instead of 1.226 m, and 0.53 m.
  CHECK(bound_of(falling(scene, 0.5, 1.201 / 1.226)) == Bound::momentum);
  const auto broken = falling(scene, 0.5, 0.53 / 1.226);
  CHECK(bound_of(broken) == Bound::momentum);
  CHECK_THAT(broken->measured, WithinRel(g * 0.5 * (1 - 0.53 / 1.226), 1e-9));
  // Even with the right velocity, the position shows that the cloth did not fall far enough.
  Positions velocities = still(scene);
  velocities.col(2).array() -= g * 0.5;
  CHECK(bound_of(after(scene, 0.5, scene.input.positions, velocities)) == Bound::fall);
  // The cloth may fall more slowly if a pin, a table or air holds or brakes it.
  for (const char* effect : {R"({"type": "plane", "point": [0, 0, -0.1], "normal": [0, 0, 1]})",
                             R"({"type": "viscous_drag", "coefficient": 1})"})
    CHECK_FALSE(
        falling(scene_of(unpinned + R"(, "effects": [{"type": "gravity"}, )" + effect + "]"), 0.5, 0.1));
  CHECK_FALSE(falling(scene_of(on_a_corner), 0.5, 0.1));
}

TEST_CASE("plausible: without gravity the centre of mass keeps its velocity up to rounding",
          "[plausibility]") {
  const BuiltScene scene = scene_of(unpinned + R"(, "effects": [], "initial": {"velocity": [1, 0, 0]})");
  Positions positions = scene.input.positions, velocities = still(scene);
  positions.col(0).array() += 2;
  velocities.col(0).array() += 1;
  CHECK_FALSE(after(scene, 2, positions, velocities));
  velocities.col(1).array() += 0.1;
  CHECK(bound_of(after(scene, 2, positions, velocities)) == Bound::momentum);
}

TEST_CASE("plausible: no vertex is much faster than a free fall, unless an effect drives it",
          "[plausibility]") {
  const std::string held = on_a_corner;
  const BuiltScene scene = scene_of(held);
  Positions velocities = still(scene);
  velocities(0, 2) = -std::sqrt(2 * g * 3);  // a fall of three metres
  CHECK_FALSE(after(scene, 1, scene.input.positions, velocities));
  velocities(0, 2) = -50;
  const auto broken = after(scene, 1, scene.input.positions, velocities);
  CHECK(bound_of(broken) == Bound::speed);
  CHECK(broken->vertex == 0);
  for (const char* driving :
       {R"({"type": "wind", "velocity": [30, 0, 0]})",
        R"({"type": "moving_pins", "times": [0, 1], "offsets": [0, 0, 0, 50, 0, 0]})",
        R"({"type": "sphere", "centre": [0, 0, -3], "radius": 0.1, "velocity": [0, 0, 9]})"})
    CHECK_FALSE(after(scene_of(held + R"(, "effects": [{"type": "gravity"}, )" + driving + "]"), 1,
                      scene.input.positions, velocities));
  // A pose that is stretched at the start has energy, and k does not determine how much.
  const BuiltScene strained = scene_of(held + R"(, "initial": {"scale": [2, 2, 1]})");
  CHECK_FALSE(after(strained, 1, strained.input.positions, velocities));
}

TEST_CASE("plausible: cloth without forces may move by rounding and by the disturbance of its start",
          "[plausibility]") {
  const BuiltScene scene = scene_of(unpinned + R"(, "effects": [])");
  Positions velocities = still(scene);                // 6 and 7 are inner vertices, of equal mass
  velocities(6, 0) = 1e-5, velocities(7, 0) = -1e-5;  // ε x / h is 5e-6 m/s
  CHECK_FALSE(after(scene, 1, scene.input.positions, velocities));
  velocities(6, 0) = 1, velocities(7, 0) = -1;
  CHECK(bound_of(after(scene, 1, scene.input.positions, velocities)) == Bound::speed);
  // A strain of a thousandth over 1.4 m may relax in 1/60 s.
  const BuiltScene disturbed = scene_of(unpinned + R"(, "effects": [], "initial": {"scale": [1.001, 1, 1]})");
  velocities(6, 0) = 0.08, velocities(7, 0) = -0.08;
  CHECK_FALSE(after(disturbed, 1, disturbed.input.positions, velocities));
}

TEST_CASE("plausible: kinetic energy must come from the fall of the weight", "[plausibility]") {
  const BuiltScene scene = scene_of(on_a_corner);
  Positions positions = scene.input.positions, velocities = still(scene);
  positions.col(2).array() -= 0.3, positions.row(24) = scene.input.positions.row(24);
  velocities.col(2).setConstant(-std::sqrt(2 * g * 0.3));
  CHECK_FALSE(after(scene, 1, positions, velocities));
  // The cloth is up again, but as fast as before.
  positions.col(2).array() += 0.7, positions.row(24) = scene.input.positions.row(24);
  const auto broken = after(scene, 1, positions, velocities);
  CHECK(bound_of(broken) == Bound::energy);
  const double weight = 0.2 * g;  // N, of a square metre
  CHECK_THAT(broken->measured,
             WithinRel(weight * (0.3 + 0.4), 0.1));  // without the share of the pinned vertex
}

TEST_CASE("plausible: keyframes of a stiffness may add energy", "[plausibility]") {
  const auto broken = [](const std::string& over_time) {
    const BuiltScene scene = scene_of(on_a_corner + R"(, "bending": {"model": "discrete_shells",
        "flexural_rigidity": 1e-5)" + over_time +
                                      "}");
    Positions velocities = still(scene);
    velocities.col(2).setConstant(30);  // 10 times the speed of a fall of 0.5 s
    return after(scene, 0.3, scene.input.positions, velocities);
  };
  CHECK(broken(""));
  CHECK(broken(R"(, "over_time": {"times": [0, 0.3], "factors": [1, 1]})"));
  CHECK(broken(R"(, "over_time": {"times": [0, 0.3], "factors": [1, 0.1]})"));  // takes energy away
  CHECK_FALSE(broken(R"(, "over_time": {"times": [0, 0.3], "factors": [1, 1000]})"));
}

TEST_CASE("plausible: an inextensible membrane is twice as long for at most a moment", "[plausibility]") {
  const BuiltScene scene = scene_of(on_a_corner);
  CHECK_FALSE(stretched(scene, 0, 2, 1.9, 0.15));
  CHECK_FALSE(stretched(scene, 1, 1.2, 2.5, 0.15));
  const auto lasting = stretched(scene, 1, 2, 2.5, 0.15);
  CHECK(bound_of(lasting) == Bound::stretch);
  CHECK_THAT(lasting->time, WithinRel(1.5, 1e-9));  // half a second after the stretch began
  CHECK(lasting->vertex == scene.rest.triangles()(5, 0));
  CHECK(bound_of(stretched(scene, 1, 1, 20, 0)) == Bound::stretch);  // the paper's crossover on 64 cells
  CHECK(bound_of(stretched(scene, 1, 2, 1.9, 0.25)) == Bound::mean_strain);
  CHECK(bound_of(stretched(scene, 1, 1, 1.9, 0.4)) == Bound::mean_strain);
}

TEST_CASE("plausible: a membrane with a compliance may stretch by this compliance", "[plausibility]") {
  const auto with_strain = [](const std::string& strain) {
    return scene_of(on_a_corner + R"(, "material": {"strain": )" + strain + "}");
  };
  // A sheet of 0.2 kg with edges of 0.25 m hangs on a vertex. 2 N on 0.25 m strain a membrane of 0.1 m/N by
  // 0.8.
  const BuiltScene soft = with_strain(R"({"stiffness": "compliance", "compliance": 0.1})");
  CHECK_FALSE(stretched(soft, 0, 2, 1 + 4 * 0.8, 0.5));
  CHECK(stretched(soft, 0, 2, 100, 0.5));
  // 1 µm/N does not change the limit noticeably.
  const BuiltScene stiff = with_strain(R"({"stiffness": "compliance", "compliance": 1e-6})");
  CHECK(bound_of(stretched(stiff, 0, 2, 3.3, 0)) == Bound::stretch);
  // Without a constraint along the weft the cloth may stretch. Without shear a triangle may be flat.
  CHECK_FALSE(stretched(with_strain(R"({"weft": 0})"), 0, 2, 100, 100));
  const BuiltScene sheared = with_strain(R"({"shear": 0})");
  CHECK_FALSE(stretched(sheared, 0, 2, std::sqrt(2), 0.9));
  CHECK(stretched(sheared, 0, 2, 5, 0.9));
  // A pose that is stretched at the start may stay stretched.
  const BuiltScene strained = scene_of(on_a_corner + R"(, "initial": {"scale": [10, 10, 1]})");
  CHECK_FALSE(stretched(strained, 0, 2, 10, 9));
  CHECK(stretched(strained, 0, 2, 20, 9));
}

TEST_CASE("plausible: the first broken bound is kept, and is read back from JSON", "[plausibility]") {
  const BuiltScene scene = scene_of(on_a_corner);
  Plausibility plausibility(scene);
  Positions positions = scene.input.positions;
  positions(0, 2) = -40;
  plausibility.look(0.5, positions, still(scene));
  plausibility.look(0.6, 2 * positions, still(scene));
  const std::vector<PrincipalStretches> stretches(static_cast<std::size_t>(scene.rest.triangle_count()),
                                                  {.largest = 9});
  plausibility.look_at_stretch(0.4, 8, stretches, positions);
  const auto broken = plausibility.broken();
  REQUIRE(bound_of(broken) == Bound::stretch);
  CHECK(broken->time == 0.4);
  const auto back = broken_bound_of(to_json(*broken));
  REQUIRE(back);
  CHECK(text_of(*back) == text_of(*broken));
  CHECK_FALSE(broken_bound_of(Json::object()));
  CHECK_FALSE(broken_bound_of(Json()));
  Json vast = to_json(*broken);
  vast["vertex"] = 1e300;
  CHECK_FALSE(broken_bound_of(vast));
}

TEST_CASE("plausible: symmetric sweeps are advised if many substeps sweep forward", "[plausibility]") {
  const auto remedies = [](const std::string& solver) {
    return remedies_for(Bound::energy, scene_of(unpinned + R"(, "solver": {)" + solver + "}"));
  };
  CHECK_THAT(remedies(R"("substeps": 1024, "sweep": "forward")"),
             ContainsSubstring("/solver/sweep: symmetric"));
  CHECK_THAT(remedies(R"("substeps": 1024, "sweep": "symmetric")"), !ContainsSubstring("/solver/sweep"));
  const std::string pinned =
      remedies_for(Bound::energy, scene_of(on_a_corner + R"(, "solver": {"substeps": 1})"));
  CHECK_THAT(pinned, ContainsSubstring("tethers"));
  CHECK_THAT(remedies(R"("substeps": 10, "sweep": "forward")"), !ContainsSubstring("/solver/sweep"));
}

TEST_CASE("plausible: implicit steps may gain 1/50 of the energy scale, and projections 1/4",
          "[plausibility]") {
  const auto with_method = [](const std::string& solver) {
    return scene_of(on_a_corner + R"(, "bending": {"model": "none"},
        "material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}},
        "solver": {)" +
                    solver + "}");
  };
  // The whole sheet is 0.1 m higher and has the speed of a fall by 0.1 m. This is the energy of its weight
  // over 0.2 m; the energy scale is its weight over 1.41 m.
  const auto risen = [&](const std::string& solver) {
    const BuiltScene scene = with_method(solver);
    Positions positions = scene.input.positions, velocities = still(scene);
    positions.col(2).array() += 0.1, positions.row(24) = scene.input.positions.row(24);
    velocities.col(2).setConstant(-std::sqrt(2 * g * 0.1));
    return after(scene, 1, positions, velocities);
  };
  CHECK_FALSE(risen(R"("method": "pbd")"));
  for (const char* method : {"quasi_newton", "newton", "vbd"})
    CHECK(bound_of(risen(std::string(R"("method": ")") + method + '"')) == Bound::energy);

  const auto remedies = [&](const std::string& solver) {
    return remedies_for(Bound::energy, with_method(R"("method": "quasi_newton", )" + solver));
  };
  CHECK_THAT(remedies(R"("iterations": 3)"), ContainsSubstring("/solver/iterations: 30"));
  CHECK_THAT(remedies(R"("iterations": 3)"), !ContainsSubstring("euler"));
  CHECK_THAT(remedies(R"("iterations": 30, "integrator": "bdf2")"),
             ContainsSubstring("/solver/integrator: euler"));
  CHECK(remedies(R"("iterations": 30)").empty());
}

TEST_CASE("plausible: the correction of a vertex agrees with a computation by hand", "[plausibility]") {
  // A spring across the edge of two triangles is 0.3 m too long. Both ends move by half of this, but a pinned
  // end does not move.
  SimulationInput input{.method = Pbd{}};
  input.mass = {1, 1, 1};
  input.is_pinned = {0, 0, 1};
  input.distance.vertices = {{0, 1}, {1, 2}};
  input.distance.rest_length = {1, 1};
  Positions positions(3, 3);
  positions << 0, 0, 0, 1.3, 0, 0, 1.3, 1.1, 0;
  const Correction first = worst_correction(input, positions, 0),
                   second = worst_correction(input, positions, 1);
  CHECK(first.kind == "distance");
  CHECK_THAT(first.length, WithinRel(0.15, 1e-12));
  CHECK_THAT(second.length, WithinRel(0.15, 1e-12));
  CHECK(worst_correction(input, positions, 2).kind.empty());
  CHECK(worst_correction(input, positions, -1).kind.empty());
}

}  // namespace bendlab::plausibility_test
