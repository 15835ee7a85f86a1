// Long-range attachments keep every vertex within the length of cloth to its pin.
#include <array>

#include "bendlab/mesh/geodesics.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::tethers_test {
namespace {

// Positions after one step with one iteration. The sheet starts stretched about its first pin, and has no
// constraints.
template <class Real>
Positions after_a_step(const RestMesh& rest, const Pins& pins, std::vector<Pass<Real>> passes,
                       double stretch) {
  SimulationInput input = test::sheet(rest, pins, "none");
  input.strain = {};
  const Eigen::RowVector3d pin = rest.positions().row(pins.all.front());
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (!pins.pinned(v)) input.positions.row(v) = pin + stretch * (input.positions.row(v) - pin);
  input.settings.iterations = 1;
  const auto simulation = make_simulation<Real>(input, std::move(passes));
  REQUIRE(simulation->step());
  return simulation->positions();
}

Pins two_corners(const RestMesh& rest) {
  std::vector<int> seeds = select_vertices(rest, Place::upper_right);
  seeds.push_back(select_vertices(rest, Place::upper_left).front());
  return make_pins(rest, seeds, 0);
}

// The largest distance between a free vertex and a pin, over the length of cloth between them.
double farthest(const RestMesh& rest, const Pins& pins, const Positions& positions, bool nearest_only) {
  double ratio = 0;
  for (int v = 0; v < rest.vertex_count(); ++v) {
    if (pins.pinned(v)) continue;
    double nearest = 1e300, of_nearest = 0;
    for (const int pin : pins.all) {
      const double rest_distance = (rest.position(v) - rest.position(pin)).norm();
      const double now = (positions.row(v) - positions.row(pin)).norm() / rest_distance;
      if (!nearest_only) ratio = std::max(ratio, now);
      if (rest_distance < nearest) nearest = rest_distance, of_nearest = now;
    }
    if (nearest_only) ratio = std::max(ratio, of_nearest);
  }
  return ratio;
}

}  // namespace

TEMPLATE_TEST_CASE("tethers keep every vertex within the length of cloth to its pin", "[effects]", float,
                   double) {
  const RestMesh rest(delaunay(1, 1, 16, 5));
  const Pins corner = make_pins(rest, select_vertices(rest, Place::upper_right), 0);
  for (const double slack : {0.0, 0.1}) {
    const Positions positions = after_a_step<TestType>(
        rest, corner, test::effect_passes<TestType>("tethers", rest, corner, "slack", slack), 3);
    // With one pin, one projection is exact up to the rounding of a coordinate.
    const double rounding = 8 * static_cast<double>(std::numeric_limits<TestType>::epsilon());
    CHECK(farthest(rest, corner, positions, false) <= (1 + slack) * (1 + rounding / 0.02));
    CHECK(farthest(rest, corner, positions, false) >= 1 + slack - rounding);  // the far vertices pull
  }
}

TEST_CASE("tethers change no bit if no vertex is too far away", "[effects]") {
  const RestMesh rest(grid(1, 1, 12, 12));
  const Pins pins = make_pins(rest, {0}, 1);
  // Shrunk or at rest. The slack allows for the rounding of geodesics, which may be too short.
  for (const double stretch : {1.0, 0.5}) {
    const Positions with = after_a_step<double>(
        rest, pins, test::effect_passes<double>("tethers", rest, pins, "slack", 1e-9), stretch);
    const Positions without = after_a_step<double>(rest, pins, {}, stretch);
    CHECK(with == without);
  }
  // Without pins there is no pass.
  const Pins none = make_pins(rest, {}, 0);
  CHECK(test::effect_passes<float>("tethers", rest, none).empty());
}

TEST_CASE("tethers attach each vertex to the nearest groups of pins", "[effects]") {
  const RestMesh rest(delaunay(1, 1, 12, 2));  // no vertex is equally near to both corners
  const Pins pins = two_corners(rest);
  const auto ratio = [&](std::int64_t per_vertex, bool nearest_only) {
    auto passes = test::effect_passes<double>("tethers", rest, pins, "per_vertex", per_vertex);
    return farthest(rest, pins, after_a_step<double>(rest, pins, std::move(passes), 3), nearest_only);
  };
  for (const std::int64_t tethers : {1, 4})
    CHECK(ratio(tethers, true) <= 1 + 1e-12);  // exact for the nearest pin
  CHECK(ratio(1, false) > 1.05);               // no tether to the other corner
  CHECK(ratio(4, false) < ratio(1, false));
}

TEST_CASE("tethers of a curved rest shape need the distance along the surface", "[effects]") {
  // Half a tube: the straight distance across its opening is 2/π of the cloth's length.
  TriangleMesh mesh = grid(1, 1, 16, 16);
  const double pi = 3.14159265358979;
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
    const double turn = pi * mesh.positions(v, 0);
    mesh.positions.row(v) << std::sin(turn) / pi, mesh.positions(v, 1), (1 - std::cos(turn)) / pi;
  }
  const RestMesh rest(mesh);
  const Pins pin = make_pins(rest, {0}, 0);
  const auto flattened = [&](const char* distance) {
    SimulationInput input = test::sheet(rest, pin, "none");
    input.strain = {};
    const TriangleMesh flat = grid(1, 1, 16, 16);
    input.positions = flat.positions.rowwise() + (mesh.positions.row(0) - flat.positions.row(0));
    const auto simulation = make_simulation<double>(
        input, test::effect_passes<double>("tethers", rest, pin, "distance", std::string(distance)));
    REQUIRE(simulation->step());
    return (simulation->positions() - input.positions).norm();
  };
  CHECK(flattened("geodesic") < 0.01 * flattened("straight"));  // unrolling stretches nothing
}

TEST_CASE("tethers keep a heavy sheet from stretching, with any bending model", "[effects]") {
  const RestMesh rest(delaunay(1, 1, 24, 2));  // no vertex is equally near to both corners
  const Pins pins = two_corners(rest);
  for (const BendingKind* model : bending_models()) {
    const auto longest = [&](bool tethered) {
      SimulationInput input = test::sheet(rest, pins, model->name);
      input.settings.iterations = 3;
      std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
      if (tethered)
        for (auto& pass : test::effect_passes<double>("tethers", rest, pins))
          passes.push_back(std::move(pass));
      const auto simulation = make_simulation<double>(input, std::move(passes));
      for (int s = 0; s < 60; ++s) REQUIRE(simulation->step());
      return farthest(rest, pins, simulation->positions(), true);
    };
    INFO(model->name);
    // Tethers come after strain, and gravity acts after them. The tether to the nearest pin is exact.
    CHECK(longest(true) <= 1 + 1e-9);
    CHECK(longest(false) > 1.02);
  }
}

}  // namespace bendlab::tethers_test
