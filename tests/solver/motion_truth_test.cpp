// Motions with implicit steps agree with closed forms: frequencies, decay, waves and momentum. Further cases
// are steps far too long for the motion, loads far too heavy for projections, and equal bits of parallel
// simulations.
#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <thread>

#include "tests/catch.hpp"
#include "tests/solver/implicit_scenes.hpp"

namespace bendlab::motion_truth_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Complex = std::complex<double>;
using test::compliant, test::implicit_steps;

const std::vector<std::string_view> converging_methods = {"newton", "quasi_newton"};

struct Order {
  std::string_view integrator;
  double order;
};
const std::vector<Order> integrators = {{"euler", 1}, {"bdf2", 2}};

std::vector<Pass<double>> gravity(const Vector3& g) {
  return test::effect_passes<double>("gravity", "acceleration", std::vector<double>{g.x(), g.y(), g.z()});
}

// The r of q_n = Re(A rⁿ), which solves q_n+2 = 2 Re(r) q_n+1 - |r|² q_n. It comes from least squares without
// the first quarter of the values, in which faster modes and the other root of BDF2 fade away.
Complex factor_per_step(const std::vector<double>& q) {
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t n = q.size() / 4; n + 2 < q.size(); ++n) {
    const Eigen::Vector2d row(q[n + 1], q[n]);
    squares += row * row.transpose(), right += q[n + 2] * row;
  }
  const Eigen::Vector2d solution = squares.ldlt().solve(right);
  return {solution(0) / 2, std::sqrt(-solution(1) - solution(0) * solution(0) / 4)};
}

// A mode of a cloth: its start, its forces, and the frequency of its closed form.
struct Mode {
  SimulationInput input{.method = Pbd{}};
  std::function<std::vector<Pass<double>>()> forces;
  std::vector<double> shape;  // #V displacements along the axis
  Eigen::Index axis;
  double omega;  // 1/s

  double amplitude(const Positions& x) const {
    double sum = 0;
    for (std::size_t v = 0; v < shape.size(); ++v) {
      const auto row = static_cast<Eigen::Index>(v);
      sum += input.mass[v] * shape[v] * (x(row, axis) - input.rest(row, axis));
    }
    return sum;
  }
};

// The λ of exp(λ t) for steps of h. Exact steps would give iω.
Complex rate(const Mode& mode, std::string_view method, std::string_view integrator, double h) {
  const auto simulation = implicit_steps(mode.input, method, integrator, h, mode.forces(), 400);
  std::vector<double> q;
  for (double time = 0; time < 4 * std::numbers::pi / mode.omega; time += h) {
    REQUIRE(simulation->step());
    q.push_back(mode.amplitude(simulation->positions()));
  }
  return std::log(factor_per_step(q)) / h;
}

// Checks the order, from three step sizes, and their limit for h → 0.
void check_rate(const Mode& mode) {
  for (const std::string_view method : converging_methods)
    for (const auto& [integrator, order] : integrators) {
      const double h = 2 * std::numbers::pi / mode.omega / 20;
      const Complex coarse = rate(mode, method, integrator, h),
                    middle = rate(mode, method, integrator, h / 2),
                    fine = rate(mode, method, integrator, h / 4);
      const double observed = std::log2(std::abs(coarse - middle) / std::abs(middle - fine));
      const Complex limit = fine + (fine - middle) / (std::pow(2, order) - 1);
      INFO(method << ", " << integrator << ": ω " << limit << " by " << coarse << ", " << middle << ", "
                  << fine << "; exact " << mode.omega << "; order " << observed);
      CHECK_THAT(observed, WithinAbs(order, 0.15));  // ωh ≤ 0.3, so the next order is a tenth of it
      CHECK_THAT(limit.imag(), WithinRel(mode.omega, 0.01));
      CHECK_THAT(limit.real(), WithinAbs(0, 0.01 * mode.omega));
    }
}

