// The bound on the push of springs, so that the solver can hold the sheet together.
#include "bendlab/bending/push_bound.hpp"

#include <cmath>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/mesh/delaunay.hpp"
#include "bendlab/solver/method.hpp"
#include "bendlab/solver/push_tension.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::push_bound_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

constexpr double dt = 1.0 / 60, rigidity = 1e-3, density = 0.2;

DistanceConstraints springs(const RestMesh& rest, double excess) {
  const Pins pins = make_pins(rest, {}, 0);
  BendingConstraints constraints = test::built("prestressed", rest, pins, {{"excess", excess}});
  calibrate(constraints, rest, pins, {.flexural_rigidity = rigidity});
  return constraints.distance;
}

double length_of(const RestMesh& rest, const std::array<int, 2>& pair) {
  return (rest.position(pair[0]) - rest.position(pair[1])).norm();
}

// The growth of the edges of a sheet after a quarter of a second without loads, as a root mean square.
double growth(const RestMesh& rest, const DistanceConstraints& pushing, int substeps) {
  SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 0), "none", density);
  input.distance = pushing;
  input.strain_stiffness = {.kind = StiffnessKind::compliance, .compliance = 1e-7};
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .compliance = 1};
  input.settings = {.dt = dt, .substeps = substeps, .iterations = 1};
  const auto simulation = make_simulation<double>(input, {});
  for (int step = 0; step < 15; ++step) REQUIRE(simulation->step());
  const Positions x = simulation->positions();
  double sum = 0;
  for (Eigen::Index e = 0; e < rest.edges().rows(); ++e) {
    const int a = rest.edges()(e, 0), b = rest.edges()(e, 1);
    sum += std::pow((x.row(a) - x.row(b)).norm() / length_of(rest, {a, b}) - 1, 2);
  }
  return std::sqrt(sum / static_cast<double>(rest.edges().rows()));
}

}  // namespace

TEST_CASE("springs that push do not tear apart a sheet whose solver cannot hold them", "[bending]") {
  for (const TriangleMesh& mesh : {delaunay(0.2, 0.2, 10, 1), grid(0.2, 0.2, 10, 10, Diagonal::alternating),
                                   equilateral(0.2, 0.2, 10)}) {
    const RestMesh rest(mesh);
    for (const int substeps : {1, 4, 16}) {
      const DistanceConstraints stated = springs(rest, 1);
      DistanceConstraints held = stated;
      const auto bound = bound_push(held, rest, lumped_masses(rest, density), dt / substeps, 1);
      REQUIRE(bound);
      INFO(rest.triangle_count() << " triangles, " << substeps << " substeps, G " << bound->growth);
      const double bounded_growth = growth(rest, held, substeps);
      // Twice the tolerated growth: without damping the sheet swings to twice its growth at rest.
      CHECK(bounded_growth < 2 * tolerated_growth);
      if (bound->expected > 0.2) CHECK(growth(rest, stated, substeps) > 2 * bounded_growth);
    }
  }
}

TEST_CASE("bounding the excess keeps the force at rest, and springs that the solver holds stay as they are",
          "[bending]") {
  const RestMesh rest(equilateral(0.2, 0.2, 10));
  const std::vector<double> mass = lumped_masses(rest, density);
  const DistanceConstraints stated = springs(rest, 1);
  DistanceConstraints coarse = stated, fine = stated;
  const auto bounded = bound_push(coarse, rest, mass, dt, 1),
             kept = bound_push(fine, rest, mass, dt / 1024, 1);
  REQUIRE(bounded);
  REQUIRE(kept);
  CHECK(fine.rest_length == stated.rest_length);
  CHECK(fine.softness == stated.softness);
  CHECK(kept->taken == kept->stated);
  CHECK_FALSE(push_warning(*kept));
  double virial = 0, area = 0;
  for (std::size_t s = 0; s < stated.size(); ++s) {
    const double length = length_of(rest, stated.vertices[s]),
                 force = (stated.rest_length[s] - length) / stated.softness[s];
    CHECK_THAT((coarse.rest_length[s] - length) / coarse.softness[s], WithinRel(force, 1e-9));
    CHECK_THAT(coarse.rest_length[s] / length - 1, WithinRel(bounded->taken, 1e-9));
    virial += force * length;
  }
  for (const double a : rest.areas()) area += a;
  CHECK_THAT(bounded->tension, WithinRel(virial / (2 * area), 1e-9));
  CHECK(bounded->taken < 0.1);
  CHECK_THAT(bounded->growth / kept->growth, WithinRel(1024.0 * 1024, 1e-9));

  // The remedy in the warning helps: that many times as many substeps are enough, half of them are not.
  const auto with = [&](int substeps) {
    DistanceConstraints again = stated;
    return !push_warning(*bound_push(again, rest, mass, dt / substeps, 1));
  };
  CHECK(with(bounded->substeps_factor));
  CHECK_FALSE(with(bounded->substeps_factor / 2));
  const std::string warning = push_warning(*bounded).value_or("");
  CHECK_THAT(warning, ContainsSubstring("N/m") &&
                          ContainsSubstring(std::to_string(bounded->substeps_factor) + " times"));

  // The default excess is below the tolerated growth, and springs at rest do not push.
  DistanceConstraints usual = springs(rest, 0.02);
  CHECK_FALSE(push_warning(*bound_push(usual, rest, mass, dt, 1)));
  DistanceConstraints resting = test::built("sparse_lod", rest).distance;
  CHECK_FALSE(bound_push(resting, rest, mass, dt, 1));
}

