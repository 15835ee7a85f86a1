// Implicit steps: all methods find the minimum of a step, and motions agree with closed forms.
#include <numbers>

#include "bendlab/constraints/kernels.hpp"
#include "bendlab/settings/names.hpp"
#include "bendlab/solver/elastic_system.hpp"
#include "bendlab/solver/implicit_step.hpp"
#include "bendlab/solver/ordered_constraints.hpp"
#include "bendlab/solver/sparse_factor.hpp"
#include "tests/catch.hpp"
#include "tests/solver/implicit_scenes.hpp"

namespace bendlab::implicit_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using test::compliant, test::disturb, test::SmoothModel, test::smooth_models;

const std::vector<std::string_view> implicit_methods = {"newton", "quasi_newton", "vbd"};

template <class Real>
std::vector<Pass<Real>> gravity() {
  return test::effect_passes<Real>("gravity", "acceleration", std::vector<double>{0, 0, -9.81});
}

// After one step of 1/60 s.
template <class Real>
std::unique_ptr<Simulation> stepped(SimulationInput input, std::string_view method, int iterations) {
  input.settings.iterations = iterations;
  test::Changes changes;
  if (method != "pbd") changes = {{"integrator", std::string("euler")}, {"tolerance", 0.0}};
  if (method == "quasi_newton")
    changes.insert(changes.end(), {{"membrane", std::string("stated")}, {"history", std::int64_t{10}}});
  input.method = test::chosen(*find_method(method), changes);
  auto simulation = make_simulation<Real>(input, gravity<Real>());
  REQUIRE(simulation->step());
  return simulation;
}

template <class Real>
Positions after_a_step(SimulationInput input, std::string_view method, int iterations) {
  return stepped<Real>(std::move(input), method, iterations)->positions();
}

double largest_difference(const Positions& a, const Positions& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

// Simulates steps of h until `duration`. `iterations` becomes the setting of the method.
std::unique_ptr<Simulation> moved(SimulationInput input, std::string_view method, std::string_view integrator,
                                  double h, double duration, std::vector<Pass<double>> passes,
                                  int iterations = 50) {
  auto simulation =
      test::implicit_steps(std::move(input), method, integrator, h, std::move(passes), iterations);
  for (int step = 0; step < static_cast<int>(std::lround(duration / h)); ++step) REQUIRE(simulation->step());
  return simulation;
}

// Keeps vertices above the plane z = 0, and counts its calls.
std::vector<Pass<double>> plane(int& calls) {
  std::vector<Pass<double>> passes(1);
  passes[0].name = "plane", passes[0].stage = Stage::project;
  passes[0].run = [&calls](PassContext<double>& c) {
    ++calls;
    for (std::size_t v = 0; v < static_cast<std::size_t>(c.state.vertex_count); ++v)
      c.state.position[v].z = std::max(0.0, c.state.position[v].z);
  };
  return passes;
}

// A free flat sheet at z = 0, which falls at 1 m/s.
SimulationInput falling_sheet(std::string_view method) {
  const RestMesh rest(grid(1, 1, 3, 3));
  SimulationInput input = compliant(test::sheet(rest, make_pins(rest, {}, 0), "none"), method, 1e-2, 1);
  input.velocities = Positions::Zero(rest.vertex_count(), 3);
  input.velocities.col(2).setConstant(-1);
  return input;
}

}  // namespace

