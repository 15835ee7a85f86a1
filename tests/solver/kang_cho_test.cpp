// The step of Kang & Cho, compared with formulas by hand, with a separate dense implementation and with
// backward Euler.
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <stdexcept>

#include "bendlab/metrics/motion.hpp"
#include "bendlab/solver/method.hpp"
#include "bendlab/solver/spring_rows.hpp"
#include "tests/catch.hpp"
#include "tests/support.hpp"

namespace bendlab::kang_cho_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::VectorXd;

constexpr double gravity = 9.81;

using Tangent = KangCho::Tangent;

SimulationInput with_springs(SimulationInput input, double dt, double membrane_compliance,
                             double bending_compliance) {
  input.strain = {};
  input.strain_stiffness = {.kind = StiffnessKind::compliance, .compliance = membrane_compliance};
  input.bending_stiffness = {.kind = StiffnessKind::compliance, .compliance = bending_compliance};
  input.method = KangCho{};
  input.settings.dt = dt;
  return input;
}

// A sheet at rest with edge springs and the springs of a model.
SimulationInput spring_sheet(const RestMesh& rest, const Pins& pins, std::string_view model, double dt,
                             double membrane_compliance = 1e-2, double bending_compliance = 1) {
  SimulationInput input =
      with_springs(test::sheet(rest, pins, model), dt, membrane_compliance, bending_compliance);
  input.edges = edge_springs(rest, pins);
  return input;
}

// Two masses on the x axis, `length` apart.
SimulationInput two_masses(double m0, double m1, double k, double rest_length, double length, double dt) {
  SimulationInput input{.method = Pbd{}};
  input.positions = Positions::Zero(2, 3);
  input.positions(1, 0) = length;
  input.velocities = Positions::Zero(2, 3);
  input.origin.setZero();
  input.mass = {m0, m1};
  input.is_pinned = {0, 0};
  input.edges = {.vertices = {{0, 1}}, .rest_length = {rest_length}};
  return with_springs(std::move(input), dt, 1 / k, 1);
}

template <class Real>
std::unique_ptr<Simulation> falling(const SimulationInput& input, double acceleration = gravity) {
  return make_simulation<Real>(
      input, test::effect_passes<Real>("gravity", "acceleration", std::vector<double>{0, 0, -acceleration}));
}

// A small irregular sheet, crumpled and moving, with different masses and vertices of every degree.
SimulationInput crumpled_sheet(std::vector<int> pinned, double dt, std::string_view model = "crossover") {
  const RestMesh rest(delaunay(1, 1, 5, 3));
  SimulationInput input = spring_sheet(rest, make_pins(rest, std::move(pinned), 0), model, dt, 1e-2, 0.05);
  std::mt19937_64 random(5);
  input.velocities = Positions::Zero(rest.vertex_count(), 3);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const auto at = static_cast<std::size_t>(v);
    input.mass[at] *= test::uniform(random, 0.5, 2);
    if (input.is_pinned[at]) continue;
    input.positions.row(v) += test::random_vector(random, 0.05).transpose();
    input.velocities.row(v) = test::random_vector(random, 1).transpose();
  }
  return input;
}

// The formulas once more, with global dense matrices.
struct Dense {
  MatrixXd stiffness;        // K: 3#V by 3#V, tangent
  MatrixXd diagonal_blocks;  // of K
  VectorXd force, mass, velocity;
  std::vector<char> is_free;  // 3#V

  Dense(const SimulationInput& input, Tangent tangent)
      : stiffness(MatrixXd::Zero(3 * count(input), 3 * count(input))),
        force(VectorXd::Zero(3 * count(input))),
        mass(3 * count(input)),
        velocity(VectorXd::Zero(3 * count(input))) {
    add(input, input.edges, 1 / input.strain_stiffness.compliance, tangent);
    add(input, input.distance, 1 / input.bending_stiffness.compliance, tangent);
    diagonal_blocks = MatrixXd::Zero(force.size(), force.size());
    for (Eigen::Index v = 0; v < count(input); ++v) {
      diagonal_blocks.block<3, 3>(3 * v, 3 * v) = stiffness.block<3, 3>(3 * v, 3 * v);
      mass.segment<3>(3 * v).setConstant(input.mass[static_cast<std::size_t>(v)]);
      if (input.velocities.rows() > 0) velocity.segment<3>(3 * v) = input.velocities.row(v).transpose();
      is_free.insert(is_free.end(), 3, !input.is_pinned[static_cast<std::size_t>(v)]);
    }
  }

