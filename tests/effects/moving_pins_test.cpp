// Moving pins follow their keyframes.
#include <numbers>

#include "bendlab/scene/built_scene.hpp"
#include "experiments/config/experiment.hpp"
#include "tests/catch.hpp"
#include "tests/effects/one_pass.hpp"

namespace bendlab::moving_pins_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Numbers = std::vector<double>;
using Names = std::vector<std::string>;

// A sheet that hangs on pins, which move by `settings`.
template <class Real>
std::unique_ptr<Simulation> hanging(const RestMesh& rest, const Pins& pins, test::Changes settings, double dt,
                                    int substeps = 1, double rate = 0) {
  SimulationInput input = test::sheet(rest, pins, "crossover");
  input.settings.dt = dt, input.settings.substeps = substeps;
  auto passes = test::passes_of<Real>("moving_pins", rest, pins, settings);
  passes.push_back(test::effect_passes<Real>("gravity").front());
  if (rate > 0) passes.push_back(test::effect_passes<Real>("rigid_damping", "rate", rate).front());
  return make_simulation<Real>(input, std::move(passes));
}

Vector3 row(const Positions& positions, int vertex) {
  return positions.row(vertex).transpose();
}

// The problems with which a scene with this effect is refused.
ConfigProblems problems_of(const std::string& effect) {
  const std::string config =
      R"({"name": "t", "defaults": "paper",
          "mesh": {"cells": 4}, "pins": {"vertices": ["upper_left"], "ring": 0},)"
      R"("effects": [{"type": "gravity"}, {"type": "moving_pins", )" +
      effect + "}]}";
  try {
    simulation_of(build_scene(parse_experiment(config, "test").runs.at(0).scene()));
  } catch (const ConfigError& error) {
    return error.problems();
  }
  return {};
}

}  // namespace

// The solver's position is Real(start + offset(t)). Here start is relative to the origin, and t is the start
// of the substep plus h. The test computes this again, in steps that the compiler must not fuse (volatile).
TEMPLATE_TEST_CASE("moving pins follow their keyframes to the last bit", "[effects]", float, double) {
  using Real = TestType;
  const RestMesh rest(grid(1, 1, 6, 6));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::top), 0);
  const Vector3 target(0.7, -0.3, 1.1);
  const double last = 0.35, dt = 1.0 / 60;
  for (const int substeps : {1, 3}) {
    const auto simulation = hanging<Real>(
        rest, pins, {{"times", Numbers{0, last}}, {"offsets", Numbers{0, 0, 0, 0.7, -0.3, 1.1}}}, dt,
        substeps);
    const double h = dt / substeps;
    for (int step = 1; step <= 30; ++step) {
      const volatile double before = (step * substeps - 1) * h;
      const double now = before + static_cast<double>(static_cast<Real>(h));
      REQUIRE(simulation->step());
      const Positions positions = simulation->positions();
      for (const int pin : pins.all)
        for (int axis = 0; axis < 3; ++axis) {
          const auto start = static_cast<Real>(rest.position(pin)(axis) - rest.centre()(axis));
          const volatile double offset = now < last ? now / last * target(axis) : target(axis);
          const volatile auto expected = static_cast<Real>(static_cast<double>(start) + offset);
          REQUIRE(positions(pin, axis) == static_cast<double>(expected) + rest.centre()(axis));
        }
    }
    for (const int pin : pins.all)  // at rest after the last keyframe
      CHECK(simulation->velocities().row(pin).norm() == 0);
  }
}

TEST_CASE("moving pins: between keyframes, before and after", "[effects]") {
  const RestMesh rest(grid(1, 1, 4, 4));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 0);
  const auto offset_at = [&](const char* interpolation, double time) {
    auto passes = test::passes_of<double>("moving_pins", rest, pins,
                                          {{"times", Numbers{1, 2, 4}},
                                           {"offsets", Numbers{0.5, 0, 0, 1, 2, 0, 1, 0, -4}},
                                           {"interpolation", std::string(interpolation)}});
    State<double> state = test::state_of<double>(rest, pins);
    test::run(passes, state, 0, time);
    const auto pin = static_cast<std::size_t>(pins.all.front());
    return Vector3(state.position[pin].vector() - state.previous[pin].vector());
  };
  const auto close = [](const Vector3& a, const Vector3& b) { return (a - b).norm() < 1e-15; };
  for (const char* interpolation : {"linear", "smooth"}) {
    CHECK(close(offset_at(interpolation, 0), {0.5, 0, 0}));
    CHECK(close(offset_at(interpolation, 1), {0.5, 0, 0}));
    CHECK(close(offset_at(interpolation, 2), {1, 2, 0}));
    CHECK(close(offset_at(interpolation, 3), {1, 1, -2}));
    CHECK(close(offset_at(interpolation, 9), {1, 0, -4}));
  }
  CHECK(close(offset_at("linear", 1.25), {0.625, 0.5, 0}));
  // 3 s² - 2 s³ = 5/32 at s = 1/4
  CHECK(close(offset_at("smooth", 1.25), {0.5 + 0.5 * 5 / 32, 2.0 * 5 / 32, 0}));
}

