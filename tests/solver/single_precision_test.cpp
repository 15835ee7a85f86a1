// Short substeps in single precision, in which vertices move by far less than the last digit of a position.
#include <type_traits>

#include "bendlab/constraints/kernels.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::solver_single_precision_test {
namespace {

constexpr double gravity = 9.81, step = 1.0 / 60;

template <class Real>
std::unique_ptr<Simulation> simulation_with(SimulationInput input, std::vector<std::string> effects,
                                            const RestMesh& rest, const Pins& pins, double drag = 0) {
  std::vector<Pass<Real>> passes;
  for (const std::string& effect : effects)
    for (Pass<Real>& pass : effect == "viscous_drag"
                                ? test::effect_passes<Real>(effect, rest, pins, "coefficient", drag)
                                : test::effect_passes<Real>(effect, rest, pins))
      passes.push_back(std::move(pass));
  return make_simulation<Real>(input, std::move(passes));
}

SolverSettings settings(int substeps, int iterations) {
  SolverSettings solver;
  solver.substeps = substeps, solver.iterations = iterations;
  return solver;
}

Vector3 mean(const Positions& rows) {
  return rows.colwise().mean().transpose();
}

// A strip of 1 m that hangs by its upper end.
struct Strip {
  RestMesh rest;
  Pins pins;
  SimulationInput input{.method = Pbd{.sweep = Sweep::symmetric}};

  Strip(int across, int along, int substeps, int iterations)
      : rest(hanging(across, along)),
        pins(make_pins(rest, top(rest), 0)),
        input(test::sheet(rest, pins, "none")) {
    input.settings = settings(substeps, iterations);
    input.strain_stiffness.form = StrainForm::angle;
  }

  double length(const Simulation& simulation) const {
    return rest.positions().col(2).maxCoeff() - simulation.positions().col(2).minCoeff();
  }

 private:
  static TriangleMesh hanging(int across, int along) {
    TriangleMesh mesh = grid(0.25, 1, across, along, Diagonal::alternating);
    mesh.positions.col(2) = mesh.positions.col(1);
    mesh.positions.col(1).setZero();
    return mesh;
  }
  static std::vector<int> top(const RestMesh& rest) {
    std::vector<int> vertices;
    for (int v = 0; v < rest.vertex_count(); ++v)
      if (rest.position(v).z() > rest.positions().col(2).maxCoeff() - 1e-6) vertices.push_back(v);
    return vertices;
  }
};

}  // namespace

TEMPLATE_TEST_CASE("a sheet without pins falls by g t (t + h) / 2, also with very short substeps", "[solver]",
                   float, double) {
  // The sheet is 2 m wide: vertices far from the origin have fewer digits.
  const RestMesh rest(grid(2, 2, 2, 2, Diagonal::alternating));
  const Pins none = make_pins(rest, {}, 0);
  const bool apart = GENERATE(true, false);
  for (const int substeps : {1, 64, 4096}) {
    SimulationInput input = test::sheet(rest, none, "none");
    input.settings = settings(substeps, 1);
    input.moves_apart = apart;
    const auto simulation = simulation_with<TestType>(input, {"gravity"}, rest, none);
    const Vector3 start = mean(simulation->positions());
    for (int i = 0; i < 15; ++i) REQUIRE(simulation->step());
    const double t = simulation->time(), fallen = gravity * t * (t + step / substeps) / 2;
    CAPTURE(substeps, apart);
    // 4096 substeps per step round 60 000 times. An error of 10⁻⁴ is required.
    CHECK_THAT(start.z() - mean(simulation->positions()).z(), Catch::Matchers::WithinRel(fallen, 1e-5));
    CHECK_THAT(mean(simulation->velocities()).z(), Catch::Matchers::WithinRel(-gravity * t, 1e-5));
  }
}

TEMPLATE_TEST_CASE("a hanging strip keeps its length with 4096 substeps", "[solver]", float, double) {
  Strip strip(2, 8, 4096, 1);
  const auto simulation =
      simulation_with<TestType>(strip.input, {"gravity", "viscous_drag"}, strip.rest, strip.pins, 10.0);
  for (int i = 0; i < 6; ++i) REQUIRE(simulation->step());
  CHECK_THAT(strip.length(*simulation), Catch::Matchers::WithinAbs(1, 1e-3));
}