TEMPLATE_TEST_CASE("the forces of the kernels are minus the gradient of the energy", "[solver]", float,
                   double) {
  const RestMesh rest(delaunay(1, 1, 4, 2));
  const Pins pins = make_pins(rest, {0}, 0);
  // Rounding of positions divided by compliances, relative to the largest force.
  const double tolerance = std::is_same_v<TestType, float> ? 2e-5 : 1e-12;
  for (const SmoothModel& model : smooth_models)
    for (const StrainForm form : {StrainForm::normalised, StrainForm::green, StrainForm::angle}) {
      SimulationInput input = compliant(test::sheet(rest, pins, model.name), "pbd", 0.3, model.compliance);
      input.strain_stiffness.form = form, input.strain_stiffness.area = 1;
      disturb(input, 0.05);
      const auto constraints = ordered_constraints<TestType>(input, nullptr);
      input.start_directors = input.directors.rest;
      if (input.directors.count() > 0) input.start_directors.col(0).setConstant(0.01);
      const Positions start = input.points();
      const std::size_t count = input.point_count();
      Points<TestType> points(count + dummy_points), forces(count + dummy_points);
      for (std::size_t v = 0; v < count; ++v)
        points[v].set(start.row(static_cast<Eigen::Index>(v)).transpose().cast<TestType>());
      constraints.for_each([&](const auto& batch) {
        add_forces(points.data(), forces.data(), batch, 0, batch.order.stack_count());
      });
      const ElasticSystem system(input);
      const Eigen::VectorXd gradient = system.gradient(start);
      INFO(model.name << ", " << strain_form_names[static_cast<std::size_t>(form)]);
      for (std::size_t v = 0; v < count; ++v)
        if (const int at = system.free_index()[v]; at >= 0)
          CHECK((forces[v].vector().template cast<double>() + gradient.segment<3>(3 * at)).norm() <=
                tolerance * gradient.cwiseAbs().maxCoeff());
    }
}

TEMPLATE_TEST_CASE("a sparse factor solves its system for points", "[solver]", float, double) {
  for (const int n : {1, 2, 7, 60, 400}) {
    // The Laplacian of a band of vertices plus a mass is positive definite.
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < n; ++i) {
      entries.emplace_back(i, i, 4.5);
      if (i + 1 < n) entries.emplace_back(i + 1, i, -1);
      if (i + 20 < n) entries.emplace_back(i + 20, i, -1);
    }
    Eigen::SparseMatrix<double> lower(n, n);
    lower.setFromTriplets(entries.begin(), entries.end());
    const SparseFactor<TestType> factor(lower);
    std::mt19937_64 random(3);
    Eigen::MatrixXd right(n, 3);
    Points<TestType> points(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const Vector3 p = test::random_vector(random);
      right.row(i) = p.transpose(), points[static_cast<std::size_t>(i)].set(p.cast<TestType>());
    }
    factor.solve(points.data());
    const Eigen::MatrixXd whole = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd solution = whole.llt().solve(right);
    const double tolerance = std::is_same_v<TestType, float> ? 2e-6 : 1e-14;
    for (int i = 0; i < n; ++i)
      CHECK(
          (points[static_cast<std::size_t>(i)].vector().template cast<double>().transpose() - solution.row(i))
              .norm() <= tolerance);
  }
  Eigen::SparseMatrix<double> indefinite(2, 2);
  indefinite.insert(0, 0) = 1, indefinite.insert(1, 1) = -1;
  CHECK_THROWS_WITH(SparseFactor<TestType>(indefinite), Catch::Matchers::Contains("positive definite"));
}

namespace {

// The start is flat and free, or disturbed and pinned at a corner.
void check_minimum_of_a_step(std::span<const SmoothModel> models) {
  const RestMesh rest(equilateral(0.3, 0.3, 4, Rows::parallel));
  for (const double disturbance : {0.0, 0.004})
    for (const SmoothModel& model : models) {
      const bool pinned = disturbance > 0;
      const Pins pins = make_pins(rest, pinned ? std::vector<int>{0} : std::vector<int>{}, 0);
      SimulationInput input =
          compliant(test::sheet(rest, pins, model.name), "newton", 1e-2, model.compliance);
      disturb(input, disturbance);
      INFO(model.name << ", pinned " << pinned << ", disturbed by " << disturbance);
      const Positions newton = after_a_step<double>(input, "newton", 100);
      CHECK(largest_difference(newton, after_a_step<double>(input, "quasi_newton", 600)) <= 1e-8);
      CHECK(largest_difference(newton, after_a_step<double>(input, "vbd", 2000)) <= 1e-8);
      // Positions in single precision have a rounding of 3e-8 m, which also affects forces.
      CHECK(largest_difference(newton, after_a_step<float>(input, "quasi_newton", 300)) <= 2e-6);
    }
}

}  // namespace

TEST_CASE("every implicit method finds the one minimum of a step with hinges", "[solver]") {
  check_minimum_of_a_step(std::vector<SmoothModel>{{"discrete_shells", 100}});
}

TEST_CASE("every implicit method finds the one minimum of a step", "[solver][slow]") {
  check_minimum_of_a_step(smooth_models);
}

