// Strain limiting: stretches end within their bounds, and triangles within bounds do not change.
#include <Eigen/SVD>
#include <cstring>

#include "tests/catch.hpp"
#include "tests/effects/one_pass.hpp"

namespace bendlab::strain_limiting_test {
namespace {

// σ₁, σ₂ of triangle t, by Eigen's Jacobi SVD. F maps the rest edges, in their plane, to [x₁ - x₀, x₂ - x₀].
template <class Real>
Eigen::Vector2d stretches(const RestMesh& rest, const State<Real>& state, int t) {
  const auto x = [&](int c) -> Vector3 {
    return state.position[static_cast<std::size_t>(rest.triangles()(t, c))].vector().template cast<double>();
  };
  const auto q = [&](int c) { return rest.position(rest.triangles()(t, c)); };
  Eigen::Matrix<double, 3, 2> now, before;
  now << x(1) - x(0), x(2) - x(0);
  before << q(1) - q(0), q(2) - q(0);
  // now · before⁺ has the two stretches and a zero as singular values.
  const Eigen::Matrix3d f = now * (before.transpose() * before).inverse() * before.transpose();
  return Eigen::JacobiSVD<Eigen::Matrix3d>(f).singularValues().head<2>();
}

// The smallest and largest stretch of the mesh, without triangles whose three corners are pinned.
template <class Real>
Eigen::Vector2d extremes(const RestMesh& rest, const State<Real>& state) {
  Eigen::Vector2d least_most(1e300, 0);
  for (int t = 0; t < rest.triangle_count(); ++t) {
    bool all_pinned = true;
    for (int c = 0; c < 3; ++c)
      all_pinned &= state.position[static_cast<std::size_t>(rest.triangles()(t, c))].w == 0;
    if (all_pinned) continue;
    const Eigen::Vector2d s = stretches(rest, state, t);
    least_most = {std::min(least_most(0), s(1)), std::max(least_most(1), s(0))};
  }
  return least_most;
}

RestMesh random_triangle(std::mt19937_64& random) {
  TriangleMesh mesh;
  mesh.positions.resize(3, 3);
  do
    for (int v = 0; v < 3; ++v) mesh.positions.row(v) = test::random_vector(random).transpose();
  while (Eigen::Matrix3d(mesh.positions).row(1).cross(mesh.positions.row(2)).norm() < 0.05);
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  return RestMesh(mesh);
}

// The triangle with random positions and masses. Its first `pinned` corners are pinned.
State<double> deformed(const RestMesh& rest, std::mt19937_64& random, int pinned) {
  State<double> state = test::state_of<double>(rest, make_pins(rest, {}, 0));
  for (std::size_t v = 0; v < 3; ++v) {
    state.position[v].set(test::random_vector(random, 1.5));
    state.mass[v] = test::uniform(random, 0.1, 10);
    state.position[v].w = static_cast<int>(v) < pinned ? 0 : 1 / state.mass[v];
  }
  state.previous = state.position;
  return state;
}

double clamped(double stretch) {
  return std::clamp(stretch, 0.9, 1.1);  // the defaults
}

bool same_bits(const Points<float>& a, const Points<float>& b) {
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(Point<float>)) == 0;
}

}  // namespace

