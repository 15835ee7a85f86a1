// Static equilibria agree with closed forms for a spring, a chain, and a strip that hangs or stands.
#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>
#include <thread>

#include "bendlab/constraints/energy.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/method.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::equilibrium_test {
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

// Runs to the equilibrium under gravity along -z.
std::unique_ptr<Simulation> balanced(const SimulationInput& input, int steps = 400) {
  auto simulation = make_simulation<double>(
      input, test::effect_passes<double>("gravity", "acceleration", std::vector<double>{0, 0, -gravity}));
  for (int step = 0; step < steps && !simulation->settled(); ++step) REQUIRE(simulation->step());
  return simulation;
}

// A strip of an equilateral lattice with a hinge energy of the flexural rigidity `rigidity`. Two rows along
// one side are clamped, and the strip has the length `length` beyond the clamp. It is as wide as long and
// hardly stretchable. Otherwise it would curl up along its free sides, where B is less than D.
struct Strip {
  RestMesh rest;
  Pins pins;
  SimulationInput input{.method = Pbd{}};
  double length = 0, row = 0;  // m: beyond the last pinned row; between two rows

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

TEST_CASE("the gradient and Hessian of a system are the derivatives of its energy", "[solver]") {
  const RestMesh rest(delaunay(1, 1, 3, 2));
  const Pins pins = make_pins(rest, {0}, 0);
  std::mt19937_64 random(7);
  for (const std::string_view model :
       {"crossover", "discrete_shells", "bridson", "isometric", "choi_ko", "corotational_edge",
        "corotational_face", "laplacian", "mid_edge_average", "mid_edge"}) {
    SimulationInput input = compliant(test::sheet(rest, pins, model), 0.3, 0.7);
    input.strain_stiffness.area = 1;
    // Choi and Ko's segments are compressed, so they are beyond the kink at their rest length.
    input.positions *= model == "choi_ko" ? 0.8 : 1.0;
    for (int v = 0; v < rest.vertex_count(); ++v)
      input.positions.row(v) += test::random_vector(random, 0.05).transpose();
    ElasticSystem system(input);
    Positions x = input.points();
    const auto vertices = static_cast<Eigen::Index>(rest.vertex_count());
    for (Eigen::Index d = vertices; d < x.rows(); ++d) x(d, 0) += test::random_vector(random, 0.05).x();
    // The Hessian has an arbitrary value where the model does not read a coordinate of a director.
    const auto is_read = [&](Eigen::Index unknown) {
      const auto& index = system.free_index();
      const auto point = std::ranges::find(index, unknown / 3) - index.begin();
      return point < vertices || unknown % 3 < input.directors.coordinates;
    };
    const Eigen::VectorXd gradient = system.gradient(x);
    const Eigen::MatrixXd hessian =
        Eigen::MatrixXd(system.hessian(x, system.multipliers(x))).selfadjointView<Eigen::Lower>();
    INFO(model);
    // Central differences have an error of step² by the third derivative, and 1e-16 / step by rounding.
    constexpr double step = 1e-5;
    for (Eigen::Index i = 0; i < system.unknowns(); i += 5) {
      if (!is_read(i)) continue;
      Eigen::VectorXd unit = Eigen::VectorXd::Zero(system.unknowns());
      unit(i) = step;
      const Positions ahead = system.moved(x, unit), behind = system.moved(x, -unit);
      const double slope = (system.energy(ahead) - system.energy(behind)) / (2 * step);
      CHECK_THAT(gradient(i), WithinAbs(slope, 1e-6 * gradient.cwiseAbs().maxCoeff()));
      const Eigen::VectorXd column = (system.gradient(ahead) - system.gradient(behind)) / (2 * step);
      // Choi and Ko's derivatives are differences, too, of a function that bisection solves for.
      const double tolerance = model == "choi_ko" ? 1e-3 : 1e-6;
      CHECK((hessian.col(i) - column).norm() <= tolerance * hessian.norm());
    }
  }
}

TEST_CASE("forces of nonlinear moments and of a membrane by direction and place are derivatives",
          "[solver]") {
  const RestMesh rest(delaunay(1, 1, 3, 2));
  const Pins pins = make_pins(rest, {0}, 0);
  std::mt19937_64 random(9);
  for (const std::string_view model : {"discrete_shells", "mid_edge", "corotational_face", "laplacian"})
    for (const bool yields : {false, true}) {
      if (yields && model == "laplacian") continue;
      SimulationInput input = compliant(test::sheet(rest, pins, model), 0.3, 0.7);
      input.strain_stiffness.softness = {1, 3, 20};
      for (std::size_t t = 0; t < input.strain.size(); ++t)
        input.strain.softness.push_back(test::uniform(random, 0.5, 2));
      for_each_kind(input.elements, [&](auto& list) {
        if (!yields) list.moment.softening.half_at = 3;
        for (std::size_t c = 0; c < list.size(); ++c)
          if (yields) {
            list.moment.yield.push_back(test::uniform(random, 0.01, 0.3));
            list.moment.hardening.push_back(test::uniform(random, 0, 0.5));
          } else {
            list.moment.length.push_back(test::uniform(random, 0.01, 0.1));
          }
      });
      for (int v = 0; v < rest.vertex_count(); ++v)
        input.positions.row(v) += test::random_vector(random, 0.05).transpose();
      const ElasticSystem system(input);
      Positions x = input.points();
      for (Eigen::Index d = rest.vertex_count(); d < x.rows(); ++d)
        x(d, 0) += test::uniform(random, -0.05, 0.05);
      const Eigen::VectorXd gradient = system.gradient(x);
      INFO(model << (yields ? " yields" : " softens"));
      constexpr double step = 1e-5;  // as above
      for (Eigen::Index i = 0; i < system.unknowns(); i += 3) {
        Eigen::VectorXd unit = Eigen::VectorXd::Zero(system.unknowns());
        unit(i) = step;
        const double slope =
            (system.energy(system.moved(x, unit)) - system.energy(system.moved(x, -unit))) / (2 * step);
        CHECK_THAT(gradient(i), WithinAbs(slope, 1e-6 * gradient.cwiseAbs().maxCoeff()));
      }
    }
}

TEST_CASE("the bending energy of a system is the energy of its constraints over the compliance", "[solver]") {
  const RestMesh rest(delaunay(1, 1, 3, 2));
  for (const std::string_view model :
       {"crossover", "discrete_shells", "bridson", "isometric", "choi_ko", "corotational_edge",
        "corotational_face", "laplacian", "mid_edge_average", "mid_edge"}) {
    SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 0), model);
    input.positions *= 0.8;  // only segments shorter than at rest push
    for (Eigen::Index v = 0; v < input.positions.rows(); ++v)
      input.positions(v, 2) = 0.05 * std::sin(7 * input.positions(v, 0));
    const Positions points = input.points();  // with the directors of mid_edge
    const auto energy = [&](double compliance) {
      return ElasticSystem(compliant(input, 0.3, compliance)).energy(points);
    };
    const double bending = elastic_energy(input.distance, points) + elastic_energy(input.elements, points);
    INFO(model);
    CHECK(bending > 0);
    CHECK_THAT(energy(0.5) - energy(1), WithinRel(bending, 1e-6));  // 1 / 0.5 - 1 / 1 = 1
  }
}