TEMPLATE_TEST_CASE("the residual of a step is the imbalance of forces and inertia", "[solver]", float,
                   double) {
  const RestMesh rest(delaunay(1, 1, 5, 2));
  SimulationInput input = compliant(test::sheet(rest, make_pins(rest, {0}, 0), "dihedral"), "pbd", 1e-3, 1);
  disturb(input, 0.02);
  const ElasticSystem system(input);
  constexpr double h = 1.0 / 60;
  const Vector3 gravity(0, 0, -9.81);
  for (const std::string_view method : implicit_methods)
    for (const int iterations : {1, 4, 400}) {
      if constexpr (std::is_same_v<TestType, float>)
        if (!find_method(method)->make_float) continue;
      CAPTURE(method, iterations);
      const auto simulation = stepped<TestType>(input, method, iterations);
      const Positions end = simulation->positions();
      const Eigen::VectorXd gradient = system.gradient(end);
      double left = 0, weight = 0;
      for (Eigen::Index v = 0; v < end.rows(); ++v) {
        const auto at = system.free_index()[static_cast<std::size_t>(v)];
        if (at < 0) continue;
        const double mass = input.mass[static_cast<std::size_t>(v)];
        const Vector3 move = (end.row(v) - input.positions.row(v)).transpose();
        left += (mass * gravity - mass / (h * h) * move - gradient.segment<3>(3 * at)).norm();
        weight += mass * gravity.norm();
      }
      // In float, positions of 1 m have a rounding of 6e-8 m, and the membrane has 1000 N/m.
      CHECK_THAT(simulation->step_residual()->share(),
                 WithinAbs(left / weight, std::is_same_v<TestType, float> ? 0.05 : 1e-9));
      if (iterations == 1) CHECK(simulation->step_residual()->share() > 1);
      if (iterations == 400) CHECK(simulation->step_residual()->share() < 0.05);
    }
}

TEST_CASE("the residual of a step of BDF2 uses its own inertia and leaves out vertices in contact",
          "[solver]") {
  const RestMesh rest(delaunay(1, 1, 5, 2));
  SimulationInput input = compliant(test::sheet(rest, make_pins(rest, {0}, 0), "dihedral"), "pbd", 1e-3, 1);
  disturb(input, 0.02);
  const ElasticSystem system(input);
  constexpr double h = 1.0 / 60, gamma = 2 * h / 3;
  const Vector3 gravity_acceleration(0, 0, -9.81);
  for (const std::string_view method : implicit_methods) {
    CAPTURE(method);
    const auto simulation = test::implicit_steps(input, method, "bdf2", h, gravity<double>(), 2, 0.0);
    Positions x[3] = {input.positions, {}, {}}, v[2] = {Positions::Zero(rest.vertex_count(), 3), {}};
    REQUIRE(simulation->step());
    x[1] = simulation->positions(), v[1] = simulation->velocities();
    REQUIRE(simulation->step());
    x[2] = simulation->positions();
    const Eigen::VectorXd gradient = system.gradient(x[2]);
    double left = 0, weight = 0;
    for (Eigen::Index i = 0; i < rest.vertex_count(); ++i) {
      const auto at = system.free_index()[static_cast<std::size_t>(i)];
      if (at < 0) continue;
      const double mass = input.mass[static_cast<std::size_t>(i)];
      // x - (4 x₁ - x₀)/3 - γ (4 v₁ - v₀)/3 = γ² a
      const Vector3 move =
          (x[2].row(i) - (4 * x[1].row(i) - x[0].row(i)) / 3 - gamma * (4 * v[1].row(i) - v[0].row(i)) / 3)
              .transpose();
      left +=
          (mass * gravity_acceleration - mass / (gamma * gamma) * move - gradient.segment<3>(3 * at)).norm();
      weight += mass * gravity_acceleration.norm();
    }
    CHECK(left / weight > 1e-3);  // two iterations do not converge
    CHECK_THAT(simulation->step_residual()->share(), WithinRel(left / weight, 1e-6));

    // A sheet lies on a plane, which carries its weight.
    int calls = 0;
    std::vector<Pass<double>> passes = gravity<double>();
    for (auto& pass : plane(calls)) passes.push_back(std::move(pass));
    const auto lying = moved(falling_sheet(method), method, "bdf2", h, 6 * h, std::move(passes), 50);
    REQUIRE(lying->step_residual());
    CHECK_THAT(lying->step_residual()->share(), WithinAbs(0, 1e-9));  // a vertex may hover by rounding
    CHECK_FALSE(moved(falling_sheet(method), method, "bdf2", h, h, {}, 2)->step_residual());  // no forces
  }
}