TEST_CASE("strain limiting: one projection limits a triangle of any masses and keeps its momenta",
          "[effects]") {
  std::mt19937_64 random(5);
  for (int i = 0; i < 200; ++i) {
    const RestMesh rest = random_triangle(random);
    for (const int pinned : {0, 1}) {
      State<double> state = deformed(rest, random, pinned);
      const State<double> before = state;
      const Eigen::Vector2d old = stretches(rest, state, 0);
      if (old(1) < 1e-3 * old(0)) continue;  // σ₂ of a needle consists of rounding
      const Pins pins = make_pins(rest, pinned ? std::vector<int>{0} : std::vector<int>{}, 0);
      auto passes = test::passes_of<double>("strain_limiting", rest, pins);
      const bool outside = old(0) > 1.1 || old(1) < 0.9;
      CHECK(test::run(passes, state, 0.01) == (outside ? 1 : 0));
      const Eigen::Vector2d now = stretches(rest, state, 0);
      // The pass uses FᵀF, where σ₂² has a rounding of 1e-16 σ₁² and σ₁² is at most 10⁶ σ₂².
      CHECK(std::abs(now(0) - clamped(old(0))) < 1e-9);
      CHECK(std::abs(now(1) - clamped(old(1))) < 1e-9);
      Vector3 shift = Vector3::Zero(), turn = Vector3::Zero();
      const Vector3 about = pinned ? before.position[0].vector() : Vector3(1, -2, 3);
      for (std::size_t v = 0; v < 3; ++v) {
        const Vector3 change = state.position[v].vector() - before.position[v].vector();
        shift += state.mass[v] * change;
        turn += state.mass[v] * (before.position[v].vector() - about).cross(change);
      }
      const double rounding = 1e-12;  // of masses to 10 kg, coordinates to 5 m
      if (pinned)
        CHECK(state.position[0].vector() == before.position[0].vector());
      else
        CHECK(shift.norm() < rounding);
      CHECK(turn.norm() < rounding);
    }
  }
}

TEST_CASE("strain limiting: the free corner of a triangle with two pins moves within the bounds",
          "[effects]") {
  const RestMesh rest(grid(1, 1, 1, 1));
  const Pins pins = make_pins(rest, {rest.triangles()(0, 0), rest.triangles()(0, 1)}, 0);
  auto passes = test::passes_of<double>("strain_limiting", rest, pins);
  std::mt19937_64 random(9);
  for (int i = 0; i < 20; ++i) {
    State<double> state = test::state_of<double>(rest, pins);
    for (std::size_t v = 0; v < state.mass.size(); ++v)
      if (state.position[v].w > 0)
        state.position[v].set(state.position[v].vector() + test::random_vector(random, 2));
    const State<double> before = state;
    for (int pass = 0; pass < 200; ++pass) test::run(passes, state, 0.01);
    CHECK(extremes(rest, state)(0) > 0.9 - 1e-6);
    CHECK(extremes(rest, state)(1) < 1.1 + 1e-6);
    for (const int pin : pins.all) {
      const auto v = static_cast<std::size_t>(pin);
      CHECK(state.position[v].vector() == before.position[v].vector());
    }
  }
}

TEST_CASE("strain limiting changes no bit of a sheet within bounds", "[effects]") {
  const RestMesh rest(delaunay(1, 1, 10, 3));
  const Pins none = make_pins(rest, {}, 0);
  auto passes = test::passes_of<float>("strain_limiting", rest, none);
  State<float> state = test::state_of<float>(rest, none);
  Eigen::Matrix3f f = Eigen::Vector3f(1.09f, 0.91f, 1).asDiagonal();
  f = Eigen::AngleAxisf(1, Eigen::Vector3f(1, 2, 3).normalized()).toRotationMatrix() * f;
  for (Point<float>& p : state.position) p.set(f * p.vector());
  const State<float> before = state;
  CHECK(test::run(passes, state, 0.01f) == 0);
  CHECK(same_bits(state.position, before.position));
}

TEST_CASE("strain limiting of a triangle without area is finite, and a line keeps its direction",
          "[effects]") {
  std::mt19937_64 random(6);
  const RestMesh rest = random_triangle(random);
  const Pins none = make_pins(rest, {}, 0);
  auto passes = test::passes_of<float>("strain_limiting", rest, none);
  for (const float length : {0.0f, 3.0f}) {
    State<float> state = test::state_of<float>(rest, none);
    for (std::size_t v = 0; v < 3; ++v) state.position[v].set({length * static_cast<float>(v), 0, 0});
    test::run(passes, state, 0.01);
    for (std::size_t v = 0; v < 3; ++v) {
      CHECK(std::abs(state.position[v].x) <= 2 * length);
      CHECK(std::abs(state.position[v].y) + std::abs(state.position[v].z) < 1e-5f);  // rounding of 3 m
    }
  }
}