TEST_CASE("a mass on a spring hangs m g / k below its rest length", "[solver]") {
  SimulationInput input{.method = Pbd{}};
  input.positions = Positions::Zero(2, 3);
  input.positions(1, 0) = 1;  // the mass starts beside the pin
  input.origin.setZero();
  input.mass = {1, 2};
  input.is_pinned = {1, 0};
  input.distance = {.vertices = {{0, 1}}, .rest_length = {1}};
  const auto equilibrium = balanced(compliant(std::move(input), 1, 1e-3));
  REQUIRE(equilibrium->settled());
  // |Δf| / |f| ≤ 1e-7, so positions are right to 1e-7 m g / k.
  CHECK_THAT(equilibrium->positions()(1, 2), WithinAbs(-1 - 2 * gravity * 1e-3, 1e-8));
  CHECK_THAT(equilibrium->positions()(1, 0), WithinAbs(0, 1e-7));
}

TEST_CASE("a hanging sheet without bending resistance is a catenary", "[solver]") {
  // An inextensible chain of length L hangs between supports that are d apart, with L / d = 1.25. Its sag is
  // a (cosh(d / 2a) - 1) = 0.3318 d, where 2 a sinh(d / 2a) = L.
  const RestMesh rest(grid(1.25, 0.2, 40, 6));
  std::vector<int> ends = select_vertices(rest, Place::left);
  for (const int v : select_vertices(rest, Place::right)) ends.push_back(v);
  const Pins pins = make_pins(rest, ends, 0);
  SimulationInput input = compliant(test::sheet(rest, pins, "none", density), 1e-4, 1);
  for (int v = 0; v < rest.vertex_count(); ++v) {  // the ends approach each other, the sheet is a shallow arc
    const double along = rest.position(v).x() / 1.25;
    input.positions(v, 0) = along;
    input.positions(v, 2) = -0.3 * (1 - 4 * along * along);
  }
  const auto equilibrium = balanced(input);
  REQUIRE(equilibrium->settled());
  // The sag of a polygon of 40 segments is smaller by about (1/40)². A membrane of 10⁴ N/m stretches by 1e-4.
  CHECK_THAT(-equilibrium->positions().col(2).minCoeff(), WithinRel(0.3318, 2e-3));
}