TEST_CASE("the residual of a step without loads is relative to inertia", "[solver]") {
  const RestMesh rest(delaunay(1, 1, 5, 2));
  SimulationInput input = compliant(test::sheet(rest, make_pins(rest, {0}, 0), "dihedral"), "pbd", 1e-3, 1);
  disturb(input, 0.02);
  const ElasticSystem system(input);
  constexpr double h = 1.0 / 60;
  for (const std::string_view method : implicit_methods) {
    CAPTURE(method);
    const auto simulation = test::implicit_steps(input, method, "euler", h, {}, 2, 0.0);
    REQUIRE(simulation->step());
    const Positions end = simulation->positions();
    const Eigen::VectorXd gradient = system.gradient(end);
    double left = 0, inertia = 0;
    for (Eigen::Index v = 0; v < end.rows(); ++v) {
      const auto at = system.free_index()[static_cast<std::size_t>(v)];
      if (at < 0) continue;
      const double mass = input.mass[static_cast<std::size_t>(v)];
      const Vector3 m_a = mass / (h * h) * (end.row(v) - input.positions.row(v)).transpose();
      left += (m_a + gradient.segment<3>(3 * at)).norm(), inertia += m_a.norm();
    }
    CHECK(left / inertia > 1e-3);  // two iterations do not converge
    REQUIRE(simulation->step_residual());
    CHECK_THAT(simulation->step_residual()->share(), WithinRel(left / inertia, 1e-6));
  }
}

// XPBD adds up λ ∇C while its iterations move the vertices. So the forces of its solution lie along gradients
// of earlier poses. Its distance from the minimum is of second order in how far the gradients turn.
TEST_CASE(
    "the distance of XPBD's solution from the minimum grows with the square of the disturbance at the start",
    "[solver]") {
  const RestMesh rest(equilateral(0.3, 0.3, 4, Rows::parallel));
  for (const std::string_view model : {"crossover", "discrete_shells"}) {
    const auto distance = [&](double disturbance) {
      SimulationInput input = compliant(test::sheet(rest, make_pins(rest, {}, 0), model), "newton", 1e-2,
                                        model == "crossover" ? 0.1 : 100);
      disturb(input, disturbance);
      return largest_difference(after_a_step<double>(input, "newton", 100),
                                after_a_step<double>(input, "pbd", 4000));
    };
    const double far = distance(0.002), near = distance(0.0005);
    INFO(model << ": " << far << " m and " << near << " m");
    CHECK_THAT(std::log(far / near) / std::log(4), WithinAbs(2, 0.4));
  }
}

TEST_CASE("implicit methods come to rest at the equilibrium", "[solver]") {
  const RestMesh rest(equilateral(0.4, 0.4, 6, Rows::parallel));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 0);
  const SimulationInput input =
      compliant(test::sheet(rest, pins, "discrete_shells"), "equilibrium", 1e-3, 1e3);
  const auto equilibrium = make_simulation<double>(input, gravity<double>());
  for (int step = 0; step < 400 && !equilibrium->settled(); ++step) REQUIRE(equilibrium->step());
  for (const std::string_view method : implicit_methods) {
    SimulationInput dragged = input;
    std::vector<Pass<double>> passes = gravity<double>();
    for (auto& pass : test::effect_passes<double>("viscous_drag", rest, pins, "coefficient", 2.0))
      passes.push_back(std::move(pass));
    // Few iterations per step are enough: later steps correct the remaining error.
    const auto settled = moved(dragged, method, "bdf2", 1.0 / 60, 20, std::move(passes),
                               method == "newton" ? 3
                               : method == "vbd"  ? 30
                                                  : 5);
    INFO(method);
    CHECK(largest_difference(settled->positions(), equilibrium->positions()) <= 1e-6);
  }
}