// Gauss-Seidel on a mesh 10 triangles wide: its error shrinks by a constant factor per sweep. A squeezed flat
// sheet could fold over within its plane, and no sweep could undo this. So the sheet has a roughness of 1 %
// of its size.
TEMPLATE_TEST_CASE("strain limiting brings a stretched or squeezed sheet within bounds", "[effects]", float,
                   double) {
  const RestMesh rest(delaunay(1, 1, 10, 3));
  std::mt19937_64 random(2);
  for (const bool held : {false, true})
    for (const double stretch : {1.5, 0.6}) {
      const Pins pins = make_pins(rest, held ? select_vertices(rest, Place::left) : std::vector<int>{}, 0);
      auto passes = test::passes_of<TestType>("strain_limiting", rest, pins);
      State<TestType> state = test::state_of<TestType>(rest, pins);
      const double left = rest.box_min().x();
      for (int v = 0; v < rest.vertex_count(); ++v) {
        const auto i = static_cast<std::size_t>(v);
        state.position[i].x = static_cast<TestType>(left + stretch * (rest.position(v).x() - left));
        if (!pins.pinned(v)) state.position[i].z = static_cast<TestType>(test::uniform(random, -0.01, 0.01));
      }
      const double outside = std::max(0.9 - extremes(rest, state)(0), extremes(rest, state)(1) - 1.1);
      INFO("stretch " << stretch << ", held " << held);
      CHECK(outside > 0.25);
      for (int sweep = 0; sweep < 400; ++sweep) test::run(passes, state, 0.01);
      CHECK(extremes(rest, state)(0) > 0.9 - 1e-3);
      CHECK(extremes(rest, state)(1) < 1.1 + 1e-3);
    }
}

TEST_CASE("strain limiting reduces the energy of a hanging sheet", "[effects]") {
  const RestMesh rest(grid(1, 1, 16, 16));
  const Pins pins = make_pins(rest, select_vertices(rest, Place::upper_right), 1);
  const SimulationInput input = test::sheet(rest, pins, "crossover");
  const double weight = 9.81;
  // Kinetic energy if the step ended now, and the sum with the potential energy, J.
  const auto energies = [&](const State<double>& state, double h) {
    double kinetic = 0, potential = 0;
    for (std::size_t v = 0; v < state.mass.size(); ++v) {
      const Vector3 x = state.position[v].vector();
      kinetic += 0.5 * state.mass[v] * ((x - state.previous[v].vector()) / h).squaredNorm();
      potential += weight * state.mass[v] * x.z();
    }
    return std::pair(kinetic, kinetic + potential);
  };
  int kinetic_rises = 0;
  double rises = 0, falls = 0;
  Pass<double> limiting = test::passes_of<double>("strain_limiting", rest, pins).front();
  const auto limit = limiting.run;
  limiting.run = [&](PassContext<double>& context) {
    const auto [kinetic, total] = energies(context.state, context.substep);
    limit(context);
    const auto [kinetic_after, total_after] = energies(context.state, context.substep);
    kinetic_rises += kinetic_after > kinetic * (1 + 1e-14);  // rounding of the sums
    (total_after > total ? rises : falls) += std::abs(total_after - total);
  };
  std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
  passes.push_back(limiting);
  const auto simulation = make_simulation<double>(input, std::move(passes));
  for (int s = 0; s < 240; ++s) {
    REQUIRE(simulation->step());
    const Positions x = simulation->positions(), v = simulation->velocities();
    double energy = 0;
    for (int i = 0; i < rest.vertex_count(); ++i)
      energy += input.mass[static_cast<std::size_t>(i)] * (0.5 * v.row(i).squaredNorm() + weight * x(i, 2));
    REQUIRE(energy < 0);  // 0 is the energy at the start: level, at rest
  }
  CHECK(kinetic_rises == 0);
  // Pulling the cloth towards its pin lifts it. This may add more energy than the limiting removes.
  CHECK(rises < 1e-4 * falls);
  CHECK(falls > 0.1);
}

}  // namespace bendlab::strain_limiting_test
