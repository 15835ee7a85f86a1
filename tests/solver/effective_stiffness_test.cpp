// The effective stiffness: which share of the stated stiffness the solver realises. It is compared with
// single constraints, with a projection sweep solved by hand, and with strips.
#include "bendlab/constraints/effective_stiffness.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "bendlab/bending/calibration.hpp"
#include "bendlab/bending/rest_hinges.hpp"
#include "tests/bending/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::solver_effective_stiffness_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

constexpr double gravity = 9.81;  // m/s²

template <class Real>
std::unique_ptr<Simulation> in_gravity(const SimulationInput& input) {
  return make_simulation<Real>(
      input, test::effect_passes<Real>("gravity", "acceleration", std::vector<double>{0, 0, -gravity}));
}

// Two triangles with one free corner, which only the hinge holds up.
SimulationInput one_hinge(double size = 0.1) {
  const RestMesh rest(grid(size, size, 1, 1));
  const std::array<int, 4> corner = rest_hinges(rest, make_pins(rest, {}, 0)).at(0).vertices;
  SimulationInput input =
      test::sheet(rest, make_pins(rest, {corner[0], corner[1], corner[2]}, 0), "dihedral");
  input.strain = {};
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .k = 1, .compliance = 1e3};
  return input;
}

RestMesh strip_mesh() {
  return RestMesh(equilateral(0.25, 0.14, 10, Rows::perpendicular));
}

// A strip of a lattice along x with the flexural rigidity `rigidity` (N m). Its first cells are clamped.
SimulationInput strip(double rigidity, const char* model = "dihedral") {
  const RestMesh rest = strip_mesh();
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 1);
  SimulationInput input = test::sheet(rest, pins, model);
  BendingConstraints bending = test::built(model, rest, pins, {});
  calibrate(bending, rest, pins, {.flexural_rigidity = rigidity});
  input.distance = std::move(bending.distance), input.elements = std::move(bending.elements);
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .k = 1, .compliance = 1};
  return input;
}

struct Settled {
  double droop, share;  // m, 1
};

// The strip after two seconds with strong drag. Its slowest mode decays by more than e⁻⁵ per second.
template <class Real>
Settled settled(SimulationInput input, int substeps) {
  input.settings.substeps = substeps, input.settings.iterations = 1;
  const RestMesh rest = strip_mesh();
  auto passes = test::effect_passes<Real>("gravity", "acceleration", std::vector<double>{0, 0, -0.5});
  for (Pass<Real>& pass : test::effect_passes<Real>(
           "viscous_drag", rest, make_pins(rest, select_vertices(rest, Place::left), 1), "coefficient", 4.0))
    passes.push_back(std::move(pass));
  const auto simulation = make_simulation<Real>(input, std::move(passes));
  for (int step = 0; step < 120; ++step) REQUIRE(simulation->step());
  return {-simulation->positions().col(2).minCoeff(),
          simulation->effective_stiffness()->bending_share().value()};
}

}  // namespace

TEST_CASE("the rounding of a hinge's angle follows from its gradient", "[effective stiffness]") {
  // Two right triangles share the diagonal of a square and have the height h = size / √2. So |∇θ| is 1 / h at
  // all four corners.
  for (const double size : {0.1, 10.0}) {
    SimulationInput input = one_hinge(size);
    const auto simulation = make_simulation<double>(input, {});
    REQUIRE(simulation->step());
    REQUIRE(simulation->effective_stiffness());
    const double rounding = size / 2 * std::numeric_limits<double>::epsilon();  // of the largest coordinate
    const double alpha = input.bending_stiffness.compliance *
                         std::get<ElementList<HingeAngle>>(input.elements).softness.at(0) /
                         std::pow(input.settings.dt / input.settings.substeps, 2);
    CHECK_THAT(simulation->effective_stiffness()->hinges.rounding,
               WithinRel(rounding * rounding * 8 / (size * size) / alpha, 1e-9));
  }
}