// Few sweeps move a stiff sheet only a little. If they started at x + h v, the sheet would stay stretched by
// this move in every step.
TEST_CASE("block descent with few iterations moves too slowly, but does not stretch the cloth", "[solver]") {
  const RestMesh rest(equilateral(0.4, 0.4, 8, Rows::parallel));
  const Pins pins = make_pins(rest, {0}, 0);
  const SimulationInput input = compliant(test::sheet(rest, pins, "dihedral"), "vbd", 1e-4, 1e3);
  for (const char* integrator : {"euler", "bdf2"}) {
    INFO(integrator);
    const Positions end = moved(input, "vbd", integrator, 1.0 / 60, 3, gravity<double>(), 4)->positions();
    double longest = 0;
    const auto length = [](const Positions& p, const auto& edge) {
      return (p.row(edge[0]) - p.row(edge[1])).norm();
    };
    for (const auto& edge : rest.edges().rowwise())
      longest = std::max(longest, length(end, edge) / length(rest.positions(), edge));
    CHECK(longest <= 1.1);  // the weight of the sheet causes a strain of 0.005 at the pin
  }
}

// A point of mass m on a spring of stiffness k along its direction: ω = √(k / m).
TEST_CASE("backward Euler is of first order, and BDF2 is of second order", "[solver]") {
  SimulationInput input{.method = Pbd{}};
  input.positions = Positions::Zero(2, 3);
  input.positions(1, 0) = 1.1;
  input.rest = Positions::Zero(2, 3);
  input.rest(1, 0) = 1;
  input.origin = Vector3::Zero();
  input.mass = {1, 0.01};
  input.is_pinned = {1, 0};
  input.distance.vertices = {{0, 1}};
  input.distance.rest_length = {1};
  const double k = 4, omega = std::sqrt(k / 0.01), time = 0.25;
  input = compliant(std::move(input), "newton", 1, 1 / k);
  const double exact = 1 + 0.1 * std::cos(omega * time);
  for (const std::string_view method : implicit_methods)
    for (const auto& [integrator, order] : {std::pair("euler", 1.0), std::pair("bdf2", 2.0)}) {
      INFO(method << ", " << integrator);
      const auto error = [&](double h) {
        return std::abs(moved(input, method, integrator, h, time, {})->positions()(1, 0) - exact);
      };
      const double coarse = error(1.0 / 2000), fine = error(1.0 / 4000);
      CHECK_THAT(std::log2(coarse / fine), WithinAbs(order, 0.1));
    }
}

// v' = -c A / m v. Backward Euler gives v_n = v_0 / (1 + q)ⁿ with q = c A h / m, for any step.
TEST_CASE("an implicit step integrates linear drag implicitly", "[solver]") {
  const RestMesh rest(grid(1, 1, 2, 2));
  const Pins pins = make_pins(rest, {}, 0);
  const double density = 0.2, coefficient = 3, h = 0.5;
  for (const std::string_view method : implicit_methods) {
    SimulationInput input = compliant(test::sheet(rest, pins, "none", density), method, 1, 1);
    input.velocities = Positions::Zero(rest.vertex_count(), 3);
    input.velocities.col(0).setConstant(2);
    const auto end =
        moved(input, method, "euler", h, 4 * h,
              test::effect_passes<double>("viscous_drag", rest, pins, "coefficient", coefficient));
    const double expected = 2 / std::pow(1 + coefficient * h / density, 4);
    INFO(method);
    CHECK((end->velocities().col(0).array() - expected).abs().maxCoeff() <= 1e-9);
  }
}

TEST_CASE("an implicit step keeps linear momentum, even with few iterations", "[solver]") {
  const RestMesh rest(delaunay(0.5, 0.5, 5, 3));
  for (const std::string_view method : implicit_methods) {
    SimulationInput input =
        compliant(test::sheet(rest, make_pins(rest, {}, 0), "discrete_shells"), method, 1e-3, 1e3);
    disturb(input, 0.01);
    input.velocities = Positions::Zero(rest.vertex_count(), 3);
    input.velocities.col(1) = 3 * input.positions.col(0);
    const auto momentum = [&](const Positions& v) -> Vector3 {
      Vector3 sum = Vector3::Zero();
      for (Eigen::Index i = 0; i < v.rows(); ++i)
        sum += input.mass[static_cast<std::size_t>(i)] * v.row(i).transpose();
      return sum;
    };
    const auto end = moved(input, method, "bdf2", 1.0 / 60, 1, {}, 2);
    INFO(method);
    CHECK((momentum(end->velocities()) - momentum(input.velocities)).norm() <= 1e-12);
  }
}

