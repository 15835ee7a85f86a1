// Springs that push in the flat sheet: their moment is linear in the curvature, and the membrane holds the
// sheet together.
#include <cmath>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/mesh/delaunay.hpp"
#include "bendlab/solver/method.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::prestressed_test {
namespace {

using Catch::Matchers::WithinRel;
using test::Changed;

constexpr double pi = std::numbers::pi;

Changed springs(double excess, std::int64_t t) {
  return {{"excess", excess}, {"t", t}};
}

double energy_over_flat(const BendingConstraints& constraints, const RestMesh& rest, double curvature,
                        double angle) {
  return test::energy(constraints, test::bent(rest, curvature, angle)) -
         test::energy(constraints, rest.positions());
}

TEST_CASE("springs that push have an energy quadratic in the curvature", "[bending]") {
  const RestMesh rest(equilateral(1, 1, 24));
  const BendingConstraints pushing = test::built("prestressed", rest, springs(1, 3)),
                           resting = test::built("sparse_lod", rest, {{"t", std::int64_t{3}}});
  for (const double angle : {0.0, 0.7, 1.6}) {
    const auto growth = [&](const BendingConstraints& constraints, double curvature) {
      return energy_over_flat(constraints, rest, 2 * curvature, angle) /
             energy_over_flat(constraints, rest, curvature, angle);
    };
    // L = 1/8: terms of the next order are at most (κ L)² / 20 of the first.
    CHECK_THAT(growth(pushing, 0.5), WithinRel(4.0, 1e-3));
    CHECK_THAT(growth(resting, 0.5), WithinRel(16.0, 1e-3));
  }
}

TEST_CASE("the excess of a spring sets the ratio of its linear and cubic parts", "[bending]") {
  // ½ (e L + δ)² - ½ (e L)² = e L δ + ½ δ², with δ = L - (2/κ) sin(κ L / 2) along the bend. Both parts are
  // equal at δ = 2 e L.
  const RestMesh rest(grid(4, 1, 4, 1));
  const double excess = 0.02, length = 2;
  BendingConstraints spring;
  spring.distance = {.vertices = {{0, 2}}, .rest_length = {length * (1 + excess)}, .softness = {1}};
  const double curvature = std::sqrt(48 * excess) / length;
  Positions positions = test::bent(rest, curvature, pi / 2);
  const double shorter = length - (positions.row(0) - positions.row(2)).norm();
  const double energy = test::energy(spring, positions) - test::energy(spring, rest.positions());
  // Terms of higher order are (κ L)² / 80 of δ.
  CHECK_THAT(energy, WithinRel(2 * excess * length * shorter, 0.02));
}

TEST_CASE("calibrated springs that push have the requested rigidity, also on irregular meshes",
          "[bending][calibration]") {
  constexpr double rigidity = 3e-5, curvature = 0.5;
  for (const TriangleMesh& mesh : {equilateral(0.24, 0.24, 24), delaunay(0.24, 0.24, 24, 3)}) {
    const RestMesh rest(mesh);
    const Pins pins = make_pins(rest, {}, 0);
    BendingConstraints constraints =
        test::built("prestressed", rest, pins, {{"excess", 1.0}, {"radius", 0.04}, {"pin_zone", false}});
    calibrate(constraints, rest, pins, {.flexural_rigidity = rigidity});
    double sum = 0;
    constexpr int directions = 12;
    for (int d = 0; d < directions; ++d)
      sum += energy_over_flat(constraints, rest, curvature, pi * d / directions);
    double area = 0;
    for (const double a : rest.areas()) area += a;
    // The calibration bends the mesh without strain, this test bends it on a smooth cylinder. There a pair t
    // = 4 edges apart shortens by the factor 1 / (1 - 1/t²) more.
    CHECK_THAT(sum / directions,
               WithinRel(rigidity / 2 * curvature * curvature * area / (1 - 1 / 16.0), 0.02));
  }
}

TEST_CASE("springs that push stretch a sheet as the virial theorem predicts", "[bending]") {
  // The virial of a sheet at rest is zero: Σ f L = ∫ tr σ, with σ = ε / compliance of warp and weft.
  const RestMesh rest(equilateral(1, 1, 16));
  SimulationInput input = test::sheet(rest, make_pins(rest, {0}, 0), "prestressed");
  constexpr double membrane = 1e-6, bending = 1e-2;
  input.strain_stiffness = {.kind = StiffnessKind::compliance, .compliance = membrane};
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .compliance = bending};
  double virial = 0, area = 0, stretched = 0;
  for (std::size_t s = 0; s < input.distance.size(); ++s) {
    const double longer = input.distance.rest(s), length = longer / 1.02;
    virial += (longer - length) * length / (bending * input.distance.softness[s]);
  }
  for (const double a : rest.areas()) area += a;
  input.method = Equilibrium{};
  const auto simulation = make_simulation<double>(input, {});
  for (int step = 0; step < 40 && !simulation->settled(); ++step) REQUIRE(simulation->step());
  const Positions x = simulation->positions();
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const auto corner = rest.triangles().row(t);
    const Vector3 a = x.row(corner(0)), b = x.row(corner(1)), c = x.row(corner(2));
    stretched += 0.5 * (b - a).cross(c - a).norm() - rest.areas()[static_cast<std::size_t>(t)];
  }
  // A stretch of the membrane reduces the excess by as much, here 1e-4 of 2e-2.
  CHECK_THAT(stretched, WithinRel(membrane * virial, 0.02));
  CHECK(stretched < 1e-3 * area);
}

TEST_CASE("projected with k, springs that push make a sheet grow by at most twice their excess",
          "[bending]") {
  const RestMesh rest(grid(1, 1, 16, 16));
  const auto simulation =
      make_simulation<double>(test::sheet(rest, make_pins(rest, {}, 0), "prestressed"), {});
  for (int step = 0; step < 120; ++step) REQUIRE(simulation->step());
  const Positions x = simulation->positions();
  double length = 0, before = 0;
  for (Eigen::Index e = 0; e < rest.edges().rows(); ++e) {
    const int a = rest.edges()(e, 0), b = rest.edges()(e, 1);
    length += (x.row(a) - x.row(b)).norm(), before += (rest.position(a) - rest.position(b)).norm();
  }
  CHECK(length > before * (1 + 1e-4));
  CHECK(length < before * (1 + 2 * 0.02));  // without damping it swings to at most twice its rest growth
}

}  // namespace
}  // namespace bendlab::prestressed_test