// How far the free side of a strip sinks in the static equilibrium under a small load, m. The strip is
// clamped at x = 0.
double static_deflection(SimulationInput input, double acceleration) {
  input.method = Equilibrium{};
  const auto simulation = make_simulation<double>(input, gravity({0, 0, -acceleration}));
  for (int step = 0; step < 400 && !simulation->settled(); ++step) REQUIRE(simulation->step());
  return -simulation->positions().col(2).minCoeff();
}

// u after `steps` steps of u' = λ u from u = 1. The first step is backward Euler, all later steps are the
// integrator's.
Complex exact_steps(std::string_view integrator, Complex lambda, double h, int steps) {
  Complex before = 1, now = 1.0 / (1.0 - lambda * h);
  for (int n = 1; n < steps; ++n) {
    const Complex next =
        integrator == "euler" ? now / (1.0 - lambda * h) : (2.0 * now - 0.5 * before) / (1.5 - lambda * h);
    before = now, now = next;
  }
  return now;
}

// A point of mass m on a spring along x, 0.1 m beyond the rest length. The other end of the spring is pinned.
SimulationInput point_on_spring(double mass, double stiffness) {
  SimulationInput input{.method = Pbd{}};
  input.positions = Positions::Zero(2, 3);
  input.positions(1, 0) = 1.1;
  input.rest = Positions::Zero(2, 3);
  input.rest(1, 0) = 1;
  input.origin = Vector3::Zero();
  input.mass = {1, mass};
  input.is_pinned = {1, 0};
  input.distance.vertices = {{0, 1}};
  input.distance.rest_length = {1};
  return compliant(std::move(input), "newton", 1, 1 / stiffness);
}

SimulationInput spinning_sheet(const RestMesh& rest, double compliance) {
  SimulationInput input =
      compliant(test::sheet(rest, make_pins(rest, {}, 0), "discrete_shells"), "newton", compliance, 1e3);
  test::disturb(input, 0.005);
  input.velocities = Positions::Zero(rest.vertex_count(), 3);
  for (Eigen::Index v = 0; v < input.velocities.rows(); ++v)
    input.velocities.row(v) = Vector3(1, 2, 3).cross(input.positions.row(v).transpose()).transpose();
  return input;
}

// Σ m x × v
Vector3 angular_momentum(const std::vector<double>& mass, const Positions& x, const Positions& v) {
  Vector3 sum = Vector3::Zero();
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    sum += mass[static_cast<std::size_t>(i)] * Vector3(x.row(i)).cross(Vector3(v.row(i)));
  return sum;
}

double largest_difference(const Positions& a, const Positions& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

double largest_stretch(const RestMesh& rest, const Positions& x) {
  double largest = 0;
  for (const auto& edge : rest.edges().rowwise())
    largest = std::max(largest, (x.row(edge(0)) - x.row(edge(1))).norm() /
                                    (rest.position(edge(0)) - rest.position(edge(1))).norm());
  return largest;
}

}  // namespace

// f = (1.8751² / 2π) √(B / ρL⁴) for Euler and Bernoulli's beam. B comes from the static deflection ρ g L⁴ /
// 8B of the end of the same mesh under a small load.
TEST_CASE("a clamped strip vibrates at the first frequency of a beam", "[solver]") {
  constexpr double length = 0.4, cell = 0.01, density = 0.2, g = 1e-3;
  const RestMesh rest(grid(length + cell, 2 * cell, 41, 2, Diagonal::alternating));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 1);
  Mode mode;
  mode.input = compliant(test::sheet(rest, pins, "discrete_shells", density), "newton", 0.1, 1e3);
  const double start = rest.box_min().x() + cell;
  const double rigidity = density * g * std::pow(length, 4) / (8 * static_deflection(mode.input, g));
  mode.omega = 1.8751 * 1.8751 * std::sqrt(rigidity / (density * std::pow(length, 4)));
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const double s = 1.8751 / length * std::max(0.0, rest.position(v).x() - start);
    mode.shape.push_back(std::cosh(s) - std::cos(s) - 0.7341 * (std::sinh(s) - std::sin(s)));
    mode.input.positions(v, 2) += 1e-4 * mode.shape.back();  // the end is 0.2 mm off and turns by 0.001
  }
  mode.axis = 2;
  mode.forces = [] { return std::vector<Pass<double>>(); };
  check_rate(mode);
}