TEMPLATE_TEST_CASE("a single hinge has the stated stiffness", "[effective stiffness]", float, double) {
  SimulationInput input = one_hinge();
  const auto simulation = in_gravity<TestType>(input);
  for (int step = 0; step < 20; ++step) REQUIRE(simulation->step());
  const EffectiveStiffness stiffness = simulation->effective_stiffness().value();
  // With a single hinge, the projection finds λ exactly. In float, λ and the angle have relative errors of
  // about 10⁻⁵.
  CHECK_THAT(stiffness.bending_share().value(), WithinRel(1.0, sizeof(TestType) == 4 ? 1e-3 : 1e-6));
  CHECK(!stiffness.membrane_share());
}

TEST_CASE("the effective stiffness of a batch follows from its multipliers", "[effective stiffness]") {
  const RestMesh rest(grid(1, 1, 4, 4));
  const Pins pins = make_pins(rest, {}, 0);
  const ElementList<HingeAngle> list = angle_constraints(rest_hinges(rest, pins), HingeAngle::Law::angle,
                                                         [](const RestHinge&) { return 2.0; });
  BatchOrder order{.stacks = {0}, .colours = {0, 1}};
  for (std::size_t c = 0; c < list.size(); ++c) order.first.push_back(static_cast<int>(c));
  while (order.first.size() % max_lanes != 0) order.first.push_back(-1);
  for (std::size_t lane = max_lanes; lane <= order.first.size(); lane += max_lanes)
    order.stacks.push_back(lane);
  order.colours.back() = order.stack_count();
  Constraints<double> constraints;
  auto& batch = std::get<ElementBatch<double, HingeAngle>>(constraints.elements);
  batch = make_element_batch<double>(list, order, rest.vertex_count());
  batch.kind = StiffnessKind::compliance, batch.compliance = 0.5;
  const double h = 0.01, alpha = 2 * 0.5 / (h * h), share = 0.3;
  const Positions bent = test::bent(rest, 0.5, 0.4);
  std::vector<Vector3> positions, at_rest;
  for (int v = 0; v < rest.vertex_count(); ++v)
    positions.push_back(bent.row(v).transpose()), at_rest.push_back(rest.position(v));
  for (std::size_t lane = 0; lane < order.lane_count(); ++lane) {
    batch.multiplier.push_back(0);
    if (lane >= list.size()) continue;
    std::array<Vector3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = positions[static_cast<std::size_t>(list.vertices[lane][i])];
    batch.multiplier[lane] = -share * HingeAngle::value(p, list.rest[lane], list.law).value / alpha;
  }
  const std::vector<char> free(positions.size(), 0);
  const auto measured = [&](const std::vector<Vector3>& at) {
    return effective_stiffness(constraints, {at, at_rest, free, h, 1e-12}).bending_share();
  };
  CHECK_THAT(measured(positions).value(), WithinRel(share, 1e-9));
  CHECK(!measured(at_rest));  // a sheet that is not bent has no share
  batch.kind = StiffnessKind::k;
  CHECK(!measured(positions));  // k is not a physical stiffness
}

TEST_CASE("the effective stiffness of springs follows from the bend, not from the stretch of the membrane",
          "[effective stiffness]") {
  const RestMesh rest(grid(1, 1, 8, 8));
  SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "k_ring");
  Constraints<double> constraints;
  const auto in_list_order = [](std::size_t count) {
    BatchOrder order{.stacks = {0}, .colours = {0}};
    // Each stack has a single constraint and padding.
    for (std::size_t c = 0; c < count; ++c) {
      order.first.push_back(static_cast<int>(c));
      while (order.first.size() % max_lanes != 0) order.first.push_back(-1);
      order.stacks.push_back(order.first.size()), order.colours.push_back(c + 1);
    }
    return order;
  };
  DistanceBatch<double>& batch = constraints.distance;
  batch =
      make_distance_batch<double>(input.distance, in_list_order(input.distance.size()), rest.vertex_count());
  constraints.strain =
      make_strain_batch<double>(input.strain, in_list_order(input.strain.size()), rest.vertex_count());
  batch.kind = StiffnessKind::compliance, batch.compliance = 1e-3;
  batch.multiplier.assign(batch.b.size(), 0);
  const double h = 0.01, alpha = 1e-3 / (h * h), curvature = 0.5;
  const Positions bent = test::bent(rest, curvature, 0);
  std::vector<Vector3> at_rest;
  for (int v = 0; v < rest.vertex_count(); ++v) at_rest.push_back(rest.position(v));
  for_each_lane(batch.order, [&](std::size_t lane, int c) {
    if (c < 0) return;
    const auto [a, b] = input.distance.vertices[static_cast<std::size_t>(c)];
    const double length = (bent.row(a) - bent.row(b)).norm();
    batch.multiplier[lane] = -(length - input.distance.rest(static_cast<std::size_t>(c))) / alpha;
  });
  const std::vector<char> free(at_rest.size(), 0);
  const auto share = [&](double scale) {
    std::vector<Vector3> positions;
    for (int v = 0; v < rest.vertex_count(); ++v) positions.push_back(scale * bent.row(v).transpose());
    return effective_stiffness(constraints, {positions, at_rest, free, h, 1e-12}).bending_share().value();
  };
  // C is κ² r³ / 24. Edges on the cylinder are chords and shorter than their arcs by 1/t² of C, which counts
  // as a strain of the membrane. So springs over t edges have the share 1 / (1 - 1/t²), which is 4/3 for t =
  // 2. Springs along a single edge do not count.
  CHECK(share(1) > 1);
  CHECK(share(1) < 1.4);
  // A stretch of the membrane by 10⁻³, which is more than springs shorten (t²/24 · 10⁻³), does not change the
  // share.
  CHECK_THAT(share(1.001), WithinRel(share(1), 0.01));
}

