// The limit on how much forces may deform the cloth in one substep: closed forms of the gradient and of the
// number of substeps, and the effect of the limit.
#include "bendlab/solver/force_steps.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "bendlab/solver/colouring.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::force_steps_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

// The largest gained gradient of a flat sheet whose velocities gain A x + (1, 2, 3) m/s.
template <class Real>
double gradient_of(const Eigen::Matrix3d& a) {
  const RestMesh rest(grid(1, 1, 5, 3));
  const SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "none");
  const StrainBatch<Real> batch = make_strain_batch<Real>(
      input.strain, colour_order<3>(input.strain.vertices, rest.vertex_count()), rest.vertex_count());
  Points<Real> before(static_cast<std::size_t>(rest.vertex_count() + dummy_points));
  std::mt19937_64 random(4);
  for (Point<Real>& velocity : before) velocity.set(test::random_vector(random).cast<Real>());
  Points<Real> after = before;
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const Vector3 gained = a * rest.positions().row(v).transpose() + Vector3(1, 2, 3);
    Point<Real>& velocity = after[static_cast<std::size_t>(v)];
    velocity.set(velocity.vector() + gained.cast<Real>());
  }
  return static_cast<double>(largest_gained_gradient(after.data(), before.data(), batch));
}

SimulationInput hanging_curtain(int cells, double dt, double limit) {
  const RestMesh rest(grid(1, 1, cells, cells));
  SimulationInput input =
      test::sheet(rest, make_pins(rest, select_vertices(rest, Place::top), 0), "crossover");
  input.settings.dt = dt, input.method = Pbd{.flight_limit = limit};
  return input;
}

std::unique_ptr<Simulation> falling(const SimulationInput& input) {
  return make_simulation<double>(
      input, test::effect_passes<double>("gravity", "acceleration", std::vector<double>{0, -9.81, 0}));
}

}  // namespace

TEMPLATE_TEST_CASE("the gradient of a linear gain of velocity is its matrix in the plane of the sheet",
                   "[force_steps]", float, double) {
  // Rounding of differences of velocities of a few m/s, over edges of at least 0.2 m.
  const double tolerance = 40 * static_cast<double>(std::numeric_limits<TestType>::epsilon());
  std::mt19937_64 random(3);
  Eigen::Matrix3d a;
  for (int i = 0; i < 9; ++i) a(i) = test::uniform(random, -1, 1);
  CHECK_THAT(gradient_of<TestType>(a), WithinAbs(a.leftCols<2>().norm(), tolerance));
  CHECK_THAT(gradient_of<TestType>(Eigen::Matrix3d::Zero()), WithinAbs(0, tolerance));
  Eigen::Matrix3d spin = Eigen::Matrix3d::Zero();  // 1.5 rad/s about the sheet's normal
  spin(0, 1) = -1.5, spin(1, 0) = 1.5;
  CHECK_THAT(gradient_of<TestType>(spin), WithinAbs(1.5 * std::numbers::sqrt2, tolerance));
}

TEST_CASE("the number of steps is the square root of the change over its limit", "[force_steps]") {
  CHECK(force_steps(0.3, 0.3) == 1);  // exactly at the limit
  CHECK(force_steps(0, 0.3) == 1);
  CHECK(force_steps(30, 0.3) == 10);
  CHECK(force_steps(31, 0.3) == 11);
  CHECK(force_steps(1e9, 0.3) == most_force_steps);
  CHECK(force_steps(std::numeric_limits<double>::infinity(), 0.3) == most_force_steps);
}

TEST_CASE("the step of a cloth that falls as a whole is not divided, and no bit changes", "[force_steps]") {
  const RestMesh rest(grid(1, 1, 8, 8));
  SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
  const auto plain = falling(input);
  input.method = Pbd{.flight_limit = 0.01};
  const auto limited = falling(input);
  for (int s = 0; s < 30; ++s) REQUIRE((plain->step() && limited->step()));
  CHECK(limited->substeps() == 30);
  CHECK(limited->positions() == plain->positions());
}

TEST_CASE("the fall of a curtain's top row decides how often its step is divided", "[force_steps]") {
  // The row below the pins falls by g h² in a step, and its triangles are 1/16 m high.
  const double limit = 0.25;
  const auto steps = static_cast<std::uint64_t>(std::ceil(std::sqrt(16 * 9.81 * 0.1 * 0.1 / limit)));
  const auto simulation = falling(hanging_curtain(16, 0.1, limit));
  for (std::uint64_t step = 1; step <= 20; ++step) {
    REQUIRE(simulation->step());
    CHECK(simulation->substeps() == step * steps);  // the same in each step, like gravity
  }
  CHECK_THAT(simulation->time(), WithinRel(2.0, 1e-12));  // a sum of a few roundings
  const double projections = static_cast<double>(simulation->projections());
  CHECK(std::fmod(projections, static_cast<double>(simulation->substeps() * 10)) == 0);
}

TEST_CASE("a divided step gives the same bits as the same number of substeps", "[force_steps]") {
  SimulationInput input = hanging_curtain(16, 0.1, 0.25);
  const auto cut = falling(input);
  input.method = Pbd{};
  input.settings.substeps = 3;  // 2.5 = √(16 · 9.81 · 0.01 / 0.25), rounded up
  const auto divided = falling(input);
  for (int step = 0; step < 10; ++step) REQUIRE((cut->step() && divided->step()));
  CHECK(cut->positions() == divided->positions());
}

TEST_CASE("a step of a second does not tear a curtain if the step may be divided", "[force_steps]") {
  const auto lowest = [](double limit) {
    const auto simulation = falling(hanging_curtain(16, 1, limit));
    double y = 0;
    for (int s = 0; s < 5; ++s) {
      REQUIRE(simulation->step());
      y = std::min(y, simulation->positions().col(1).minCoeff());
    }
    return y;
  };
  // The curtain reaches from y = 0.5 m to y = -0.5 m. In a second free vertices fall by 9.81 m.
  CHECK(lowest(0) < -5);
  CHECK(lowest(0.05) > -0.8);
}

}  // namespace bendlab::force_steps_test