// ω = 2.4048 / 2 √(g / L) with the mode J₀(2.4048 √(s / L)), where s is measured from the lower end
// (Bernoulli 1732).
TEST_CASE("a hanging strip swings like a chain", "[solver]") {
  constexpr double length = 1, density = 0.2, g = 9.81, stiffness = 1e3;
  const RestMesh rest(grid(0.05, length, 1, 40));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::top), 0);
  Mode mode;
  mode.input = compliant(test::sheet(rest, pins, "none", density), "newton", 1 / stiffness, 1);
  mode.omega = 2.4048 / 2 * std::sqrt(g / length);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    const double s = rest.position(v).y() - rest.box_min().y();
    mode.shape.push_back(std::cyl_bessel_j(0, 2.4048 * std::sqrt(s / length)));
    mode.input.positions(v, 1) -=
        density * g / (2 * stiffness) * (length * length - s * s);  // stretch by its own weight
    mode.input.positions(v, 2) += 1e-4 * mode.shape.back();
  }
  mode.axis = 2;
  mode.forces = [] { return gravity({0, -g, 0}); };
  check_rate(mode);
}

// T = 4 L √(ρ / Y). The energy is ½ Y (warp strain² + weft strain² + shear²) without Poisson's ratio, so Y is
// 1 / compliance.
TEST_CASE("a wave runs along a strip that is released from a uniform stretch", "[solver]") {
  constexpr double length = 1, density = 0.2, stiffness = 50;
  const RestMesh rest(grid(length, 0.04, 50, 2));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 0);
  Mode mode;
  mode.input = compliant(test::sheet(rest, pins, "none", density), "newton", 1 / stiffness, 1);
  mode.omega = 2 * std::numbers::pi / (4 * length * std::sqrt(density / stiffness));
  const Eigen::VectorXd at = rest.positions().col(0).array() - rest.box_min().x();
  mode.input.positions.col(0) += 0.01 * at;
  mode.axis = 0;
  for (const double x : at) mode.shape.push_back(std::sin(std::numbers::pi * x / (2 * length)));
  mode.forces = [] { return std::vector<Pass<double>>(); };
  check_rate(mode);
}

// Let λ₁ and λ₂ be the roots of λ² + c λ / m + ω² = 0, with x(0) = 1 and x'(0) = 0. Then x is
// (λ₂ u₁ - λ₁ u₂) / (λ₂ - λ₁) in every step, where u' = λ u. Without drag each step multiplies the amplitude
// by |1 / (1 - iωh)| (backward Euler), or by the larger root of (3/2 - iωh) r² - 2 r + 1/2 (BDF2).
TEST_CASE("an oscillator decays by the factor of its integrator in each step", "[solver]") {
  constexpr double mass = 0.01, stiffness = 4;
  for (const std::string_view method : {"newton", "quasi_newton", "vbd"})
    for (const auto& [integrator, order] : integrators)
      for (const double drag : {0.0, 0.1})           // kg/s; 0.4 would be critical
        for (const double h : {0.002, 0.02, 0.2}) {  // ωh = 0.04, 0.4, 4
          std::vector<Pass<double>> passes;
          if (drag > 0) passes.push_back({"drag", Stage::damp, [](auto&) {}, nullptr, {0, drag}});
          const auto simulation = implicit_steps(point_on_spring(mass, stiffness), method, integrator, h,
                                                 std::move(passes), 200, 0);
          const Complex root = std::sqrt(Complex(drag * drag / (4 * mass * mass) - stiffness / mass)),
                        first = -drag / (2 * mass) + root, second = -drag / (2 * mass) - root;
          for (int step = 1; step <= 40; ++step) {
            REQUIRE(simulation->step());
            const Complex exact = (second * exact_steps(integrator, first, h, step) -
                                   first * exact_steps(integrator, second, h, step)) /
                                  (second - first);
            INFO(method << ", " << integrator << ", drag " << drag << ", h " << h << ", step " << step);
            // The amplitude is 0.1 m. Forces have a rounding of 1e-15 of 4 N/m × 1 m.
            CHECK_THAT(simulation->positions()(1, 0), WithinAbs(1 + 0.1 * exact.real(), 1e-12));
          }
        }
}

