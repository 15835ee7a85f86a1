// The rigidity of a sheet of hinges under small bending, compared with closed forms on lattices and grids,
// and with clamped strips.
#include "bendlab/bending/sheet_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/bending/unit_bend.hpp"
#include "bendlab/solver/method.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"

namespace bendlab::sheet_response_test {
namespace {

using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

// All hinges of the mesh, each with the energy ½ θ².
std::vector<HeightStencil> uniform_hinges(const RestMesh& rest, std::span<const Vector2> plane) {
  std::vector<HeightStencil> stencils;
  for (const Hinge& hinge : rest.hinges()) {
    const std::array<int, 4> vertices = {hinge.edge[0], hinge.edge[1], hinge.opposite[0], hinge.opposite[1]};
    std::array<Vector2, 4> flat;
    for (std::size_t i = 0; i < 4; ++i) flat[i] = plane[static_cast<std::size_t>(vertices[i])];
    stencils.push_back({vertices, fold_weights(flat), 1});
  }
  return stencils;
}

SheetResponse::Answer answer_of(const RestMesh& rest, int patch = 0) {
  const std::vector<Vector2> plane = plane_coordinates(rest);
  const std::vector<HeightStencil> stencils = uniform_hinges(rest, plane);
  const std::vector<double> alike(stencils.size(), 1);
  const auto answer = SheetResponse(rest, make_pins(rest, {}, 0), plane, patch)(stencils, alike);
  REQUIRE(answer);
  return *answer;
}

double fact(const BendingConstraints& constraints, std::string_view name) {
  const auto match = std::ranges::find(constraints.facts, name, &BendingFact::name);
  REQUIRE(match != constraints.facts.end());
  return match->value;
}

BendingConstraints calibrated(std::string_view model, const RestMesh& rest, const Pins& pins, double rigidity,
                              Deflection deflection) {
  BendingConstraints constraints = test::built(model, rest, pins);
  calibrate(constraints, rest, pins, {.flexural_rigidity = rigidity, .deflection = deflection});
  return constraints;
}

// A clamped strip. It is wide compared with its length, so it bends to a cylinder for any Poisson's ratio.
struct Strip {
  static constexpr double density = 0.2, stated = 1e-3;
  RestMesh rest;
  Pins pins;
  SimulationInput input{.method = Pbd{}};
  double length = 0;

  Strip(const TriangleMesh& mesh, Deflection deflection)
      : rest(mesh),
        pins(make_pins(rest, select_vertices(rest, Place::left), 0, 0.02)),
        input(test::sheet(rest, pins, "none", density)) {
    BendingConstraints bending = calibrated("dihedral", rest, pins, stated, deflection);
    input.elements = std::move(bending.elements);
    input.strain_stiffness = {.kind = StiffnessKind::compliance, .compliance = 1e-7};
    input.bending_stiffness = {.kind = StiffnessKind::compliance, .compliance = 1};
    double clamp = rest.box_min().x();
    for (const int v : pins.all) clamp = std::max(clamp, rest.position(v).x());
    length = rest.box_max().x() - clamp;
  }

  // The gravity, m/s², under which the tip would sink by a thousandth of the length at the stated rigidity.
  double gravity() const { return 8e-3 * stated / (density * std::pow(length, 3)); }

  double tip(const Positions& positions) const {
    double sum = 0;
    int count = 0;
    for (int v = 0; v < rest.vertex_count(); ++v)
      if (rest.position(v).x() > rest.box_max().x() - 1e-9) sum += positions(v, 2), ++count;
    return sum / count;
  }

  Positions equilibrium() const {
    SimulationInput still = input;
    still.method = Equilibrium{};
    const auto simulation = make_simulation<double>(
        still, test::effect_passes<double>("gravity", "acceleration", std::vector<double>{0, 0, -gravity()}));
    for (int step = 0; step < 400 && !simulation->settled(); ++step) REQUIRE(simulation->step());
    return simulation->positions();
  }