TEST_CASE("the share after a sweep that has not converged agrees with a dense computation",
          "[effective stiffness]") {
  const Sweep sweep = GENERATE(Sweep::forward, Sweep::symmetric);
  const int iterations = GENERATE(1, 3);
  CAPTURE(sweep == Sweep::symmetric, iterations);
  // A clamped strip with hinges alone. Heights are a millionth of its size, so angles are linear in the
  // heights.
  const RestMesh rest(grid(0.8, 0.1, 8, 1));
  SimulationInput input =
      test::sheet(rest, make_pins(rest, select_vertices(rest, Place::left), 0), "dihedral");
  input.strain = {};
  input.method = Pbd{.sweep = sweep, .order = ConstraintOrder::mesh};
  input.settings.iterations = iterations;
  const double h = input.settings.dt, compliance = 30;
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .k = 1, .compliance = compliance};
  std::mt19937_64 random(3);
  const auto count = static_cast<Eigen::Index>(rest.vertex_count());
  Eigen::VectorXd height = Eigen::VectorXd::Zero(count), w = Eigen::VectorXd::Zero(count);
  for (Eigen::Index v = 0; v < count; ++v) {
    if (input.is_pinned[static_cast<std::size_t>(v)] != 0) continue;
    w(v) = 1 / input.mass[static_cast<std::size_t>(v)];
    const double x = rest.positions()(v, 0) + 0.4;
    height(v) = 1e-6 * (x * x + test::uniform(random, -0.02, 0.02));
  }
  input.positions.col(2) = height;

  const auto& hinges = std::get<ElementList<HingeAngle>>(input.elements);
  const auto number = static_cast<Eigen::Index>(hinges.size());
  Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(number, count);  // dθ/dz, by difference quotients
  for (Eigen::Index c = 0; c < number; ++c)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& corner = hinges.vertices[static_cast<std::size_t>(c)];
      std::array<Vector3, 4> p;
      for (std::size_t j = 0; j < 4; ++j) p[j] = rest.position(corner[j]);
      constexpr double step = 1e-6;
      p[i].z() += step;
      slope(c, corner[i]) = hinge_angle(p, 1.0).value / step;
    }
  const Eigen::MatrixXd coupling = slope * w.asDiagonal() * slope.transpose();
  Eigen::VectorXd angle = slope * height, lambda = Eigen::VectorXd::Zero(number), alpha(number);
  for (Eigen::Index c = 0; c < number; ++c)
    alpha(c) = compliance * hinges.softness[static_cast<std::size_t>(c)] / (h * h);
  const auto project = [&](Eigen::Index c) {
    const double change = (-angle(c) - alpha(c) * lambda(c)) / (coupling(c, c) + alpha(c));
    lambda(c) += change, angle += change * coupling.col(c);
  };
  for (int iteration = 0; iteration < iterations; ++iteration) {
    for (Eigen::Index c = 0; c < number; ++c) project(c);
    for (Eigen::Index c = number; sweep == Sweep::symmetric && c-- > 0;) project(c);
  }
  const double applied = -lambda.dot(angle), stated = angle.cwiseQuotient(alpha).dot(angle),
               spent = lambda.cwiseProduct(alpha).dot(lambda);
  const double share = std::cbrt(applied / stated * std::pow(spent / applied, 2));
  REQUIRE(share > 0.05);
  REQUIRE(share < 0.95);  // not converged, so the test means something

  const auto simulation = make_simulation<double>(input, {});
  REQUIRE(simulation->step());
  // Angles of 10⁻⁵ are linear up to a relative 10⁻¹⁰. Difference quotients and rounding add 10⁻⁶.
  const EffectiveStiffness measured = simulation->effective_stiffness().value();
  CHECK_THAT(measured.hinges.applied / measured.hinges.stated, WithinRel(applied / stated, 1e-4));
  CHECK_THAT(measured.bending_share().value(), WithinRel(share, 1e-4));
}