TEST_CASE("moving pins turn about an axis, then shift", "[effects]") {
  const RestMesh rest(grid(1, 1, 4, 4));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 0);
  auto passes = test::passes_of<double>("moving_pins", rest, pins,
                                        {{"times", Numbers{0, 1}},
                                         {"offsets", Numbers{0, 0, 0, 0, 0, 3}},
                                         {"angles", Numbers{0, 180}},
                                         {"axis", Numbers{0, 0, 2}},
                                         {"centre", Numbers{1, 2, 7}}});
  State<double> state = test::state_of<double>(rest, pins);
  state.origin = {0.5, 0.5, 0};  // positions are relative to this origin
  for (const double time : {0.5, 1.0}) {
    State<double> moved = state;
    test::run(passes, moved, 0, time);
    for (const int pin : pins.all) {
      const auto i = static_cast<std::size_t>(pin);
      const Vector3 r = state.position[i].vector() + state.origin - Vector3(1, 2, 7);
      const Vector3 turned = time < 1 ? Vector3(-r.y(), r.x(), r.z()) : Vector3(-r.x(), -r.y(), r.z());
      const Vector3 expected = Vector3(1, 2, 7) + turned + Vector3(0, 0, 3 * time);
      CHECK((moved.position[i].vector() + state.origin - expected).norm() < 1e-14);  // roundings near 7
    }
  }
}

TEST_CASE("moving pins take along the pinned rings around them", "[effects]") {
  const RestMesh rest(grid(1, 1, 8, 8));
  std::vector<int> corners = select_vertices(rest, Place::upper_left);
  const int right = select_vertices(rest, Place::upper_right).front(), left = corners.front();
  corners.push_back(right);
  const Pins pins = make_pins(rest, corners, 1);
  auto passes = test::passes_of<double>(
      "moving_pins", rest, pins,
      {{"vertices", Names{"upper_left"}}, {"times", Numbers{0}}, {"offsets", Numbers{0, 0, 1}}});
  State<double> state = test::state_of<double>(rest, pins);
  const std::size_t held = make_pins(rest, {left}, 1).all.size();
  CHECK(test::run(passes, state, 0.1) == held);
  const Pins moving = make_pins(rest, {left}, 1);
  for (int v = 0; v < rest.vertex_count(); ++v)
    CHECK(state.position[static_cast<std::size_t>(v)].z == (moving.pinned(v) ? 1 : 0));
}

TEST_CASE("moving pins: the cloth follows two sides that move on their own paths", "[effects]") {
  const RestMesh rest(grid(1, 1, 12, 12));
  std::vector<int> sides = select_vertices(rest, Place::left);
  for (const int vertex : select_vertices(rest, Place::right)) sides.push_back(vertex);
  const Pins pins = make_pins(rest, sides, 0);
  SimulationInput input = test::sheet(rest, pins, "crossover");
  std::vector<Pass<double>> passes = test::effect_passes<double>("rigid_damping", "rate", 4.0);
  passes.push_back(test::effect_passes<double>("gravity").front());
  for (const char* side : {"left", "right"}) {  // both rise by 1 m and approach each other by 0.2 m
    const double inward = std::string(side) == "left" ? 0.1 : -0.1;
    passes.push_back(test::passes_of<double>("moving_pins", rest, pins,
                                             {{"vertices", Names{side}},
                                              {"times", Numbers{0, 1}},
                                              {"offsets", Numbers{0, 0, 0, inward, 0, 1}},
                                              {"interpolation", std::string("smooth")}})
                         .front());
  }
  const auto simulation = make_simulation<double>(input, std::move(passes));
  for (int s = 0; s < 360; ++s) REQUIRE(simulation->step());
  const Positions positions = simulation->positions();
  for (int v = 0; v < rest.vertex_count(); ++v) {
    // Cloth of length 1 between pins 0.8 apart hangs less than half its length below them.
    CHECK(positions(v, 2) < 1 + 1e-12);
    CHECK(positions(v, 2) > 0.5);
  }
  const int middle = select_vertices(rest, Place::centre).front();
  CHECK(std::abs(row(positions, middle).x() - rest.position(middle).x()) < 0.02);  // symmetric
  CHECK(row(positions, middle).z() < 0.8);
}

TEST_CASE("moving pins: a config with impossible settings is refused, with a pointer to the effect",
          "[effects]") {
  const auto refused = [](const std::string& effect, const std::string& text) {
    INFO(effect);
    const ConfigProblems problems = problems_of(effect);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].pointer == "/effects/1");
    CHECK_THAT(problems[0].message, ContainsSubstring(text));
  };
  const std::string moves = R"("times": [0, 1], "offsets": [0, 0, 0, 1, 0, 0])";
  CHECK(problems_of(moves).empty());
  refused(R"("vertices": ["upper_right"], )" + moves, "is not pinned");
  refused(R"("indices": [0], )" + moves, "vertex 0 is not pinned");
  CHECK(problems_of(R"("indices": [1.5], )" + moves).at(0).pointer == "/effects/1/indices/0");
  refused(R"("indices": [25], )" + moves, "vertices 0 to 24");
  refused(R"("times": [0, 1], "offsets": [0, 0, 0])", "expected 6");
  refused(R"("times": [0, 1], "angles": [0])", "expected 2");
  refused(R"("times": [0, 1, 1], "angles": [0, 10, 20])", "times must grow");
  refused(R"("times": [])", "at least one keyframe");
  refused(R"("times": [0], "angles": [10], "axis": [0, 0, 0])", "axis has no length");
}

TEST_CASE("moving pins have no pass if nothing moves or no vertex is pinned", "[effects]") {
  const RestMesh rest(grid(1, 1, 4, 4));
  const Pins pins = make_pins(rest, {0}, 0), none = make_pins(rest, {}, 0);
  const test::Changes moves = {{"offsets", Numbers{1, 0, 0}}};
  CHECK(test::passes_of<float>("moving_pins", rest, pins).empty());
  CHECK(test::passes_of<float>("moving_pins", rest, none, moves).empty());
  CHECK(test::passes_of<float>("moving_pins", rest, pins, moves).size() == 1);
}

}  // namespace bendlab::moving_pins_test
