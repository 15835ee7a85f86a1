// Viscous drag agrees with the solutions of v' = -k v and v' = g - k v, with k = c / ρ.
#include "tests/catch.hpp"
#include "tests/effects/one_pass.hpp"

namespace bendlab::viscous_drag_test {
namespace {

using Catch::Matchers::WithinRel;

constexpr double gravity = 9.81, density = 0.2;  // m/s², kg/m² (of test::sheet and test::state_of)

// The terminal speed of a free sheet, m/s. Also checks that all vertices fall at this speed.
double terminal_speed(double coefficient, double dt) {
  const RestMesh rest(delaunay(1, 1, 6, 1));
  const Pins none = make_pins(rest, {}, 0);
  SimulationInput input = test::sheet(rest, none, "crossover");
  input.settings.dt = dt;
  auto passes = test::passes_of<double>("viscous_drag", rest, none, {{"coefficient", coefficient}});
  passes.push_back(test::effect_passes<double>("gravity").front());  // the stage damp comes after force
  const auto simulation = make_simulation<double>(input, std::move(passes));
  const double relaxation = density / coefficient;
  for (int s = 0; s < 30 * relaxation / dt; ++s)
    REQUIRE(simulation->step());  // until the difference from the terminal speed is exp(-30)
  const Positions velocities = simulation->velocities();
  CHECK(velocities.leftCols<2>().cwiseAbs().maxCoeff() < 1e-9);
  CHECK_THAT(velocities.col(2).minCoeff(), WithinRel(velocities.col(2).maxCoeff(), 1e-9));
  return -velocities.col(2).mean();
}

}  // namespace

TEST_CASE("viscous drag: the terminal speed of a sheet is ρ g / c", "[effects]") {
  const double coefficient = 0.4, k = coefficient / density;
  for (const double dt : {1.0 / 240, 1.0 / 60}) {
    const double speed = terminal_speed(coefficient, dt);
    // (v + g dt) exp(-k dt) = v. The tolerance is the rounding of (x - x') / dt about 30 m down.
    CHECK_THAT(speed, WithinRel(gravity * dt / std::expm1(k * dt), 1e-9));
    // This is the law up to a relative k dt / 2.
    CHECK_THAT(speed, WithinRel(density * gravity / coefficient, 1.01 * k * dt / 2));
  }
  CHECK_THAT(terminal_speed(0.1, 1.0 / 60), WithinRel(density * gravity / 0.1, 0.01));  // the default
}

TEMPLATE_TEST_CASE("viscous drag is a rate and never reverses a velocity", "[effects]", float, double) {
  const RestMesh rest(delaunay(1, 1, 8, 2));
  const Pins pins = make_pins(rest, {3}, 1);
  const State<TestType> start = [&] {
    State<TestType> state = test::state_of<TestType>(rest, pins);
    std::mt19937_64 random(1);
    for (std::size_t v = 0; v < state.mass.size(); ++v)
      state.velocity[v].set(test::random_vector(random, 3).cast<TestType>());
    return state;
  }();
  auto passes = test::passes_of<TestType>("viscous_drag", rest, pins, {{"coefficient", 0.7}});
  const double rounding = 8 * static_cast<double>(std::numeric_limits<TestType>::epsilon());
  for (const double h : {1e-3, 0.1, 1e6}) {
    State<TestType> once = start, twice = start;
    CHECK(test::run(passes, once, h) > 0);
    test::run(passes, twice, h / 2), test::run(passes, twice, h / 2);
    CHECK(test::kinetic_energy(once) < test::kinetic_energy(start));
    for (int v = 0; v < rest.vertex_count(); ++v) {
      const auto i = static_cast<std::size_t>(v);
      if (pins.pinned(v)) {  // drag does not act on pins
        CHECK(once.velocity[i].vector() == start.velocity[i].vector());
        continue;
      }
      const double before = start.velocity[i].x, after = once.velocity[i].x, halved = twice.velocity[i].x;
      const double exact = before * std::exp(-0.7 / density * h);
      // The rounding of x is the relative error of exp(-x).
      CHECK(std::abs(after - exact) <= rounding * (std::abs(before) + 3.5 * h * std::abs(exact)));
      CHECK(std::abs(halved - after) <= rounding * std::abs(before));
      CHECK(after * before >= 0);
    }
  }
}

TEST_CASE("viscous drag with a coefficient of zero has no pass", "[effects]") {
  const RestMesh rest(grid(1, 1, 2, 2));
  const Pins none = make_pins(rest, {}, 0);
  CHECK(test::passes_of<float>("viscous_drag", rest, none, {{"coefficient", 0.0}}).empty());
  CHECK(test::passes_of<float>("viscous_drag", rest, none).size() == 1);
}

}  // namespace bendlab::viscous_drag_test
