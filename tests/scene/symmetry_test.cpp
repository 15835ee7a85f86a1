// Planes of symmetry: a quarter of a plate bends like a quarter of the whole plate.
#include <cmath>

#include "bendlab/scene/simulate.hpp"
#include "tests/catch.hpp"

namespace bendlab::symmetry_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

// A plate under a pressure, which rests on its border. `size` in m: 2 is the whole plate, 1 a quarter of it.
Scene plate(double size, int cells, double pressure) {
  Scene scene;
  scene.mesh = grid(size, size, cells, Diagonal::both);
  scene.material.youngs_modulus = 1e6, scene.material.thickness = 0.05, scene.material.poisson_ratio = 0.3;
  scene.bending.model = Dkt{};
  scene.effects = {Pressure{.pressure = pressure}};
  scene.solver.method = Equilibrium{};
  scene.pins.vertices = {};
  if (size == 2) {
    scene.pins.hold_x = {Place::centre}, scene.pins.hold_y = {Place::centre};
    scene.pins.hold_z = {Place::left, Place::right, Place::bottom, Place::top};
  } else {
    scene.pins.hold_x = {Place::left}, scene.pins.hold_y = {Place::bottom};
    scene.pins.symmetry = {CoordinateAxis::x, CoordinateAxis::y};
    scene.pins.hold_z = {Place::right, Place::top};
  }
  return scene;
}

// The height of the plate's middle at rest.
double middle(const Scene& scene, Place place) {
  Cloth cloth = simulate(scene);
  cloth.run(1);
  return cloth.positions()(select_vertices(cloth.scene().rest, place).front(), 2);
}

}  // namespace

TEST_CASE("a quarter of a plate with planes of symmetry bends like the whole plate", "[scene]") {
  // With the larger pressure the plate sinks by more than its thickness, and the membrane bears a part.
  for (const double pressure : {0.005, 50.0}) {
    INFO(pressure);
    const double whole = middle(plate(2, 16, pressure), Place::centre),
                 quarter = middle(plate(1, 8, pressure), Place::lower_left);
    CHECK_THAT(quarter, WithinRel(whole, 1e-5));  // of the tolerance of the equilibrium
  }
  // Timoshenko and Woinowsky-Krieger 1959, §30: 0.00406 p a⁴ / D. The error of 32 cells is below 1 %.
  const double rigidity = 1e6 * std::pow(0.05, 3) / 12 / (1 - 0.3 * 0.3);
  CHECK_THAT(std::abs(middle(plate(1, 16, 0.005), Place::lower_left)),
             WithinRel(0.00406 * 0.005 * 16 / rigidity, 0.01));
  // Without the slopes, the quarter sinks much further.
  Scene hinged = plate(1, 8, 0.005);
  hinged.pins.symmetry = {};
  CHECK(std::abs(middle(hinged, Place::lower_left)) >
        2 * std::abs(middle(plate(2, 16, 0.005), Place::centre)));
}

TEST_CASE("a quarter of a plate moves like the whole plate", "[scene]") {
  struct Case {
    Method method;
    int cells;
    // The largest relative difference. Newton's method converges to rounding errors. At the end of a substep
    // of quasi_newton less than a thousandth of the forces is unbalanced, which changes the path by less than
    // a thousandth.
    double most;
  };
  for (const Case& with :
       {Case{Newton{}, 4, 1e-9}, Case{QuasiNewton{.membrane = QuasiNewton::Membrane::stated}, 8, 1e-3}}) {
    INFO(with.method.name());
    // The height of the middle. In such short substeps inertia is large, and quasi_newton converges.
    const auto height = [&](double size, int cells, Place place) {
      Scene scene = plate(size, cells, 50);
      scene.solver.method = with.method, scene.solver.precision = ChosenPrecision::double_precision;
      if (with.method.name() == "newton") scene.solver.precision = ChosenPrecision::automatic;
      scene.solver.dt = 0.0002, scene.solver.iterations = 200;
      Cloth cloth = simulate(scene);
      cloth.run(0.02);
      CHECK(cloth.simulation().step_residual().value().share() < 1e-3);
      return cloth.positions()(select_vertices(cloth.scene().rest, place).front(), 2);
    };
    const double whole = height(2, with.cells, Place::centre),
                 quarter = height(1, with.cells / 2, Place::lower_left);
    CHECK(std::abs(whole) > 0.01);  // m
    CHECK_THAT(quarter, WithinRel(whole, with.most));
  }
}

TEST_CASE("a plane of symmetry needs held vertices, and a model with slopes at vertices", "[scene]") {
  Scene scene = plate(1, 4, 1);
  scene.pins.hold_x = {};
  CHECK_THROWS_WITH(simulate(scene), ContainsSubstring("/pins/hold_x"));
  scene = plate(1, 4, 1);
  scene.pins.symmetry = {CoordinateAxis::z};  // the plane of the sheet
  CHECK_THROWS_WITH(simulate(scene), ContainsSubstring("right angle") && ContainsSubstring("/pins/hold_z"));
  scene = plate(1, 4, 1);
  scene.bending.model = MidEdge{};
  CHECK_THROWS_WITH(simulate(scene), ContainsSubstring("choose dkt"));
}

}  // namespace bendlab::symmetry_test