// Internal forces at x_n+1 have no torque about any point, so Σ m x_n+1 × (v_n+1 - V) = 0 with the V of
// implicit_step.hpp. Only the integrator changes the angular momentum in a converged step.
TEST_CASE("internal forces of a converged step have no torque", "[solver]") {
  const RestMesh rest(delaunay(0.5, 0.5, 5, 3));
  const SimulationInput input = spinning_sheet(rest, 1e-3);
  for (const std::string_view method : converging_methods)
    for (const auto& [integrator, order] : integrators) {
      const auto simulation = implicit_steps(input, method, integrator, 1.0 / 60, {}, 1000, 0);
      Positions earlier = input.velocities, before = input.velocities;
      for (int step = 0; step < 4; ++step) {
        REQUIRE(simulation->step());
        const Positions x = simulation->positions(), v = simulation->velocities();
        const double share = integrator == "bdf2" && step > 0 ? 1.0 / 3 : 0;
        const Vector3 now = angular_momentum(input.mass, x, v);
        INFO(method << ", " << integrator << ", step " << step);
        // Forces of 1e3 N/m × 0.5 m have a rounding of 1e-16. With steps of 1/60 s and sides of 0.5 m this
        // gives 1e-15.
        CHECK((now - angular_momentum(input.mass, x, before + share * (before - earlier))).norm() <=
              1e-11 * now.norm());
        earlier = before, before = v;
      }
    }
}

// To first order in h, backward Euler loses h |Σ m a × v| per second. The loss of BDF2 is of second order or
// higher. The sheet is so soft that steps resolve its slow modes (ω = π √(Y / ρ) / 0.5 m = 44 / s), and
// starts in such a mode.
TEST_CASE("the loss of angular momentum of a spinning sheet has the order of the integrator", "[solver]") {
  const RestMesh rest(delaunay(0.5, 0.5, 5, 3));
  SimulationInput input = spinning_sheet(rest, 0.1);
  input.positions = 1.1 * rest.positions();
  const auto lost = [](const SimulationInput& sheet, std::string_view method, std::string_view integrator,
                       double h) {
    const Vector3 start = angular_momentum(sheet.mass, sheet.positions, sheet.velocities);
    const auto simulation = implicit_steps(sheet, method, integrator, h, {}, 300, 1e-11);
    for (int step = 0; step < std::lround(1 / h); ++step) REQUIRE(simulation->step());
    const Vector3 end = angular_momentum(sheet.mass, simulation->positions(), simulation->velocities());
    return (end - start).norm() / start.norm();
  };
  std::string losses;
  for (const std::string_view method : converging_methods)
    for (const auto& [integrator, order] : integrators) {
      const double coarse = lost(input, method, integrator, 1.0 / 240),
                   fine = lost(input, method, integrator, 1.0 / 480),
                   crumpled = lost(spinning_sheet(rest, 1e-3), method, integrator, 1.0 / 60);
      INFO(method << ", " << integrator << ": " << coarse << ", " << fine);
      CHECK(std::log2(coarse / fine) >= order - 0.2);  // ωh = 0.2, so the next order is a tenth of it
      losses += fmt::format("{}, {}: {:.1e}, {:.1e}, {:.1e}; ", method, integrator, coarse, fine, crumpled);
    }
  WARN(
      "share of the angular momentum lost in 1 s: a soft sheet with steps of 1/240 s and of 1/480 s, and a "
      "stiff sheet that starts crumpled with steps of 1/60 s: "
      << losses);
}

