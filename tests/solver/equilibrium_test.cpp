// Static equilibria against closed forms: of a spring, a chain, a strip that hangs or stands.
#include <map>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "bendlab/constraints/energy.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/method.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double gravity = 9.81, density = 0.2;

SimulationInput compliant(SimulationInput input, double strain_compliance, double bending_compliance) {
  input.strain_stiffness = {.kind = StiffnessKind::compliance, .compliance = strain_compliance};
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .compliance = bending_compliance};
  input.method = Equilibrium{};
  return input;
}

// To the equilibrium under gravity along -z.
std::unique_ptr<Simulation> balanced(const SimulationInput& input, int steps = 400) {
  auto simulation = make_simulation<double>(
      input, test::effect_passes<double>("gravity", "acceleration", std::vector<double>{0, 0, -gravity}));
  for (int step = 0; step < steps && !simulation->settled(); ++step) REQUIRE(simulation->step());
  return simulation;
}

// A strip of length `length` beyond a clamp of two rows of an equilateral lattice that lie along the clamp,
// with a hinge energy whose flexural rigidity is `rigidity`. As wide as long, and hardly stretchable: else it
// curls up across its length along the free sides, and B is less than D there.
struct Strip {
  RestMesh rest;
  Pins pins;
  SimulationInput input{.method = Pbd{}};
  double length = 0, row = 0;  // m: beyond the last pinned row, between rows

  Strip(int cells, double rigidity)
      : rest(equilateral(0.25, 0.25, cells, Rows::perpendicular)),
        pins(make_pins(rest, select_vertices(rest, Place::left), 1)),
        input(compliant(test::sheet(rest, pins, "discrete_shells", density), 1e-7, 1 / rigidity)) {
    double clamp = rest.box_min().x();
    for (const int v : pins.all) clamp = std::max(clamp, rest.position(v).x());
    length = rest.box_max().x() - clamp;
    row = 0.25 / cells * std::sqrt(3.0) / 2;
  }

  Vector3 tip(const Positions& positions) const {
    Vector3 sum = Vector3::Zero();
    int count = 0;
    for (int v = 0; v < rest.vertex_count(); ++v)
      if (rest.position(v).x() > rest.box_max().x() - 1e-9) sum += positions.row(v).transpose(), ++count;
    return sum / count;
  }
};

}  // namespace

TEST_CASE("a system's gradient and Hessian are the derivatives of its energy", "[solver]") {
  const RestMesh rest(delaunay(1, 1, 3, 2));
  const Pins pins = make_pins(rest, {0}, 0);
  std::mt19937_64 random(7);
  for (const std::string_view model : {"crossover", "discrete_shells", "bridson", "isometric", "choi_ko"}) {
    SimulationInput input = compliant(test::sheet(rest, pins, model), 0.3, 0.7);
    input.strain_stiffness.area = 1;
    // Compressed: a segment of Choi and Ko's then is past the kink at its rest length.
    input.positions *= model == "choi_ko" ? 0.8 : 1.0;
    for (int v = 0; v < rest.vertex_count(); ++v)
      input.positions.row(v) += test::random_vector(random, 0.05).transpose();
    ElasticSystem system(input);
    const Positions x = input.positions;
    const Eigen::VectorXd gradient = system.gradient(x);
    const Eigen::MatrixXd hessian =
        Eigen::MatrixXd(system.hessian(x, system.multipliers(x))).selfadjointView<Eigen::Lower>();
    INFO(model);
    constexpr double step =
        1e-5;  // central differences: step² of the third derivative's share, 1e-16 / step rounding
    for (Eigen::Index i = 0; i < system.unknowns(); i += 5) {
      Eigen::VectorXd unit = Eigen::VectorXd::Zero(system.unknowns());
      unit(i) = step;
      const Positions ahead = system.moved(x, unit), behind = system.moved(x, -unit);
      const double slope = (system.energy(ahead) - system.energy(behind)) / (2 * step);
      CHECK_THAT(gradient(i), WithinAbs(slope, 1e-6 * gradient.cwiseAbs().maxCoeff()));
      const Eigen::VectorXd column = (system.gradient(ahead) - system.gradient(behind)) / (2 * step);
      // Choi and Ko's own derivatives are differences too, of a function that is solved for by bisection.
      const double tolerance = model == "choi_ko" ? 1e-3 : 1e-6;
      CHECK((hessian.col(i) - column).norm() <= tolerance * hessian.norm());
    }
  }
}