TEST_CASE("a cantilever of hinges hangs like the heavy elastica", "[solver]") {
  // H/W of the heavy elastica at Γ = ρ g L³ / B = 1, 10, 100 (solved to 1e-10 by two methods). The clamp acts
  // half a row behind the last pinned row.
  const std::array<std::array<double, 2>, 3> curve = {{{1, 0.124562}, {10, 1.0668}, {100, 5.8881}}};
  for (const auto& [gamma, expected] : curve) {
    Strip strip(24, 1);
    const double length = strip.length + strip.row / 2;
    strip = Strip(24, density * gravity * std::pow(length, 3) / gamma);
    const auto equilibrium = balanced(strip.input);
    REQUIRE(equilibrium->settled());
    const Vector3 tip = strip.tip(equilibrium->positions());
    const double start = strip.rest.box_max().x() - length;
    // The error from curling at the sides is proportional to the fourth root of the membrane's compliance
    // (measured at 1e-6, 1e-7 and 1e-8 m/N). It is 1 to 2 % of H/W at Γ = 1. A strip that bends more does not
    // curl.
    const double ratio = -tip.z() / (tip.x() - start) / expected;
    CHECK_THAT(ratio, WithinAbs(1, gamma < 5 ? 0.02 : 0.01));
  }
}

TEST_CASE("a strip with bending springs hangs without creases", "[solver]") {
  const RestMesh rest(equilateral(0.25, 0.15, 14, Rows::perpendicular));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 2);
  for (const double strain_compliance : {1e-5, 1e-7}) {
    const auto equilibrium =
        balanced(compliant(test::sheet(rest, pins, "k_ring", density), strain_compliance, 1e-3));
    REQUIRE(equilibrium->settled());
    const Positions x = equilibrium->positions();
    std::map<long, std::pair<double, double>> row;  // lowest and highest vertex of each row, m
    for (int v = 0; v < rest.vertex_count(); ++v) {
      auto [it, is_new] = row.try_emplace(std::lround(rest.position(v).x() * 1e6), x(v, 2), x(v, 2));
      auto& [low, high] = it->second;
      low = std::min(low, x(v, 2)), high = std::max(high, x(v, 2));
    }
    // The strip curls a little at the free sides, by less than 3 % of the distance between rows. A crease is
    // at least 10 %.
    for (const auto& [place, ends] : row) CHECK(ends.second - ends.first < 0.03 * 0.0155);
  }
}

TEST_CASE("a standing strip buckles at the height that Greenhill predicts", "[solver]") {
  // A free-standing column buckles under its own weight at ρ g L³ / B = 7.837 (Greenhill 1881).
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
    const auto equilibrium = balanced(strip.input);
    REQUIRE(equilibrium->settled());
    return std::abs(strip.tip(equilibrium->positions()).x()) / length;
  };
  // B is the flexural rigidity D if the sheet cannot curl across its length. If it can, B is D (1 - ν²) with
  // ν = -1/3 (a lattice of hinges). So the strip buckles between 6.97 and 7.837.
  CHECK(leans(6.5) < 1e-3);  // straight, except for at most 15 times the imperfection of 2e-5
  CHECK(leans(8.5) > 0.2);
}

TEST_CASE("equilibria computed in parallel equal an equilibrium computed alone", "[solver]") {
  // The strip is so large that the factorisation uses dense blocks. Their library must allow several callers.
  const Strip strip(40, density * gravity * std::pow(0.22, 3) / 10);
  const Positions alone = balanced(strip.input)->positions();
  std::array<Positions, 4> results;
  {
    std::vector<std::jthread> threads;
    for (Positions& result : results)
      threads.emplace_back([&] {
        auto simulation = make_simulation<double>(strip.input, test::effect_passes<double>("gravity"));
        for (int step = 0; step < 100 && !simulation->settled(); ++step) simulation->step();
        result = simulation->positions();
      });
  }
  for (const Positions& result : results) CHECK(result == alone);
}

TEST_CASE("the equilibrium method refuses k and obstacles, and reports an equilibrium that it did not reach",
          "[solver]") {
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
  // If every vertex is pinned or no force acts, nothing moves.
  const auto held = balanced(
      compliant(test::sheet(rest, make_pins(rest, {0, 1, 2, 3, 4, 5, 6, 7, 8}, 0), "crossover"), 1, 1));
  CHECK(held->settled());
  CHECK(held->positions() == rest.positions());
  const auto idle = make_simulation<double>(compliant(input, 1, 1), {});
  for (int step = 0; step < 3; ++step) REQUIRE(idle->step());
  CHECK(*idle->unbalanced() == 0);
  CHECK(idle->positions() == rest.positions());
  // A sheet without pins falls for ever.
  const auto falling = balanced(compliant(test::sheet(rest, make_pins(rest, {}, 0), "crossover"), 1, 1), 20);
  CHECK_FALSE(falling->settled());
  CHECK(*falling->unbalanced() > 0.5);
}

}  // namespace bendlab::equilibrium_test