// With springs the sheet has several equilibria. So the equilibrium is computed from the final pose, and must
// be this pose. With a force that jumps (choi_ko), Newton's method finds no equilibrium.
TEST_CASE("steps of 0.1 s and 1 s come to rest at an equilibrium", "[solver][slow]") {
  const RestMesh rest(equilateral(0.4, 0.4, 5, Rows::parallel));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 0);
  const auto forces = [&] {
    std::vector<Pass<double>> passes = gravity({0, 0, -9.81});
    for (auto& pass : test::effect_passes<double>("viscous_drag", rest, pins, "coefficient", 1.0))
      passes.push_back(std::move(pass));
    return passes;
  };
  std::vector<test::SmoothModel> models = test::smooth_models;
  models.push_back({"choi_ko", 1e3});
  for (const test::SmoothModel& model : models)
    for (const std::string_view method : converging_methods)
      for (const double h : {0.1, 1.0})
        for (const auto& [integrator, order] : integrators) {
          if (model.name == "choi_ko" && method == "quasi_newton") continue;  // the method refuses this model
          // Directors need many iterations, so that one combination has to be enough.
          if (model.name == "mid_edge" && method == "quasi_newton" && (h > 0.5 || order > 1)) continue;
          INFO(model.name << ", " << method << ", " << integrator << ", h " << h);
          SimulationInput input =
              compliant(test::sheet(rest, pins, model.name), method, 1e-3, model.compliance);
          const auto simulation = implicit_steps(input, method, integrator, h, forces(),
                                                 method == "newton"         ? 20
                                                 : model.name == "mid_edge" ? 800
                                                                            : 100);
          double largest = 0;
          for (int step = 0; step < 60; ++step) {
            REQUIRE(simulation->step());
            largest = std::max(largest, largest_stretch(rest, simulation->positions()));
          }
          // The weight causes a strain of 1e-3, an iteration up to 0.05. A free fall of 1 s would be 10 m.
          CHECK(largest <= 1.1);
          if (model.name == "choi_ko") continue;
          input.positions = simulation->positions();
          input.method = Equilibrium{};
          input.starting_from = StartingFrom::same_mesh;
          const auto equilibrium = make_simulation<double>(input, gravity({0, 0, -9.81}));
          for (int step = 0; step < 400 && !equilibrium->settled(); ++step) REQUIRE(equilibrium->step());
          CHECK(largest_difference(input.positions, equilibrium->positions()) <= 1e-5);
        }
}

// Only forces within the sheet act, so its centre of mass stays, and its edges return to their lengths.
TEST_CASE("a sheet with random positions at the start opens, and drifts only by rounding", "[solver]") {
  const RestMesh rest(grid(1, 1, 8, 8));
  SimulationInput input = compliant(test::sheet(rest, make_pins(rest, {}, 0), "none"), "newton", 1e-4, 1);
  std::mt19937_64 random(5);
  for (Eigen::Index v = 0; v < rest.vertex_count(); ++v)
    input.positions.row(v) = test::random_vector(random, 0.5).transpose();
  input.positions.row(1) = input.positions.row(0);  // a triangle without an edge
  const auto middle = [&](const Positions& x) -> Vector3 {
    Vector3 sum = Vector3::Zero();
    for (Eigen::Index v = 0; v < x.rows(); ++v)
      sum += input.mass[static_cast<std::size_t>(v)] * x.row(v).transpose();
    return sum / std::accumulate(input.mass.begin(), input.mass.end(), 0.0);
  };
  for (const std::string_view method : converging_methods) {
    const auto simulation = implicit_steps(input, method, "euler", 1.0 / 60, {}, 20);
    for (int step = 0; step < 300; ++step) REQUIRE(simulation->step());
    INFO(method);
    CHECK((middle(simulation->positions()) - middle(input.positions)).norm() <= 1e-12);  // 300 roundings
    if (method == "newton") CHECK(largest_stretch(rest, simulation->positions()) <= 1.01);
  }
}