TEST_CASE("a system's bending energy is that of its constraints over the compliance", "[solver]") {
  const RestMesh rest(delaunay(1, 1, 3, 2));
  for (const std::string_view model : {"crossover", "discrete_shells", "bridson", "isometric", "choi_ko"}) {
    SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 0), model);
    input.positions *= 0.8;  // shorter than at rest, as segments have to be that push
    for (Eigen::Index v = 0; v < input.positions.rows(); ++v)
      input.positions(v, 2) = 0.05 * std::sin(7 * input.positions(v, 0));
    const auto energy = [&](double compliance) {
      return ElasticSystem(compliant(input, 0.3, compliance)).energy(input.positions);
    };
    const double bending =
        elastic_energy(input.distance, input.positions) + elastic_energy(input.elements, input.positions);
    INFO(model);
    CHECK(bending > 0);
    CHECK_THAT(energy(0.5) - energy(1), WithinRel(bending, 1e-6));  // 1 / 0.5 - 1 / 1 = 1
  }
}

TEST_CASE("a mass on a spring hangs m g / k below its rest length", "[solver]") {
  SimulationInput input{.method = Pbd{}};
  input.positions = Positions::Zero(2, 3);
  input.positions(1, 0) = 1;  // starts to the side of the pin
  input.origin.setZero();
  input.mass = {1, 2};
  input.is_pinned = {1, 0};
  input.distance = {.vertices = {{0, 1}}, .rest_length = {1}};
  const auto found = balanced(compliant(std::move(input), 1, 1e-3));
  REQUIRE(found->settled());
  // |Δf| / |f| ≤ 1e-7, so positions are right to 1e-7 m g / k.
  CHECK_THAT(found->positions()(1, 2), WithinAbs(-1 - 2 * gravity * 1e-3, 1e-8));
  CHECK_THAT(found->positions()(1, 0), WithinAbs(0, 1e-7));
}

TEST_CASE("a hanging sheet without bending is a catenary", "[solver]") {
  // Sag of an inextensible chain of length L between supports d apart at L / d = 1.25: with 2 a sinh(d / 2a)
  // = L it is a (cosh(d / 2a) - 1) = 0.3318 d.
  const RestMesh rest(grid(1.25, 0.2, 40, 6));
  std::vector<int> ends = select_vertices(rest, Place::left);
  for (const int v : select_vertices(rest, Place::right)) ends.push_back(v);
  const Pins pins = make_pins(rest, ends, 0);
  SimulationInput input = compliant(test::sheet(rest, pins, "none", density), 1e-4, 1);
  for (int v = 0; v < rest.vertex_count(); ++v) {  // the ends moved together, the sheet on a shallow arc
    const double along = rest.position(v).x() / 1.25;
    input.positions(v, 0) = along;
    input.positions(v, 2) = -0.3 * (1 - 4 * along * along);
  }
  const auto found = balanced(input);
  REQUIRE(found->settled());
  // A polygon of 40 segments sags (1/40)² of the scale less; a membrane of 10⁴ N/m stretches by 1e-4.
  CHECK_THAT(-found->positions().col(2).minCoeff(), WithinRel(0.3318, 2e-3));
}

TEST_CASE("a cantilever of hinges hangs as the heavy elastica", "[solver]") {
  // H/W of the heavy elastica at Γ = ρ g L³ / B = 1, 10, 100 (solved to 1e-10 by two methods). The clamp acts
  // half a row behind the last pinned one.
  const std::array<std::array<double, 2>, 3> curve = {{{1, 0.124562}, {10, 1.0668}, {100, 5.8881}}};
  for (const auto& [gamma, expected] : curve) {
    Strip strip(24, 1);
    const double length = strip.length + strip.row / 2;
    strip = Strip(24, density * gravity * std::pow(length, 3) / gamma);
    const auto found = balanced(strip.input);
    REQUIRE(found->settled());
    const Vector3 tip = strip.tip(found->positions());
    const double start = strip.rest.box_max().x() - length;
    // What is left of curling at the sides shrinks as the fourth root of the membrane's compliance, whether
    // that is 1e-6, 1e-7 or 1e-8 m/N: 1 to 2 % of H/W at Γ = 1. Bent farther the strip does not curl.
    const double ratio = -tip.z() / (tip.x() - start) / expected;
    CHECK_THAT(ratio, WithinAbs(1, gamma < 5 ? 0.02 : 0.01));
  }
}