TEMPLATE_TEST_CASE("a membrane of known stiffness has its elongation with 256 substeps", "[solver]", float,
                   double) {
  // With lumped masses the elongation is ρ g L² / 2Y for any number of cells; 1 / Y = 0.01 m/N. The strip has
  // two columns of cells, because one column is not symmetric.
  Strip strip(2, 8, 256, 2);
  strip.input.strain_stiffness.kind = StiffnessKind::compliance;
  strip.input.strain_stiffness.compliance = 0.01;
  const auto simulation =
      simulation_with<TestType>(strip.input, {"gravity", "viscous_drag"}, strip.rest, strip.pins, 4.0);
  for (int i = 0; i < 60; ++i) REQUIRE(simulation->step());
  const double expected = 0.2 * gravity * 0.01 / 2;
  CHECK_THAT(strip.length(*simulation) - 1, Catch::Matchers::WithinRel(expected, 1e-2));
}

TEST_CASE("single precision agrees with double precision for any number of substeps", "[solver]") {
  // After 0.1 s the positions of the same sheet in both precisions agree to a few digits of an edge.
  const RestMesh rest(grid(1, 1, 6, 6, Diagonal::alternating));
  const Pins pins = make_pins(rest, {0, 6}, 0);
  for (const int substeps : {1, 16, 256}) {
    SimulationInput input = test::sheet(rest, pins, "dihedral");
    input.settings = settings(substeps, 2);
    input.bending_stiffness.kind = StiffnessKind::compliance;
    input.bending_stiffness.compliance = 10;
    const auto single = simulation_with<float>(input, {"gravity"}, rest, pins);
    const auto twice = simulation_with<double>(input, {"gravity"}, rest, pins);
    for (int i = 0; i < 6; ++i) REQUIRE((single->step() && twice->step()));
    CAPTURE(substeps);
    CHECK((single->positions() - twice->positions()).rowwise().norm().maxCoeff() <= 1e-4);
  }
}

TEST_CASE(
    "rounded positions are accurate enough if a substep moves the cloth by far more than the last digit",
    "[solver]") {
  // A hanging membrane, while it stretches and at rest. In one of eight substeps of a step of 1/60 s, 1 m of
  // cloth moves by 400 last digits. From 15 substeps on, the experiments store moves apart from positions.
  Strip strip(2, 8, 8, 2);
  strip.input.strain_stiffness.kind = StiffnessKind::compliance;
  strip.input.strain_stiffness.compliance = 0.01;
  strip.input.moves_apart = false;
  const auto single =
      simulation_with<float>(strip.input, {"gravity", "viscous_drag"}, strip.rest, strip.pins, 4.0);
  const auto twice =
      simulation_with<double>(strip.input, {"gravity", "viscous_drag"}, strip.rest, strip.pins, 4.0);
  for (int i = 0; i < 60; ++i) {
    REQUIRE((single->step() && twice->step()));
    CHECK((single->positions() - twice->positions()).rowwise().norm().maxCoeff() <= 1e-4);
  }
  CHECK_THAT(strip.length(*single) - 1, Catch::Matchers::WithinRel(strip.length(*twice) - 1, 1e-3));
}

TEST_CASE("a moving pin is exactly where a pass put it", "[solver]") {
  const RestMesh rest(grid(1, 1, 2, 2, Diagonal::alternating));
  const Pins pins = make_pins(rest, {0}, 0);
  for (const bool apart : {true, false}) {
    SimulationInput input = test::sheet(rest, pins, "none");
    input.settings = settings(4, 2), input.moves_apart = apart;
    std::vector<Pass<float>> passes = test::effect_passes<float>("gravity", rest, pins);
    passes.push_back({"put", Stage::predicted,
                      [](PassContext<float>& c) { c.state.position[0].x = static_cast<float>(c.time) / 3; }});
    const auto simulation = make_simulation<float>(input, std::move(passes));
    for (int i = 0; i < 10; ++i) REQUIRE(simulation->step());
    const double h = step / 4, last = simulation->time() - h;
    CAPTURE(apart);
    CHECK(simulation->positions()(0, 0) - input.origin.x() ==
          static_cast<double>(static_cast<float>(last) / 3));
    // Two positions near 0.05 m both have a rounding of 4e-9 m.
    CHECK_THAT(simulation->velocities()(0, 0), Catch::Matchers::WithinAbs(1.0 / 3, 2 * 4e-9 / h));
  }
}

TEST_CASE("an effect that moves vertices sees whole positions in single precision", "[solver]") {
  // With tethers a strip without a membrane keeps its length. Tethers work on positions, while the solver
  // works on displacements.
  Strip strip(1, 4, 16, 1);
  strip.input.strain = {};
  const auto simulation = simulation_with<float>(strip.input, {"gravity", "tethers"}, strip.rest, strip.pins);
  for (int i = 0; i < 30; ++i) REQUIRE(simulation->step());
  CHECK_THAT(strip.length(*simulation), Catch::Matchers::WithinAbs(1, 1e-5));
}

}  // namespace bendlab::solver_single_precision_test