  static Eigen::Index count(const SimulationInput& input) { return input.positions.rows(); }

  void add(const SimulationInput& input, const DistanceConstraints& list, double k, Tangent tangent) {
    for (std::size_t c = 0; c < list.size(); ++c) {
      const auto [a, b] = list.vertices[c];
      const Vector3 d = (input.positions.row(b) - input.positions.row(a)).transpose();
      const double length = d.norm(), rest = list.rest(c);
      const Matrix3d along = d * d.transpose() / d.squaredNorm(), across = Matrix3d::Identity() - along;
      const double share = tangent == Tangent::along  ? 0
                           : tangent == Tangent::taut ? std::max(0.0, 1 - rest / length)
                                                      : 1;
      const Matrix3d j = k * (along + share * across);
      stiffness.block<3, 3>(3 * a, 3 * a) += j;
      stiffness.block<3, 3>(3 * b, 3 * b) += j;
      stiffness.block<3, 3>(3 * a, 3 * b) -= j;
      stiffness.block<3, 3>(3 * b, 3 * a) -= j;
      const Vector3 pull = k * (length - rest) * d / length;
      force.segment<3>(3 * a) += pull;
      force.segment<3>(3 * b) -= pull;
    }
  }

  VectorXd without_pinned(VectorXd x) const {
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (!is_free[static_cast<std::size_t>(i)]) x(i) = 0;
    return x;
  }

  VectorXd right_hand_side(double h, const VectorXd& external) const {
    return without_pinned(h * force + h * external - h * h * stiffness * velocity);
  }

  // Two steps of block Jacobi from zero.
  VectorXd kang_cho(double h, const VectorXd& external) const {
    const MatrixXd w = MatrixXd(mass.asDiagonal()) + h * h * diagonal_blocks;
    const MatrixXd off_diagonal = h * h * (diagonal_blocks - stiffness);
    const VectorXd p = right_hand_side(h, external);
    const Eigen::PartialPivLU<MatrixXd> solver(w);
    const VectorXd guess = without_pinned(solver.solve(p));
    return without_pinned(solver.solve(p + off_diagonal * guess));
  }

  // The solution of the linear system.
  VectorXd backward_euler(double h) const {
    MatrixXd a = MatrixXd(mass.asDiagonal()) + h * h * stiffness;
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      if (!is_free[static_cast<std::size_t>(i)]) a.row(i).setZero(), a.col(i).setZero(), a(i, i) = 1;
    return a.ldlt().solve(right_hand_side(h, VectorXd::Zero(mass.size())));
  }
};

VectorXd rows_to_vector(const Positions& rows) {
  return Eigen::Map<const VectorXd>(rows.data(), rows.size());
}

Positions velocities_after_a_step(const SimulationInput& input, double acceleration = 0) {
  const auto simulation =
      acceleration == 0 ? make_simulation<double>(input, {}) : falling<double>(input, acceleration);
  REQUIRE(simulation->step());
  return simulation->velocities();
}

double momentum_gained(const SimulationInput& input) {
  const Positions velocities = velocities_after_a_step(input);
  const Motion before = motion_of(input.mass, input.positions, input.velocities);
  const Motion after = motion_of(input.mass, input.positions, velocities);
  return (after.linear_momentum - before.linear_momentum).norm();
}

// Σ m |Δv|: the momentum that vertices exchange.
double momentum_exchanged(const SimulationInput& input) {
  const Positions change = velocities_after_a_step(input) - input.velocities;
  double sum = 0;
  for (Eigen::Index v = 0; v < change.rows(); ++v)
    sum += input.mass[static_cast<std::size_t>(v)] * change.row(v).norm();
  return sum;
}