// A pass that always moves vertex 0 by d acts on it with the force κ d, and moves it once more at the end of
// the step. With κ = 5 m / h² the sheet has the momentum h κ d + m d / h = 6 m d / h.
TEST_CASE("the push of contacts adds to the momentum of a free sheet", "[solver]") {
  const RestMesh rest(grid(1, 1, 3, 3));
  const double d = 1e-3, h = 1.0 / 60;
  const SimulationInput input =
      compliant(test::sheet(rest, make_pins(rest, {}, 0), "none"), "quasi_newton", 1e-2, 1);
  std::vector<Pass<double>> push(1);
  push[0].name = "push", push[0].stage = Stage::project;
  push[0].run = [d](PassContext<double>& c) { c.state.position[0].z += d; };
  const auto end = moved(input, "quasi_newton", "euler", h, h, std::move(push), 500);
  double momentum = 0;
  for (Eigen::Index v = 0; v < rest.vertex_count(); ++v)
    momentum += input.mass[static_cast<std::size_t>(v)] * end->velocities()(v, 2);
  CHECK_THAT(momentum, WithinRel(6 * input.mass[0] * d / h, 1e-6));
}

// A flat sheet falls onto a plane. The first iteration finds the balance of inertia and the contacts' force,
// so few of the 50 iterations are needed.
TEST_CASE("newton's iterations include the stiffness of contacts", "[solver]") {
  int calls = 0;
  const double h = 1.0 / 60;
  moved(falling_sheet("newton"), "newton", "euler", h, h, plane(calls), 50);
  CHECK(calls <= 5);  // one for each iteration, and one at the end of the step
}

TEST_CASE("cloth does not bounce off contacts, with integrators of either order", "[solver]") {
  const double h = 1.0 / 60, height = 0.3 * h;  // it lands in the first step, or after three steps
  for (const std::string_view method : implicit_methods)
    for (const std::string_view integrator : {"euler", "bdf2"})
      for (const double start : {height, 3 * h + height}) {
        INFO(method << ", " << integrator << ", from " << start << " m");
        int calls = 0;
        SimulationInput input = falling_sheet(method);
        input.positions.col(2).setConstant(start);
        const auto end = moved(input, method, integrator, h, 12 * h, plane(calls), 50);
        CHECK(end->velocities().col(2).cwiseAbs().maxCoeff() <= 0.01);  // it fell at 1 m/s
        CHECK(end->positions().col(2).maxCoeff() <= 0.01 * h);
      }
}

TEST_CASE("the membrane is softened as far as membrane_error allows", "[solver]") {
  const RestMesh rest(equilateral(0.4, 0.4, 8, Rows::parallel));
  const Pins pins = make_pins(rest, {0, 8}, 0);
  const auto softness = [&](double compliance, double error) {
    SimulationInput input = compliant(test::sheet(rest, pins, "dihedral"), "quasi_newton", compliance, 1e4);
    input.method = QuasiNewton{.membrane_error = error};
    const auto simulation = make_simulation<double>(input, gravity<double>());
    CHECK_FALSE(simulation->membrane_softness());  // unknown until the loads are known
    REQUIRE(simulation->step());
    return simulation->membrane_softness().value();
  };
  CHECK(softness(1e-6, 3e-3) > 10);
  CHECK_THAT(softness(1e-6, 3e-3) / softness(1e-6, 3e-2), WithinRel(0.1, 1e-9));
  CHECK_THAT(softness(1e-6, 3e-3) / softness(1e-5, 3e-3), WithinRel(10, 1e-9));
  CHECK(softness(1.0, 3e-3) == 1);
}

TEST_CASE("quasi_newton refuses a model whose force jumps", "[solver]") {
  const RestMesh rest(grid(1, 1, 2, 2));
  const SimulationInput input =
      compliant(test::sheet(rest, make_pins(rest, {0}, 0), "choi_ko"), "quasi_newton", 1e-3, 1);
  CHECK_THROWS_WITH(make_simulation<double>(input, {}), Catch::Matchers::Contains("jumps"));
}

}  // namespace bendlab::implicit_test