// The upper half of a strip holds a lower half that is 10⁶ times as heavy. Row j carries the weight below it,
// and its strain is this weight over Y w.
TEST_CASE("cloth carries a million times its weight", "[solver]") {
  constexpr double width = 0.1, density = 0.2, stiffness = 1e8, g = 9.81;
  const RestMesh rest(grid(width, 1, 2, 16));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::top), 0);
  SimulationInput input = compliant(test::sheet(rest, pins, "none", density), "newton", 1 / stiffness, 1);
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (rest.position(v).y() < -1e-6) input.mass[static_cast<std::size_t>(v)] *= 1e6;
  double length = 0, below = 0;
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 3; ++column)
      below += input.mass[static_cast<std::size_t>(3 * row + column)];
    length += (1 + below * g / (stiffness * width)) / 16;
  }
  const auto check = [&]<class Real>(std::string_view method, std::string_view integrator, Real,
                                     double error) {
    auto passes = test::effect_passes<Real>("gravity", "acceleration", std::vector<double>{0, -g, 0});
    const auto simulation = implicit_steps<Real>(input, method, integrator, 1.0 / 60, std::move(passes), 20);
    for (int step = 0; step < 300; ++step) REQUIRE(simulation->step());
    const Positions x = simulation->positions();
    INFO(method << ", " << integrator << ", " << sizeof(Real) << " bytes");
    // The error is relative to the stretch by the weight. The two sides differ because of their triangles, by
    // an error of second order in the size of a cell.
    CHECK_THAT((x(48, 1) + x(50, 1) - x(0, 1) - x(2, 1)) / 2 - 1, WithinRel(length - 1, error));
  };
  for (const auto& [integrator, order] : integrators) {
    check("newton", integrator, 0.0, 1e-3);
    check("quasi_newton", integrator, 0.0, 1e-3);
    check("quasi_newton", integrator, 0.0F, 1e-3);
  }
}

// If the ordering of the matrix used random numbers that the whole process shares, parallel simulations would
// differ.
TEST_CASE("implicit steps give the same bits in parallel simulations and with any number of threads",
          "[solver]") {
  struct Cloth {
    std::string_view method;
    int cells;
    int steps;
  };
  // Meshes are so fine that the passes of quasi_newton are split among threads (above 16384 vertices). For
  // newton, CHOLMOD looks for a better order than AMD's (above 500 operations per number of the factor).
  for (const auto& [method, cells, steps] : {Cloth{"quasi_newton", 130, 4}, Cloth{"newton", 112, 1}}) {
    const RestMesh rest(grid(1, 1, cells, cells));
    const Pins pins = make_pins(rest, select_vertices(rest, Place::top), 0);
    const SimulationInput input = compliant(test::sheet(rest, pins, "dihedral"), method, 1e-3, 1e4);
    const auto end = [&, steps = steps, method = method](int threads) {
      SimulationInput own = input;
      own.settings.threads = threads;
      const auto simulation =
          implicit_steps(own, method, "bdf2", 1.0 / 60, gravity({0, 0, -9.81}), method == "newton" ? 1 : 4);
      for (int step = 0; step < steps; ++step) simulation->step();
      return simulation->positions();
    };
    const Positions alone = end(1);
    std::array<Positions, 3> results;
    {
      std::vector<std::jthread> threads;
      for (std::size_t i = 0; i < results.size(); ++i)
        threads.emplace_back([&, i] { results[i] = end(i == 0 ? 2 : 1); });
    }
    for (const Positions& result : results) {
      INFO(method << " differs by up to " << (result - alone).cwiseAbs().maxCoeff() << " m");
      CHECK((result.array() == alone.array()).all());
    }
  }
}

}  // namespace bendlab::motion_truth_test
