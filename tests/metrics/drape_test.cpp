// The drape coefficient of shapes whose shadow is known.
#include "bendlab/metrics/drape.hpp"

#include <numbers>
#include <stdexcept>

#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::drape_test {
namespace {

using Catch::Matchers::WithinAbs;

const RestMesh& specimen() {
  static const RestMesh rest(disc(0.15, 60));
  return rest;
}

// The table: 36 of 60 rings.
Pins table() {
  return make_pins(specimen(), select_vertices(specimen(), Place::centre), 36);
}

// Positions in which the overhang extends to `reach(angle)` m from the centre.
template <class Reach>
Positions draped(const Reach& reach) {
  Positions x = specimen().positions();
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double r = x.row(v).norm(), angle = std::atan2(x(v, 1), x(v, 0));
    if (r <= 0.09 + 1e-9) continue;
    const double share = (r - 0.09) / 0.06, out = 0.09 + share * (reach(angle) - 0.09);
    x.row(v) << out * std::cos(angle), out * std::sin(angle), -0.05 * share;
  }
  return x;
}

}  // namespace

TEST_CASE("drape: the coefficient of circular shadows is right", "[metrics]") {
  const Vector3 down = -Vector3::UnitZ();
  CHECK_THAT(drape_of(specimen(), table(), specimen().positions(), down).coefficient, WithinAbs(1, 1e-6));
  // Shadows of radius 9, 11 and 13 cm cover 0, 27.8 and 61.1 % of the ring between 9 and 15 cm. The table is
  // a polygon of 216 corners, the specimen has 360 corners, and 3 600 directions are sampled: an error of
  // 1e-4.
  for (const auto& [radius, expected] : {std::pair{0.09, 0.0}, {0.11, 0.2778}, {0.13, 0.6111}}) {
    const Drape drape = drape_of(specimen(), table(), draped([r = radius](double) { return r; }), down);
    CHECK_THAT(drape.coefficient, WithinAbs(expected, 4e-4));
    CHECK(drape.folds == 0);
  }
}

TEST_CASE("drape: the coefficient of a shadow with folds is right", "[metrics]") {
  // A reach of 0.12 (1 + a cos 5θ) encloses π 0.12² (1 + a² / 2).
  const double a = 0.1, pi = std::numbers::pi;
  const Drape drape =
      drape_of(specimen(), table(), draped([&](double t) { return 0.12 * (1 + a * std::cos(5 * t)); }),
               -Vector3::UnitZ());
  CHECK(drape.folds == 5);
  CHECK_THAT(drape.coefficient,
             WithinAbs((pi * 0.0144 * (1 + a * a / 2) - pi * 0.0081) / (pi * (0.0225 - 0.0081)), 1e-3));
}

TEST_CASE("drape: the scene needs a table and cloth that hangs over it", "[metrics]") {
  const Vector3 down = -Vector3::UnitZ();
  CHECK_THROWS_AS(drape_of(specimen(), make_pins(specimen(), {0}, 0), specimen().positions(), down),
                  std::invalid_argument);
  CHECK_THROWS_AS(drape_of(specimen(), make_pins(specimen(), {0}, 60), specimen().positions(), down),
                  std::invalid_argument);
}

}  // namespace bendlab::drape_test
