// Coulomb friction, compared with the block on an incline and with a turntable.
#include <numbers>

#include "tests/catch.hpp"
#include "tests/effects/obstacles.hpp"

namespace bendlab::friction_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using test::add_effect, test::list, test::Settings;

constexpr double g = 9.81, thickness = 0.005;

// A sheet that starts at rest on a plane, which is turned by θ about y. Downhill is the turned x axis.
template <class Real>
std::unique_ptr<Simulation> on_incline(const RestMesh& rest, double angle, const Settings& friction,
                                       int iterations, int substeps, const char* model = "crossover") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, Vector3::UnitY()).toRotationMatrix();
  const Vector3 normal = turn * Vector3::UnitZ();
  SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), model);
  input.positions = (rest.positions() * turn.transpose()).rowwise() + thickness * normal.transpose();
  input.settings.iterations = iterations, input.settings.substeps = substeps;
  std::vector<Pass<Real>> passes = test::effect_passes<Real>("gravity");
  add_effect(passes, "plane", rest, {{"normal", list(normal)}, {"thickness", thickness}});
  add_effect(passes, "friction", rest, friction);
  return make_simulation<Real>(input, std::move(passes));
}

Vector3 downhill(double angle) {
  return {std::cos(angle), 0, -std::sin(angle)};
}

Vector3 mean(const Positions& rows) {
  return rows.colwise().mean().transpose();
}

}  // namespace

TEMPLATE_TEST_CASE("a sheet on an incline slides if tan θ > μ", "[effects][friction]", float, double) {
  const RestMesh rest(delaunay(0.5, 0.5, 10, 3));
  for (const double mu : {0.2, 0.6})
    for (const auto& [iterations, substeps] : {std::pair(1, 1), std::pair(5, 1), std::pair(10, 4)}) {
      INFO("μ " << mu << ", iterations " << iterations << ", substeps " << substeps);
      const auto slid = [&](double tangent) {
        const double angle = std::atan(tangent);
        const auto simulation =
            on_incline<TestType>(rest, angle, {{"static", mu}, {"kinetic", mu}}, iterations, substeps);
        const Vector3 start = mean(simulation->positions());
        for (int s = 0; s < 60; ++s) REQUIRE(simulation->step());
        return (mean(simulation->positions()) - start).dot(downhill(angle));
      };
      CHECK(std::abs(slid(0.98 * mu)) < 1e-5);
      // Above the angle of friction the way is ½ a t² with a = g (sin θ - μ cos θ). At 2 % above, ½ a is
      // about 0.02 g μ cos³ θ / 2.
      CHECK(slid(1.02 * mu) > 0.25 * 0.02 * g * mu * std::pow(1 + mu * mu, -0.5));
    }
}

TEMPLATE_TEST_CASE("a sliding sheet accelerates by g (sin θ - μ cos θ)", "[effects][friction]", float,
                   double) {
  const RestMesh rest(delaunay(0.5, 0.5, 10, 3));
  const double angle = 0.6, mu = 0.3, expected = g * (std::sin(angle) - mu * std::cos(angle));
  for (const auto& [iterations, substeps] : {std::pair(1, 1), std::pair(5, 1), std::pair(10, 4)}) {
    INFO("iterations " << iterations << ", substeps " << substeps);
    const auto simulation =
        on_incline<TestType>(rest, angle, {{"static", 1.2 * mu}, {"kinetic", mu}}, iterations, substeps);
    for (int s = 0; s < 60; ++s) REQUIRE(simulation->step());
    // The velocity of symplectic Euler is exact under a constant force. 2 % allows for float, which rounds
    // the depth of 3e-4 m by 1e-7.
    CHECK_THAT(mean(simulation->velocities()).dot(downhill(angle)),
               WithinRel(expected * simulation->time(), 0.02));
  }
}

TEST_CASE("static friction sets the threshold of sliding, kinetic friction the acceleration",
          "[effects][friction]") {
  const RestMesh rest(delaunay(0.5, 0.5, 10, 3));
  const double angle = std::atan(0.5);
  const auto slid = [&](double at_rest) {
    const auto simulation = on_incline<double>(rest, angle, {{"static", at_rest}, {"kinetic", 0.1}}, 5, 1);
    for (int s = 0; s < 60; ++s) REQUIRE(simulation->step());
    return mean(simulation->velocities()).dot(downhill(angle));
  };
  CHECK(std::abs(slid(0.51)) < 1e-9);
  CHECK_THAT(slid(0.49), WithinRel(g * (std::sin(angle) - 0.1 * std::cos(angle)), 0.02));
}

TEST_CASE("friction stops a sliding sheet and does not reverse its motion", "[effects][friction]") {
  const RestMesh rest(grid(0.5, 0.5, 6, 6));
  SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
  input.positions.col(2).setConstant(thickness);
  input.velocities = Positions::Zero(rest.vertex_count(), 3);
  input.velocities.col(0).setConstant(2);
  for (const double kinetic : {0.4, 50.0}) {  // without a bound, 50 would throw the sheet back
    std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
    add_effect(passes, "plane", rest, {{"thickness", thickness}});
    add_effect(passes, "friction", rest, {{"static", 0.4}, {"kinetic", kinetic}});
    const auto simulation = make_simulation<double>(input, std::move(passes));
    double slowest = 2;
    for (int s = 0; s < 60; ++s) {
      REQUIRE(simulation->step());
      slowest = std::min(slowest, simulation->velocities().col(0).minCoeff());
    }
    CHECK(slowest > -1e-9);
    CHECK_THAT(simulation->velocities().norm(), WithinAbs(0, 1e-9));
    // The way is v² / (2 μ g), up to the way of one step.
    if (kinetic < 1)
      CHECK_THAT(mean(simulation->positions()).x(), WithinAbs(2 * 2 / (2 * 0.4 * g), 2.0 / 60));
  }
}