  // The rigidity measured at the tip, ρ g L⁴ / (8 tip), over the stated rigidity.
  double share() const { return 1e-3 * length / -tip(equilibrium()); }
};

}  // namespace

TEST_CASE("on alternating diagonals a sheet bent a little keeps three quarters of the cylinder's energy",
          "[bending][calibration]") {
  // Every hinge has ½ θ², per cell area h². Hinges along the axes are second differences at the vertices of
  // valence 4 and have θ = κ h; hinges along the diagonals have θ = √2 κxy h. So D = 1, 1 and 2. Now shift
  // all vertices of valence 4 by u h/2 against the other vertices. The energy per shifted vertex is
  // proportional to (κxx h - u)² + (κyy h - u)² + 2 u². The minimum at u = (κxx + κyy) h / 4 gives D11 = 3/4,
  // D12 = -1/4.
  const SheetResponse::Answer answer = answer_of(RestMesh(grid(1, 1, 24, 24, Diagonal::alternating)));
  Rigidity stated, relaxed;
  stated << 1, 0, 0, 0, 1, 0, 0, 0, 2;
  relaxed << 0.75, -0.25, 0, -0.25, 0.75, 0, 0, 0, 2;
  // The weight of the measurement fades over ten cells at the rim, as the square of the distance from the
  // rim. Its curvature over half a cell leaves an error of 1/2 (1/10)².
  CHECK((answer.unrelaxed - stated).cwiseAbs().maxCoeff() < 6e-3 * 2);
  CHECK((answer.relaxed - relaxed).cwiseAbs().maxCoeff() < 6e-3 * 2);
  for (const double angle : {0.0, 0.4, 0.8, 1.2}) {
    const Vector2 d(std::cos(angle), std::sin(angle));
    CHECK_THAT(cylinder_rigidity(answer.relaxed, d), WithinRel(0.75, 6e-3));
    // The sheet is isotropic with D12 / D11 = -1/3, so a strip has 1 - 1/9 of the rigidity.
    CHECK_THAT(strip_rigidity(answer.relaxed, d), WithinRel(0.75 * 8 / 9, 6e-3));
  }
}

TEST_CASE("an equilateral lattice bends as stated, with a Poisson ratio of -1/3", "[bending][calibration]") {
  // The angle of a hinge is (κ_nn - κ_tt / 3) times its height √3/2 a. Summed over the three directions of
  // hinges, ½ θ² is the energy of an isotropic plate with D11 = √3/2, D12 = -D11 / 3, D33 = 2 (1 - ν) D11.
  // All vertices are alike, so the lattice is in equilibrium under uniform curvature: relaxing changes
  // nothing.
  const SheetResponse::Answer answer = answer_of(RestMesh(equilateral(1, 1, 24)));
  Rigidity plate;
  plate << 1, -1.0 / 3, 0, -1.0 / 3, 1, 0, 0, 0, 8.0 / 3;
  plate *= std::sqrt(3.0) / 2;
  CHECK((answer.unrelaxed - plate).cwiseAbs().maxCoeff() < 1e-2);  // the rim has rows of three kinds of edges
  CHECK((answer.relaxed - answer.unrelaxed).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("the response of a sheet does not depend on its rotation or on the measured patch",
          "[bending][calibration]") {
  TriangleMesh mesh = delaunay(1, 1, 24, 3);
  const SheetResponse::Answer answer = answer_of(RestMesh(mesh)), patch = answer_of(RestMesh(mesh), 40);
  CHECK(patch.relaxed == answer.relaxed);  // the whole sheet lies within 40 edges of its middle
  const double turn = 0.7;
  mesh.positions *= Eigen::AngleAxisd(turn, Vector3::UnitZ()).toRotationMatrix().transpose();
  const SheetResponse::Answer turned = answer_of(RestMesh(mesh));
  for (const double angle : {0.0, 0.5, 1.0, 2.0}) {
    const Vector2 d(std::cos(angle), std::sin(angle)), there(std::cos(angle + turn), std::sin(angle + turn));
    CHECK_THAT(cylinder_rigidity(turned.relaxed, there),
               WithinRel(cylinder_rigidity(answer.relaxed, d), 1e-9));
    CHECK_THAT(strip_rigidity(turned.relaxed, there), WithinRel(strip_rigidity(answer.relaxed, d), 1e-9));
    // A relaxed sheet has less energy, and a free strip less than one held to a cylinder.
    CHECK(cylinder_rigidity(answer.relaxed, d) < cylinder_rigidity(answer.unrelaxed, d));
    CHECK(strip_rigidity(answer.relaxed, d) < cylinder_rigidity(answer.relaxed, d));
  }
  // A patch of 800 of the 1700 vertices.
  CHECK_THAT(answer_of(RestMesh(delaunay(1, 1, 40, 3)), 16).relaxed(0, 0),
             WithinRel(answer_of(RestMesh(delaunay(1, 1, 40, 3))).relaxed(0, 0), 0.03));
}

TEST_CASE("hinges have the stated rigidity at the requested deflection", "[bending][calibration]") {
  for (const std::string_view model : {"dihedral", "bridson", "discrete_shells", "isometric"}) {
    INFO(model);
    const RestMesh rest(grid(0.24, 0.24, 20, 20, Diagonal::alternating));
    const Pins pins = make_pins(rest, {}, 0);
    const BendingConstraints large = calibrated(model, rest, pins, 1e-4, Deflection::large),
                             small = calibrated(model, rest, pins, 1e-4, Deflection::small);
    CHECK_THAT(fact(large, "large_deflection"), WithinRel(1.0, 0.01));
    CHECK_THAT(fact(large, "small_deflection"), WithinRel(0.75, 0.02));  // the hinges are only nearly alike
    CHECK_THAT(fact(small, "small_deflection"), WithinRel(1.0, 1e-9));
    CHECK_THAT(fact(small, "large_deflection") * fact(large, "small_deflection"),
               WithinRel(fact(large, "large_deflection"), 1e-9));  // all share one factor
    CHECK_THAT(fact(small, "linear_rms"), WithinAbs(fact(large, "linear_rms"), 1e-9));  // relative
    CHECK_THAT(
        test::energy(small, test::bent(rest, 0.1, 0.3)) / test::energy(large, test::bent(rest, 0.1, 0.3)),
        WithinRel(1 / fact(large, "small_deflection"), 1e-9));
  }
}

TEST_CASE("weighted hinges of an irregular sheet have nearly one rigidity at both deflections",
          "[bending][calibration]") {
  for (const std::uint64_t seed : {1u, 2u}) {
    const RestMesh rest(delaunay(0.24, 0.24, 20, seed));
    const Pins pins = make_pins(rest, {}, 0);
    const BendingConstraints large = calibrated("dihedral", rest, pins, 1e-4, Deflection::large),
                             both = calibrated("dihedral", rest, pins, 1e-4, Deflection::both);
    const auto gap = [](const BendingConstraints& sheet) {
      return fact(sheet, "large_deflection") - fact(sheet, "small_deflection");
    };
    CHECK(gap(large) > 0.05);
    CHECK(gap(both) < 0.6 * gap(large));
    CHECK_THAT(fact(both, "small_deflection") + fact(both, "large_deflection"), WithinRel(2.0, 1e-9));
    CHECK_THAT(fact(both, "small_deflection"), WithinRel(1.0, 0.03));
    CHECK_THAT(fact(both, "large_deflection"), WithinRel(1.0, 0.05));
  }
}

TEST_CASE("a clamped strip that bends a little has the rigidity stated for small deflections",
          "[bending][calibration]") {
  // Hinges at the edge of the clamp, where the strip begins, have twice their stiffness: this accounts for
  // the half row inside the clamp. The remaining error is a part of a cell of the length, 3 % on nine cells.
  const TriangleMesh mesh = grid(0.12, 0.3, 12, 30, Diagonal::alternating);
  CHECK_THAT(Strip(mesh, Deflection::small).share(), WithinRel(1.0, 0.03));
  CHECK_THAT(Strip(mesh, Deflection::large).share(), WithinRel(0.75, 0.04));
}

TEST_CASE("a clamped strip vibrates at the frequency that follows from its static rigidity",
          "[bending][calibration]") {
  // ω² = 12.3624 B / (ρ L⁴), and the tip sinks by ρ g L⁴ / (8 B). So ω² tip / g = 1.54530 for any B, ρ and L.
  // The strip is released from its shape under gravity, which is its first mode within 1 %. The projection of
  // its motion on this shape gives the frequency.
  Strip strip(grid(0.12, 0.06, 12, 6, Diagonal::alternating), Deflection::large);
  const Positions still = strip.equilibrium();
  strip.input.positions = still;
  constexpr int substeps = 512;
  strip.input.settings = {.dt = 1e-3 * 16, .substeps = substeps, .iterations = 1};
  strip.input.method = Pbd{.sweep = Sweep::symmetric};
  const auto simulation = make_simulation<double>(strip.input, {});
  const auto part = [&](const Positions& positions) {
    double sum = 0;
    for (int v = 0; v < strip.rest.vertex_count(); ++v)
      sum += strip.input.mass[static_cast<std::size_t>(v)] * still(v, 2) * positions(v, 2);
    return sum;
  };
  std::vector<double> crossings;
  double before = part(simulation->positions());
  while (crossings.size() < 2 && simulation->time() < 3) {
    REQUIRE(simulation->step());
    const double now = part(simulation->positions());
    if ((now > 0) != (before > 0))
      crossings.push_back(simulation->time() - strip.input.settings.dt * now / (now - before));
    before = now;
  }
  REQUIRE(crossings.size() == 2);
  const double frequency = std::numbers::pi / (crossings[1] - crossings[0]);
  CHECK_THAT(frequency * frequency * -strip.tip(still) / strip.gravity(), WithinRel(1.54530, 0.02));
}

TEST_CASE("calibration for small deflections refuses sheets and models that do not allow it",
          "[bending][calibration]") {
  const auto refusal = [](std::string_view model, const TriangleMesh& mesh) {
    const RestMesh rest(mesh);
    BendingConstraints constraints = test::built(model, rest);
    try {
      calibrate(constraints, rest, make_pins(rest, {}, 0),
                {.flexural_rigidity = 1e-4, .deflection = Deflection::small});
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(refusal("dihedral", grid(1, 1, 2, 2)), ContainsSubstring("5 edges away"));
  CHECK_THAT(refusal("dihedral", tube(0.3, 0.3, 0.6, 24)), ContainsSubstring("flat"));
  CHECK_THAT(refusal("choi_ko", equilateral(1, 1, 12)), ContainsSubstring("only for hinges"));
  CHECK(refusal("dihedral", grid(1, 1, 12, 12)) == "accepted");
}

}  // namespace bendlab::sheet_response_test