TEST_CASE("a strip that springs bend hangs without creases", "[solver]") {
  const RestMesh rest(equilateral(0.25, 0.15, 14, Rows::perpendicular));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 2);
  for (const double strain_compliance : {1e-5, 1e-7}) {
    const auto found =
        balanced(compliant(test::sheet(rest, pins, "k_ring", density), strain_compliance, 1e-3));
    REQUIRE(found->settled());
    const Positions x = found->positions();
    std::map<long, std::pair<double, double>> row;  // lowest and highest vertex of each
    for (int v = 0; v < rest.vertex_count(); ++v) {
      auto [it, is_new] = row.try_emplace(std::lround(rest.position(v).x() * 1e6), x(v, 2), x(v, 2));
      auto& [low, high] = it->second;
      low = std::min(low, x(v, 2)), high = std::max(high, x(v, 2));
    }
    // It curls a little at the free sides, by less than 3 % of the rows' spacing; a crease is 10 % and more.
    for (const auto& [place, ends] : row) CHECK(ends.second - ends.first < 0.03 * 0.0155);
  }
}

TEST_CASE("a standing strip buckles where Greenhill says", "[solver]") {
  // A column that stands by itself buckles under its own weight at ρ g L³ / B = 7.837 (Greenhill 1881).
  const auto leans = [](double gamma) {
    Strip strip(16, 1);
    const double length = strip.length + strip.row / 2;
    strip = Strip(16, density * gravity * std::pow(length, 3) / gamma);
    Positions& x = strip.input.positions;
    const double height = x.col(0).minCoeff();
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      const double up = x(v, 0) - height;
      x.row(v) << 1e-4 * up * up, x(v, 1), up;
    }
    for (int v = 0; v < strip.rest.vertex_count(); ++v)
      if (strip.pins.pinned(v)) x(v, 0) = 0;
    const auto found = balanced(strip.input);
    REQUIRE(found->settled());
    return std::abs(strip.tip(found->positions()).x()) / length;
  };
  // B is the flexural rigidity D where the sheet cannot curl across, and D (1 - ν²) with ν = -1/3 (a lattice
  // of hinges) where it can: the strip buckles between 6.97 and 7.837.
  CHECK(leans(6.5) < 1e-3);  // straight but for the imperfection of 2e-5, at most 15 times
  CHECK(leans(8.5) > 0.2);
}

TEST_CASE("equilibria found side by side are those found alone", "[solver]") {
  // Large enough for the factorisation to work in dense blocks, whose library has to bear several callers.
  const Strip strip(40, density * gravity * std::pow(0.22, 3) / 10);
  const Positions alone = balanced(strip.input)->positions();
  std::array<Positions, 4> found;
  {
    std::vector<std::jthread> runs;
    for (Positions& each : found)
      runs.emplace_back([&] {
        auto simulation = make_simulation<double>(strip.input, test::effect_passes<double>("gravity"));
        for (int step = 0; step < 100 && !simulation->settled(); ++step) simulation->step();
        each = simulation->positions();
      });
  }
  for (const Positions& each : found) CHECK(each == alone);
}

TEST_CASE("an equilibrium says what it cannot find", "[solver]") {
  const RestMesh rest(grid(1, 1, 2, 2));
  const Pins pins = make_pins(rest, {0}, 0);
  SimulationInput input = test::sheet(rest, pins, "crossover");
  input.method = Equilibrium{};
  CHECK_THROWS_AS(make_simulation<double>(input, {}), std::invalid_argument);  // k has no energy
  CHECK_THROWS_AS(make_simulation<float>(compliant(input, 1, 1), {}), std::invalid_argument);
  std::vector<Pass<double>> obstacle;
  obstacle.push_back({"obstacle", Stage::project, [](PassContext<double>&) {}});
  CHECK_THROWS_AS(make_simulation<double>(compliant(input, 1, 1), std::move(obstacle)),
                  std::invalid_argument);
  // Where everything is pinned there is nothing to find, and where nothing pulls nothing moves.
  const auto held = balanced(
      compliant(test::sheet(rest, make_pins(rest, {0, 1, 2, 3, 4, 5, 6, 7, 8}, 0), "crossover"), 1, 1));
  CHECK(held->settled());
  CHECK(held->positions() == rest.positions());
  const auto idle = make_simulation<double>(compliant(input, 1, 1), {});
  for (int step = 0; step < 3; ++step) REQUIRE(idle->step());
  CHECK(*idle->unbalanced() == 0);
  CHECK(idle->positions() == rest.positions());
  // Falls for ever: nothing holds it.
  const auto falling = balanced(compliant(test::sheet(rest, make_pins(rest, {}, 0), "crossover"), 1, 1), 20);
  CHECK_FALSE(falling->settled());
  CHECK(*falling->unbalanced() > 0.5);
}

}  // namespace bendlab