TEST_CASE("friction also holds vertices that strain moves after the first push", "[effects][friction]") {
  // A stretched sheet on a table: without friction its strain pulls it together.
  const RestMesh rest(delaunay(0.5, 0.5, 10, 3));
  const auto moved = [&](double friction) {
    SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
    input.positions *= 1.01;
    input.positions.col(2).setConstant(thickness);
    const Positions start = input.positions;
    std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
    add_effect(passes, "plane", rest, {{"thickness", thickness}});
    add_effect(passes, "friction", rest, {{"static", friction}, {"kinetic", friction}});
    const auto simulation = make_simulation<double>(input, std::move(passes));
    for (int s = 0; s < 10; ++s) REQUIRE(simulation->step());
    return (simulation->positions() - start).cwiseAbs().maxCoeff();
  };
  CHECK(moved(0) > 1e-3);
  CHECK(moved(100) < 1e-12);  // friction of 100 g outweighs the strain of 1 %
}

TEST_CASE("friction moves no vertex into the surface that pushed it last", "[effects][friction]") {
  const RestMesh rest = test::vertices(1);
  std::vector<Pass<double>> passes;
  add_effect(passes, "friction", rest, {{"static", 1.0}, {"kinetic", 1.0}});
  REQUIRE(passes.size() == 1);
  State<double> state;
  state.vertex_count = 1, state.mass = {1};
  state.position = {{0.003, 0, 0, 1}}, state.previous = {{0, 0, 0, 1}};
  const Constraints<double> none;
  PassContext<double> context{state, none, 0.01};
  // A floor pushes the vertex, then a slope at its foot. The straight way back to the start leads through the
  // slope.
  state.contacts = {{0, Vector3(0, 0, 1), 0.002, Vector3::Zero()}};
  passes[0].run(context);
  CHECK_THAT(state.position[0].x, WithinAbs(0.001, 1e-15));  // friction takes back μ D = 2 mm of 3 mm
  const Vector3 slope = Vector3(1, 0, 1).normalized(), before = state.position[0].vector();
  state.contacts = {{0, slope, 0.001, Vector3::Zero()}};
  passes[0].run(context);
  CHECK((state.position[0].vector() - before).dot(slope) >= -1e-15);  // rounding
  CHECK(state.contacts.empty());
}

TEST_CASE("a turntable carries the cloth around", "[effects][friction]") {
  const RestMesh rest(delaunay(0.3, 0.3, 8, 2));
  SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
  input.positions.col(2).setConstant(0.02 + thickness);
  // The sheet starts with the velocity of the turntable.
  const double spin = 3;
  input.velocities = Positions::Zero(rest.vertex_count(), 3);
  input.velocities.col(0) = -spin * input.positions.col(1),
  input.velocities.col(1) = spin * input.positions.col(0);
  std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
  add_effect(passes, "disc", rest, {{"height", 0.04}, {"spin", spin}, {"thickness", thickness}});
  add_effect(passes, "friction", rest, {{"static", 1.0}, {"kinetic", 1.0}});
  const auto simulation = make_simulation<double>(input, std::move(passes));
  for (int s = 0; s < 60; ++s) REQUIRE(simulation->step());
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(spin * 1.0, Vector3::UnitZ()).toRotationMatrix();
  // ω² r is at most 1.9 m/s², a fifth of μ g, so nothing slips.
  CHECK((simulation->positions() - input.positions * turned.transpose()).rowwise().norm().maxCoeff() < 1e-9);
}

TEST_CASE("friction changes nothing without contacts or with coefficients of zero", "[effects][friction]") {
  const RestMesh rest(grid(0.5, 0.5, 8, 8));
  const auto end = [&](const Settings* friction) {
    std::vector<Pass<float>> passes = test::effect_passes<float>("gravity");
    add_effect(passes, "sphere", rest, {{"centre", list({0.1, 0, -0.3})}}, friction != nullptr);
    if (friction != nullptr) add_effect(passes, "friction", rest, *friction);
    const auto simulation =
        make_simulation<float>(test::sheet(rest, make_pins(rest, {}, 0), "crossover"), std::move(passes));
    for (int s = 0; s < 40; ++s) REQUIRE(simulation->step());
    return simulation->positions();
  };
  const Settings none = {{"static", 0.0}, {"kinetic", 0.0}}, rough = {{"static", 0.3}, {"kinetic", 0.3}};
  CHECK(end(&none) == end(nullptr));
  CHECK(end(&rough) != end(nullptr));
  const Friction usual, no_friction{.at_rest = 0, .kinetic = 0};
  CHECK_FALSE(Friction::kind.idle(&usual));
  CHECK(Friction::kind.idle(&no_friction));
}

}  // namespace bendlab::friction_test