// The slope of log error over log h between steps h and h / 2.
template <class Error>
double order_of(const Error& error, double h) {
  return std::log2(error(h) / error(h / 2));
}

SimulationInput hanging_sheet(int cells, double dt, double membrane_compliance, Tangent tangent) {
  const RestMesh rest(grid(1, 1, cells, cells));
  SimulationInput input = spring_sheet(rest, make_pins(rest, select_vertices(rest, Place::upper_right), 1),
                                       "crossover", dt, membrane_compliance, 100 * membrane_compliance);
  input.method = KangCho{.tangent = tangent};
  return input;
}

// Whether the sheet moves by no more than its size in two simulated seconds.
bool stays_bounded(const SimulationInput& input) {
  const auto simulation = falling<double>(input);
  while (simulation->time() < 2)
    if (!simulation->step() || (simulation->positions() - input.positions).cwiseAbs().maxCoeff() > 10)
      return false;
  return true;
}

}  // namespace

TEST_CASE("kang_cho: two masses on a spring agree with a computation by hand", "[solver]") {
  // Along the spring, with κ = h² k, s = stretch and u = v1 - v0: p0 = h k s + κ u = -p1 = p,
  // Δv0 = (p - κ p / (m1 + κ)) / (m0 + κ) = p m1 / ((m0 + κ) (m1 + κ)). Across the spring nothing changes.
  const double m0 = 0.3, m1 = 1.7, k = 250, h = 0.02, rest = 0.8, length = 1.1, u = -2;
  SimulationInput input = two_masses(m0, m1, k, rest, length, h);
  input.velocities(1, 0) = u;
  input.velocities(1, 1) = 0.5;
  const double kappa = h * h * k, p = h * k * (length - rest) + kappa * u;
  const double impulse = p * m0 * m1 / ((m0 + kappa) * (m1 + kappa));
  Positions expected(2, 3);
  expected << impulse / m0, 0, 0, u - impulse / m1, 0.5, 0;
  const auto simulation = make_simulation<double>(input, {});
  REQUIRE(simulation->step());
  // Rounding of a dozen operations on numbers near 1.
  CHECK((simulation->velocities() - expected).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((simulation->positions() - (input.positions + h * expected)).cwiseAbs().maxCoeff() < 1e-14);

  // If the other end is pinned, nothing comes back through the spring, and the step is backward Euler.
  input.is_pinned[1] = 1;
  input.velocities.setZero();
  const Positions velocities = velocities_after_a_step(input);
  CHECK_THAT(velocities(0, 0), WithinRel(h * k * (length - rest) / (m0 + kappa), 1e-14));
  CHECK(velocities.row(1).norm() == 0);
}

TEST_CASE("kang_cho: a falling spring is slowed down by the factor 1 - (κ / (m + κ))²", "[solver]") {
  // A vertical spring between equal masses: both have p = m h g, and Δv = h g m (m + 2κ) / (m + κ)².
  const double m = 0.2, k = 300, h = 0.01, kappa = h * h * k;
  SimulationInput input = two_masses(m, m, k, 1, 1, h);
  input.positions.row(1) << 0, 0, 1;
  const Positions velocities = velocities_after_a_step(input, gravity);
  const double slowed = 1 - std::pow(kappa / (m + kappa), 2);
  for (int v = 0; v < 2; ++v) CHECK_THAT(velocities(v, 2), WithinRel(-slowed * h * gravity, 1e-13));
}

TEST_CASE("kang_cho: the step agrees with a dense implementation", "[solver]") {
  for (const Tangent tangent : {Tangent::along, Tangent::taut, Tangent::isotropic})
    for (const double h : {1e-3, 1e-2, 1e-1})
      for (const char* model : {"none", "crossover", "k_ring"}) {
        SimulationInput input = crumpled_sheet({0, 7, 8}, h, model);
        input.method = KangCho{.tangent = tangent};
        VectorXd weight = VectorXd::Zero(input.positions.size());
        for (Eigen::Index v = 0; v < input.positions.rows(); ++v)
          weight(3 * v + 2) = -gravity * input.mass[static_cast<std::size_t>(v)];
        const Dense dense(input, tangent);
        const VectorXd change = dense.kang_cho(h, weight);
        const VectorXd after = rows_to_vector(velocities_after_a_step(input, gravity));
        // Rounding, amplified by W: κ / m is up to a few hundred.
        CHECK((after - dense.velocity - change).cwiseAbs().maxCoeff() < 1e-12 * change.cwiseAbs().maxCoeff());
      }
}

TEST_CASE("kang_cho: single precision agrees with double precision up to rounding", "[solver]") {
  const SimulationInput input = crumpled_sheet({0}, 1e-2);
  const auto simulation = falling<float>(input);
  REQUIRE(simulation->step());
  const Positions expected = velocities_after_a_step(input, gravity);
  // ε = 6e-8, amplified by the cancellation of lengths in forces (1 / strain = 10) and the condition of W
  // (hundreds).
  CHECK((simulation->velocities() - expected).cwiseAbs().maxCoeff() < 1e-4 * expected.cwiseAbs().maxCoeff());
}

TEST_CASE("kang_cho: the distance from the solution of the implicit system is O(h⁵)", "[solver]") {
  // Two Jacobi steps reduce the error to G² Δv, with G = O(h²) and Δv = O(h).
  const auto error = [](double h) {
    const SimulationInput input = crumpled_sheet({0}, h);
    const Dense dense(input, Tangent::along);
    const VectorXd after = rows_to_vector(velocities_after_a_step(input));
    return (after - dense.velocity - dense.backward_euler(h)).norm();
  };
  CHECK_THAT(order_of(error, 2e-4), WithinAbs(5, 0.05));  // the next order: h² Σ k / m = 0.5 %
}

TEST_CASE("kang_cho: the distance from backward Euler is O(h²), or O(h³) from rest", "[solver]") {
  // v = v0 + h M⁻¹ f(x + h v) is solved by fixed-point iteration, which converges for these steps. The
  // tangent `along` leaves out h · h K_across (v0 + Δv) / m. This is O(h²) with velocities at the start and
  // O(h³) without.
  const auto error = [](bool moving, double h) {
    SimulationInput input = crumpled_sheet({0}, h);
    if (!moving) input.velocities.setZero();
    const VectorXd start = rows_to_vector(input.velocities);
    SimulationInput end = input;
    VectorXd v = start;
    for (int iteration = 0; iteration < 100; ++iteration) {
      end.positions = input.positions + h * Eigen::Map<const Positions>(v.data(), input.positions.rows(), 3);
      const Dense dense(end, Tangent::along);
      v = start + dense.without_pinned(h * dense.force.cwiseQuotient(dense.mass));
    }
    return (rows_to_vector(velocities_after_a_step(input)) - v).norm();
  };
  CHECK_THAT(order_of([&](double h) { return error(true, h); }, 5e-5), WithinAbs(2, 0.1));
  CHECK_THAT(order_of([&](double h) { return error(false, h); }, 5e-5), WithinAbs(3, 0.1));
}

TEST_CASE("kang_cho: a single spring keeps momentum, but a cloth does not", "[solver]") {
  SimulationInput pair = two_masses(0.3, 1.7, 250, 0.8, 1.1, 0.02);
  CHECK(momentum_gained(pair) <= 1e-15 * momentum_exchanged(pair));
  // Σ m Δv = Σ_j (1 - G² 1)_j p_j, and G² 1 differs between vertices unless κ ≪ m. So a free cloth gains
  // momentum without a force, of second order in κ / m.
  const auto share = [](double h) {
    const SimulationInput input = crumpled_sheet({}, h);
    return momentum_gained(input) / momentum_exchanged(input);
  };
  CHECK(share(1e-2) > 1e-3);
  CHECK_THAT(order_of(share, 2e-4), WithinAbs(4, 0.1));
}

TEST_CASE("kang_cho: a sheet falls freely across its springs, and a sheet at rest stays at rest",
          "[solver]") {
  const RestMesh rest(grid(1, 1, 8, 8));
  SimulationInput input = spring_sheet(rest, make_pins(rest, {}, 0), "crossover", 1.0 / 60);
  input.settings.substeps = 3;
  const auto simulation = falling<double>(input);
  const int steps = 60;
  for (int s = 0; s < steps; ++s) REQUIRE(simulation->step());
  const double h = input.settings.dt / 3, n = 3.0 * steps, fall = gravity * h * h * n * (n + 1) / 2;
  CHECK((simulation->positions().col(2).array() + fall).abs().maxCoeff() < 1e-9 * fall);  // 180 roundings
  CHECK((simulation->positions() - rest.positions()).leftCols<2>().cwiseAbs().maxCoeff() < 1e-12);

  const auto still = make_simulation<double>(input, {});
  for (int s = 0; s < steps; ++s) REQUIRE(still->step());
  // The rounding of rest lengths causes forces of ε k L, over a second.
  CHECK((still->positions() - rest.positions()).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("kang_cho: a hanging chain agrees with statics for any step", "[solver]") {
  // Spring i carries the weight below it, so its extension is α m g (n - i). The weight is part of p, so the
  // equilibrium is a fixed point of the step.
  const int n = 5;
  const double alpha = 1e-2, m = 0.1;
  SimulationInput input{.method = Pbd{}};
  input.positions = Positions::Zero(n + 1, 3);
  input.origin.setZero();
  for (int v = 0; v <= n; ++v) {
    input.mass.push_back(m);
    input.is_pinned.push_back(v == 0);
    if (v == 0) continue;
    input.edges.vertices.push_back({v - 1, v});
    input.edges.rest_length.push_back(1);
    input.positions(v, 2) = input.positions(v - 1, 2) - 1 - alpha * m * gravity * (n + 1 - v);
  }
  for (const double h : {1e-3, 1.0 / 60, 1.0}) {
    const auto simulation = falling<double>(with_springs(input, h, alpha, 1));
    for (int s = 0; s < 100; ++s) REQUIRE(simulation->step());
    // Rounding of lengths of 5 m, times k h per step, over 100 steps.
    CHECK((simulation->positions() - input.positions).cwiseAbs().maxCoeff() < 1e-11);
  }
}

TEST_CASE("kang_cho: pinned vertices do not move and hold the sheet", "[solver]") {
  const RestMesh rest(grid(1, 1, 12, 12));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::upper_right), 1);
  const SimulationInput input = spring_sheet(rest, pins, "adaptive", 1e-3);
  const auto simulation = falling<double>(input);
  for (int s = 0; s < 1000; ++s) REQUIRE(simulation->step());
  for (const int v : pins.all) CHECK(simulation->positions().row(v) == rest.positions().row(v));
  CHECK(simulation->positions().col(2).minCoeff() < -0.3);
  CHECK(simulation->positions().col(2).minCoeff() > -3);  // a second of free fall would be 4.9 m
}

TEMPLATE_TEST_CASE("kang_cho: threads, repetition, numbering and settings of pbd change no bit", "[solver]",
                   float, double) {
  SimulationInput input =
      hanging_sheet(64, 1e-3, 1e-2, Tangent::taut);  // enough rows to be split among threads
  const auto after = [](const SimulationInput& now) {
    const auto simulation = falling<TestType>(now);
    for (int s = 0; s < 50; ++s) REQUIRE(simulation->step());
    return simulation->positions();
  };
  const Positions once = after(input);
  CHECK(once.col(2).minCoeff() < -0.01);
  CHECK(after(input) == once);
  for (const int threads : {2, 3}) {
    input.settings.threads = threads;
    CHECK(after(input) == once);
  }
  input.settings.iterations = 3;
  CHECK(after(input) == once);
  for (int v = 0; v < input.positions.rows(); ++v)
    input.permutation.push_back(static_cast<int>(input.positions.rows()) - 1 - v);
  CHECK(after(input) == once);
}

TEST_CASE("kang_cho: a stiff spring is stable at steps where explicit Euler diverges", "[solver]") {
  // Along a spring with the reduced mass μ = m / 2, symplectic Euler is stable up to h² k / μ = 4. Here it is
  // 800.
  const double m = 1, k = 4e4, h = 0.1;
  const SimulationInput input = two_masses(m, m, k, 1, 1.1, h);
  const auto simulation = make_simulation<double>(input, {});
  double length = 1.1, rate = 0;
  for (int s = 0; s < 100; ++s) {
    REQUIRE(simulation->step());
    rate -= h * 2 * k / m * (length - 1), length += h * rate;
    const Positions end = simulation->positions();
    CHECK(std::abs((end.row(1) - end.row(0)).norm() - 1) <= 0.1);
  }
  CHECK(std::abs(length) > 1e100);
}

TEST_CASE("kang_cho: with the tangent `along`, motion across a taut spring has the limit of explicit steps",
          "[solver]") {
  // A taut string of one mass between two pins is plucked sideways. Each half has the tension T and the
  // length l. The tangent `along` leaves the stiffness 2 T / l to explicit integration, which is stable for
  // h² 2 T / l < 4 m.
  const double m = 1, k = 100, rest = 0.5, l = 1, tension = k * (l - rest),
               critical = std::sqrt(4 * m * l / (2 * tension));
  SimulationInput input{.method = Pbd{}};
  input.positions = Positions::Zero(3, 3);
  input.positions.col(0) << -l, 0, l;
  const double pluck = 1e-6;
  input.positions(1, 2) = pluck;
  input.origin.setZero();
  input.mass = {m, m, m};
  input.is_pinned = {1, 0, 1};
  input.edges = {.vertices = {{0, 1}, {1, 2}}, .rest_length = {rest, rest}};
  const auto largest = [&](double h, Tangent tangent) {
    SimulationInput now = with_springs(input, h, 1 / k, 1);
    now.method = KangCho{.tangent = tangent};
    const auto simulation = make_simulation<double>(now, {});
    double size = 0;
    for (int s = 0; s < 200; ++s) {
      REQUIRE(simulation->step());
      size = std::max(size, simulation->positions().row(1).norm());
    }
    return size;
  };
  CHECK(largest(0.95 * critical, Tangent::along) < 10 * pluck);
  CHECK(largest(1.05 * critical, Tangent::along) > 1000 * pluck);
  for (const Tangent tangent : {Tangent::taut, Tangent::isotropic})
    for (const double steps : {1.05, 10.0, 1000.0}) CHECK(largest(steps * critical, tangent) <= pluck);
}

TEST_CASE("kang_cho: the steps for which a hanging sheet is stable", "[solver]") {
  const double frame = 1.0 / 60;
  CHECK_FALSE(stays_bounded(hanging_sheet(12, frame, 1e-3, Tangent::along)));
  CHECK(stays_bounded(hanging_sheet(12, frame / 16, 1e-3, Tangent::along)));
  for (const double compliance : {1e-2, 1e-3, 1e-5})
    for (const Tangent tangent : {Tangent::taut, Tangent::isotropic})
      CHECK(stays_bounded(hanging_sheet(12, frame, compliance, tangent)));
}

TEST_CASE("kang_cho: the plan holds the passes of the method and of the listed effects", "[solver]") {
  const RestMesh rest(grid(1, 1, 4, 4));
  const SimulationInput input = spring_sheet(rest, make_pins(rest, {0}, 0), "crossover", 1e-3);
  const auto names = [](const Simulation& simulation) {
    std::vector<std::string> all;
    for (const PassStatistics& pass : simulation.passes()) all.push_back(pass.name);
    return all;
  };
  CHECK(names(*make_simulation<float>(input, {})) ==
        std::vector<std::string>{"springs", "implicit solve", "update"});
  std::vector<Pass<float>> passes = test::effect_passes<float>("gravity");
  for (Pass<float>& pass : test::effect_passes<float>("rigid_damping")) passes.push_back(std::move(pass));
  const auto simulation = make_simulation<float>(input, std::move(passes));
  CHECK(names(*simulation) == std::vector<std::string>{"start", "gravity", "external", "rigid_damping",
                                                       "springs", "implicit solve", "update"});
  REQUIRE(simulation->step());
  // By hand: 4 × 4 squares have 2·4·5 + 16 = 56 edges, and 56 - 16 edges are inside.
  CHECK(simulation->projections() == 56 + 40);
}

TEST_CASE("kang_cho: rigid damping does not slow down a fall", "[solver]") {
  const RestMesh rest(grid(1, 1, 6, 6));
  const SimulationInput input = spring_sheet(rest, make_pins(rest, {}, 0), "crossover", 1e-2);
  std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
  for (Pass<double>& pass : test::effect_passes<double>("rigid_damping", "rate", 50.0))
    passes.push_back(std::move(pass));
  const auto damped = make_simulation<double>(input, std::move(passes));
  for (int s = 0; s < 10; ++s) REQUIRE(damped->step());
  CHECK((damped->velocities().col(2).array() + 0.1 * gravity).abs().maxCoeff() < 1e-12);
}

TEST_CASE("kang_cho: settings that the method does not support are refused", "[solver]") {
  const RestMesh rest(grid(1, 1, 3, 3));
  const Pins pins = make_pins(rest, {0}, 0);
  CHECK_THROWS_AS(make_simulation<float>(spring_sheet(rest, pins, "dihedral", 1e-3), {}),
                  std::invalid_argument);
  SimulationInput input = spring_sheet(rest, pins, "crossover", 1e-3);
  CHECK_NOTHROW(make_simulation<float>(input, {}));
  input.strain_stiffness.compliance = 0;
  CHECK_THROWS_AS(make_simulation<float>(input, {}), std::invalid_argument);
  input.strain_stiffness.compliance = 1;
  input.bending_stiffness.kind = StiffnessKind::k;
  CHECK_THROWS_AS(make_simulation<float>(input, {}), std::invalid_argument);
}

TEST_CASE("kang_cho: edge springs are the edges of the mesh with at least one free end", "[constraints]") {
  const RestMesh rest(grid(2, 1, 2, 1));  // 6 vertices; 2·2 + 3 sides and 2 diagonals
  CHECK(edge_springs(rest, make_pins(rest, {}, 0)).size() == 9);
  const DistanceConstraints list = edge_springs(rest, make_pins(rest, {0, 1}, 0));
  CHECK(list.size() == 8);
  for (std::size_t c = 0; c < list.size(); ++c) {
    const auto [a, b] = list.vertices[c];
    CHECK_FALSE((a == 0 && b == 1));
    const double length = (rest.positions().row(a) - rest.positions().row(b)).norm();
    CHECK_THAT(list.rest(c), WithinRel(length, 1e-15));
    CHECK((std::abs(length - 1) < 1e-12 || std::abs(length - std::sqrt(2.0)) < 1e-12));
  }
}

TEST_CASE("kang_cho: every spring is in the rows of both its ends", "[solver]") {
  // Vertex 20 is in the second slice; vertex 3 needs no row.
  const std::vector<Spring> springs = {{0, 20, 1, 10}, {3, 0, 2, 20}, {0, 1, 3, 30}};
  std::vector<char> needs_row(21, 1);
  needs_row[3] = 0;
  const SpringRows<double> rows = make_spring_rows<double>(springs, needs_row);
  REQUIRE(rows.slice_count() == 2);
  CHECK(rows.slices == std::vector<std::size_t>{0, 48, 64});  // 3 and 1 rows of 16 lanes
  const auto row = [&](std::size_t vertex) {
    std::vector<double> stiffness;
    for (std::size_t lane = rows.slices[vertex / 16] + vertex % 16; lane < rows.slices[vertex / 16 + 1];
         lane += 16)
      if (rows.stiffness[lane] != 0)
        stiffness.push_back(rows.stiffness[lane]);
      else
        CHECK(rows.other[lane] == offset_of(static_cast<int>(vertex)));
    return stiffness;
  };
  CHECK(row(0) == std::vector<double>{10, 20, 30});
  CHECK(row(1) == std::vector<double>{30});
  CHECK(row(3).empty());
  CHECK(row(20) == std::vector<double>{10});
  CHECK(rows.other[0] == offset_of(20));
  CHECK(rows.rest_length[16] == 2);
}

}  // namespace bendlab::kang_cho_test