TEST_CASE("the tension of springs that push agrees with a computation by hand", "[bending]") {
  // Springs push apart the sides and a diagonal of a square of 2 m. A spring of length L with the force f has
  // the virial f L. T is the sum of the virials over twice the area of 4 m².
  const RestMesh rest(grid(2, 2, 1, 1));
  DistanceConstraints springs;
  const auto add = [&](int a, int b, double excess, double softness) {
    springs.vertices.push_back({a, b});
    springs.rest_length.push_back((1 + excess) * length_of(rest, {a, b}));
    springs.softness.push_back(softness);
  };
  add(0, 1, 0.1, 1);   // longer by 0.2 m: f = 0.2 N at 1 m/N, f L = 0.4
  add(0, 2, 0, 1);     // at rest
  add(1, 3, -0.1, 1);  // pulls: not part of the tension
  add(0, 3, 0.1, 2);   // √8 m: f = 0.1 √8 / 2, f L = 0.4
  CHECK_THAT(push_tension(springs, rest, 1), WithinRel(0.8 / (2 * 4), 1e-12));
  CHECK_THAT(push_tension(springs, rest, 0.01), WithinRel(10, 1e-12));  // N/m

  // 10 N/m stretch a membrane of 100 N/m by a tenth, and a membrane of 1000 N/m by a hundredth.
  CHECK(push_on_membrane_warning(10, 0.01));
  CHECK_FALSE(push_on_membrane_warning(10, 0.001));
  CHECK_FALSE(push_on_membrane_warning(0, 1));
  CHECK_THAT(*push_on_membrane_warning(10, 0.01), ContainsSubstring("0.0036 m/N"));  // below 4 % growth
}

TEST_CASE("a method that softens the membrane leaves it stiff enough for springs that push", "[bending]") {
  // T = 10 N/m may stretch the membrane by membrane_error, here 3·10⁻³, and never by more than a few percent.
  CHECK_THAT(membrane_for_push(10, 3e-3), WithinRel(10 / 3e-3, 1e-12));
  CHECK_THAT(membrane_for_push(10, 0.3), WithinRel(10 / 0.04, 1e-12));
  CHECK(membrane_for_push(0, 3e-3) == 0);

  // A strip of 0.3 m. Its own weight asks for a membrane of 5 ρ g A / (L error) = 100 N/m, its springs for
  // T / error.
  const RestMesh rest(grid(0.3, 0.03, 30, 3));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 1);
  BendingConstraints constraints = test::built("prestressed", rest, pins, {{"excess", 1.0}});
  calibrate(constraints, rest, pins, {.flexural_rigidity = rigidity});
  SimulationInput input = test::sheet(rest, pins, "none", density);
  input.distance = constraints.distance;
  input.strain_stiffness = {.kind = StiffnessKind::compliance, .compliance = 1e-7};
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .compliance = 1};
  input.method = QuasiNewton{.membrane_error = 3e-3};
  input.settings = {.dt = dt, .substeps = 2, .iterations = 20};
  input.push_tension = push_tension(input.distance, rest, 1);
  const auto simulation = make_simulation<double>(input, {});
  for (int step = 0; step < 30; ++step) REQUIRE(simulation->step());
  // Edges along the strip have grown by no more than this error and the error of the iterations.
  const Positions x = simulation->positions();
  const double end = (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
  CHECK(end < 1.01 * rest.size());
  REQUIRE(simulation->membrane_softness());
  CHECK(input.push_tension * 1e-7 * *simulation->membrane_softness() <= 3e-3 * (1 + 1e-9));
}

}  // namespace bendlab::push_bound_test