TEMPLATE_TEST_CASE("a strip sinks as its effective stiffness predicts", "[effective stiffness]", float,
                   double) {
  SimulationInput input = strip(0.02);
  SECTION("forward") {}
  SECTION("symmetric") {
    input.method = Pbd{.sweep = Sweep::symmetric};
  }
  SECTION("in list order") {
    input.method = Pbd{.order = ConstraintOrder::mesh};
  }
  const Settled cheap = settled<TestType>(input, 8), converged = settled<TestType>(input, 64);
  // Small deflections are proportional to 1 / B.
  const double measured = converged.droop / cheap.droop * converged.share;
  CAPTURE(measured, cheap.share, converged.share, cheap.droop);
  CHECK(converged.share > 0.9);
  CHECK(measured < 0.7);
  CHECK_THAT(cheap.share, WithinRel(measured, 0.2));  // the required accuracy
}

TEST_CASE("a hanging membrane stretches as its effective stiffness predicts", "[effective stiffness]") {
  const RestMesh rest(grid(0.1, 0.3, 4, 12));
  SimulationInput input = test::sheet(rest, make_pins(rest, select_vertices(rest, Place::top), 0), "none");
  const double compliance = 0.02, density = 0.2, length = 0.3;
  input.strain_stiffness = {.kind = StiffnessKind::compliance, .compliance = compliance};
  input.settings.iterations = 1, input.settings.substeps = GENERATE(4, 8, 64);
  auto passes = test::effect_passes<double>("gravity", "acceleration", std::vector<double>{0, -gravity, 0});
  for (Pass<double>& pass :
       test::effect_passes<double>("viscous_drag", rest, make_pins(rest, {}, 0), "coefficient", 2.0))
    passes.push_back(std::move(pass));
  const auto simulation = make_simulation<double>(input, std::move(passes));
  for (int step = 0; step < 120; ++step) REQUIRE(simulation->step());
  const double elongation = -0.15 - simulation->positions().col(1).minCoeff();
  const double stated = density * gravity * length * length / 2 * compliance;  // ρ g L² / 2Y
  CAPTURE(elongation, stated);
  const double share = simulation->effective_stiffness()->membrane_share().value();
  CHECK_THAT(share, WithinRel(stated / elongation, 0.2));
}

TEMPLATE_TEST_CASE("a flat sheet at rest and a sheet with k have no effective stiffness",
                   "[effective stiffness]", float, double) {
  SimulationInput input = strip(0.02);
  SECTION("flat") {
    const auto simulation = make_simulation<TestType>(input, {});
    for (int step = 0; step < 5; ++step) REQUIRE(simulation->step());
    CHECK(!simulation->effective_stiffness()->bending_share());
  }
  SECTION("k") {
    input.bending_stiffness.kind = StiffnessKind::k;
    const auto simulation = in_gravity<TestType>(input);
    for (int step = 0; step < 5; ++step) REQUIRE(simulation->step());
    CHECK(!simulation->effective_stiffness()->bending_share());
    CHECK(!simulation->effective_stiffness()->membrane_share());
  }
}

}  // namespace bendlab::solver_effective_stiffness_test
