// Obstacles agree with their geometry: when and how far they push, and that no vertex passes through them.
#include "tests/effects/obstacles.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "bendlab/mesh/files.hpp"
#include "bendlab/mesh/mesh_surface.hpp"
#include "tests/catch.hpp"

namespace bendlab::obstacles_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using test::add_effect, test::list, test::Settings;

constexpr double thickness = 0.01;

TriangleMesh box(const Vector3& half) {
  TriangleMesh mesh;
  mesh.positions.resize(8, 3);
  for (int i = 0; i < 8; ++i)
    mesh.positions.row(i) << (i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(),
        (i & 4 ? 1 : -1) * half.z();
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2,
      1, 3, 7, 1, 7, 5;
  return mesh;
}

// A mesh in a file. The destructor removes the file.
struct MeshFile {
  std::filesystem::path path;
  MeshFile(const char* name, const TriangleMesh& mesh)
      : path(std::filesystem::temp_directory_path() /
             fmt::format("bendlab-obstacle-{}-{}.obj", name, getpid())) {
    write_mesh(path, mesh);
  }
  ~MeshFile() { std::filesystem::remove(path); }
  MeshFile(const MeshFile&) = delete;
  MeshFile& operator=(const MeshFile&) = delete;
};

// An obstacle and its signed distance by definition.
struct Shape {
  std::string name;
  Settings settings;
  std::function<double(const Vector3&)> height;  // m, above the surface
  double half_size;                              // m, along its thinnest direction
};

std::vector<Shape> shapes(const MeshFile& cube) {
  const auto about_segment = [](const Vector3& x) {
    return (x - Vector3(std::clamp(x.x(), -0.3, 0.3), 0, 0)).norm() - 0.1;
  };
  const auto about_disc = [](const Vector3& x) {
    const double out = std::max(0.0, std::hypot(x.x(), x.y()) - 0.38);
    return std::hypot(out, x.z()) - 0.02;
  };
  const auto to_cube = [](const Vector3& x) {
    const Vector3 out = x.cwiseAbs().array() - 0.2;
    return out.cwiseMax(0.0).norm() + std::min(0.0, out.maxCoeff());
  };
  return {
      {"plane", {{"normal", list({0, 0, 2})}}, [](const Vector3& x) { return x.z(); }, 1e9},
      {"sphere", {{"radius", 0.2}}, [](const Vector3& x) { return x.norm() - 0.2; }, 0.2},
      {"capsule", {{"a", list({-0.3, 0, 0})}, {"b", list({0.3, 0, 0})}, {"radius", 0.1}}, about_segment, 0.1},
      {"disc", {{"radius", 0.4}, {"height", 0.04}}, about_disc, 0.02},
      {"mesh_obstacle", {{"file", cube.path.string()}}, to_cube, 0.2}};
}

// One step of loose vertices at `positions` with `velocities`.
template <class Real>
std::pair<Positions, Positions> step_of(const RestMesh& rest, const Positions& positions,
                                        const Positions& velocities, std::vector<Pass<Real>> passes,
                                        double dt = 1.0 / 60, int iterations = 3) {
  SimulationInput input = test::loose(rest);
  input.positions = positions, input.velocities = velocities;
  input.settings.dt = dt, input.settings.iterations = iterations;
  const auto simulation = make_simulation<Real>(input, std::move(passes));
  REQUIRE(simulation->step());
  return {simulation->positions(), simulation->velocities()};
}

}  // namespace

TEMPLATE_TEST_CASE("obstacles push near vertices out to their thickness and move no other vertex",
                   "[effects][obstacles]", float, double) {
  const MeshFile cube("cube", box({0.2, 0.2, 0.2}));
  const RestMesh rest = test::vertices(1000);
  for (const Shape& shape : shapes(cube)) {
    INFO(shape.name);
    std::mt19937_64 random(3);
    Positions positions(rest.vertex_count(), 3);
    // Not deeper: another test checks which way out is nearest.
    const double shallow = std::min(0.05, shape.half_size / 2);
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
      Vector3 x;
      do x = test::random_vector(random, 0.5);
      while (shape.height(x) < -shallow);
      positions.row(v) = x.transpose();
    }
    Settings settings = shape.settings;
    settings.emplace_back("thickness", thickness);
    std::vector<Pass<TestType>> passes;
    add_effect(passes, shape.name, rest, settings, false);
    const Positions still = Positions::Zero(positions.rows(), 3);
    const auto [after, velocities] = step_of<TestType>(rest, positions, still, std::move(passes));
    const auto [plain, unused] = step_of<TestType>(rest, positions, still, {});
    int pushed = 0;
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
      const Vector3 start = plain.row(v), end = after.row(v);
      const double before = shape.height(start);
      const double rounding = 8 * static_cast<double>(std::numeric_limits<TestType>::epsilon());
      if (before > thickness + rounding) {
        CHECK(start == end);  // to the bit
      } else if (before < thickness - rounding) {
        ++pushed;
        CHECK_THAT(shape.height(end), WithinAbs(thickness, 2 * rounding));              // at its thickness
        CHECK_THAT((end - start).norm(), WithinAbs(thickness - before, 4 * rounding));  // by the shortest way
      }
    }
    CHECK(pushed > 5);
  }
}

TEMPLATE_TEST_CASE("a vertex at 50 m/s does not tunnel", "[effects][obstacles]", float, double) {
  const MeshFile cube("fast", box({0.2, 0.2, 0.004}));  // 8 mm thick, a hundredth of the way in a step
  const RestMesh rest = test::vertices(200);
  std::vector<Shape> all = shapes(cube);
  all.back().height = [](const Vector3& x) {
    const Vector3 out = x.cwiseAbs() - Vector3(0.2, 0.2, 0.004);
    return out.cwiseMax(0.0).norm() + std::min(0.0, out.maxCoeff());
  };
  for (const Shape& shape : all) {
    INFO(shape.name);
    std::mt19937_64 random(8);
    Positions positions(rest.vertex_count(), 3), velocities(rest.vertex_count(), 3);
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
      positions.row(v) << test::uniform(random, -0.05, 0.05), test::uniform(random, -0.01, 0.01),
          test::uniform(random, 0.23, 0.53);
      velocities.row(v) << test::uniform(random, -3, 3), test::uniform(random, -0.3, 0.3), -50;
    }
    std::vector<Pass<TestType>> passes;
    Settings settings = shape.settings;
    settings.emplace_back("thickness", thickness);
    add_effect(passes, shape.name, rest, settings);
    const auto [after, unused] = step_of<TestType>(rest, positions, velocities, std::move(passes));
    // The way of a vertex hits the upper side of the shape: it leads 0.833 m down from at most 0.53 m, and at
    // most 0.1 m sideways. So the vertex must stay above the middle.
    CHECK(after.col(2).minCoeff() > 0);
    for (Eigen::Index v = 0; v < after.rows(); ++v)
      CHECK(shape.height(after.row(v).transpose()) >= 0.95 * thickness);
  }
}

TEST_CASE("vertices stay on their side of an open mesh", "[effects][obstacles]") {
  TriangleMesh open = grid(1, 1, 3, 3);
  const MeshFile file("open", open);
  const RestMesh rest = test::vertices(200);
  for (const double side : {1.0, -1.0})
    for (const double speed : {1.0, 50.0}) {
      Positions positions(rest.vertex_count(), 3), velocities = Positions::Zero(rest.vertex_count(), 3);
      std::mt19937_64 random(4);
      for (Eigen::Index v = 0; v < positions.rows(); ++v)
        positions.row(v) = test::random_vector(random, 0.4).transpose();
      positions.col(2).setConstant(side * 1.2 * thickness);
      velocities.col(2).setConstant(-side * speed);
      std::vector<Pass<double>> passes;
      add_effect(passes, "mesh_obstacle", rest, {{"file", file.path.string()}, {"thickness", thickness}});
      const auto [after, unused] = step_of<double>(rest, positions, velocities, std::move(passes));
      CHECK((side * after.col(2)).minCoeff() >= thickness * (1 - 1e-9));  // rounding
    }
}

TEST_CASE("obstacles push and never pull, and contacts record every push", "[effects][obstacles]") {
  const MeshFile cube("push", box({0.2, 0.2, 0.2}));
  const RestMesh rest(delaunay(0.8, 0.8, 9, 4));  // coarse, so edges and triangles are pushed, too
  for (const Shape& shape : shapes(cube)) {
    INFO(shape.name);
    std::vector<Pass<double>> passes;
    Settings settings = shape.settings;
    settings.emplace_back("thickness", thickness);
    add_effect(passes, shape.name, rest, settings);
    State<double> state;
    state.vertex_count = rest.vertex_count();
    state.position.resize(static_cast<std::size_t>(rest.vertex_count()) + 1);
    std::mt19937_64 random(5);
    for (int v = 0; v < rest.vertex_count(); ++v) {
      const auto at = static_cast<std::size_t>(v);
      Vector3 x = rest.position(v) + test::random_vector(random, 0.005);
      x.z() += shape.name == "plane" ? 0 : shape.name == "mesh_obstacle" ? 0.2 : 0.6 * shape.half_size;
      state.position[at].set(x);
      state.mass.push_back(test::uniform(random, 1, 2));
      state.position[at].w = v % 7 == 0 ? 0 : 1 / state.mass[at];
    }
    state.previous = state.position;
    const Points<double> start = state.position;
    const Constraints<double> none;
    PassContext<double> context{state, none, 0.01};
    for (const Pass<double>& pass : passes) pass.run(context);
    Vector3 momentum = Vector3::Zero(), of_contacts = Vector3::Zero();
    double size = 0;
    for (std::size_t v = 0; v < state.mass.size(); ++v) {
      const Vector3 moved = state.position[v].vector() - start[v].vector();
      momentum += state.mass[v] * moved, size += state.mass[v] * moved.norm();
      if (!(start[v].w > 0)) CHECK(moved.isZero(0));
    }
    for (const Contact<double>& contact : state.contacts) {
      CHECK(contact.depth > 0);
      CHECK_THAT(contact.normal.norm(), WithinRel(1.0, 1e-12));
      of_contacts += state.mass[contact.vertex] * contact.depth * contact.normal;
    }
    CHECK(context.acted == state.contacts.size());
    CHECK(context.acted > 5);
    CHECK((momentum - of_contacts).norm() <=
          1e-13 * size * static_cast<double>(context.acted));  // rounding of sums
  }
}

TEST_CASE("an obstacle smaller than a triangle does not pass through it", "[effects][obstacles]") {
  // A triangle 0.4 m wide falls on a ball, on the end of a rod and on the corner of a cube that stands on the
  // opposite corner. Only the middle of the triangle touches the obstacle.
  TriangleMesh triangle;
  triangle.positions.resize(3, 3);
  triangle.positions << 0.23, 0, 0, -0.115, 0.2, 0, -0.115, -0.2, 0;
  triangle.triangles.resize(1, 3);
  triangle.triangles << 0, 1, 2;
  const RestMesh rest(triangle);
  TriangleMesh standing = box({0.02, 0.02, 0.02});
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(Vector3(1, 1, 1), Vector3::UnitZ()).toRotationMatrix();
  standing.positions = standing.positions * turn.transpose();
  const MeshFile cube("standing", standing);
  const std::vector<std::tuple<std::string, Settings, double>> tips = {
      {"sphere", {{"radius", 0.02}}, 0.02},
      {"capsule", {{"a", list({0, 0, 0})}, {"b", list({0, 0, -1})}, {"radius", 0.02}}, 0.02},
      {"mesh_obstacle", {{"file", cube.path.string()}}, 0.02 * std::sqrt(3.0)}};
  for (auto [name, settings, top] : tips) {
    INFO(name);
    SimulationInput input = test::loose(rest);
    input.positions.col(2).setConstant(top + 2 * thickness);
    std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
    settings.emplace_back("thickness", thickness);
    add_effect(passes, name, rest, settings);
    const auto simulation = make_simulation<double>(input, std::move(passes));
    double lowest = 1;
    for (int step = 0; step < 30; ++step) {
      REQUIRE(simulation->step());
      lowest = std::min(lowest, simulation->positions().col(2).mean());  // height of the middle
    }
    CHECK_THAT(lowest, WithinAbs(top + thickness, 1e-4 * thickness));  // one projection is exact
  }
}

TEST_CASE("obstacles far away change no bit", "[effects][obstacles]") {
  const MeshFile cube("far", box({0.2, 0.2, 0.2}));
  const RestMesh rest(grid(1, 1, 12, 12));
  const Pins pins = make_pins(rest, {0}, 1);
  const auto swing = [&](const std::vector<Shape>& obstacles) {
    SimulationInput input = test::sheet(rest, pins, "crossover");
    input.positions.col(2).array() += 2;
    std::vector<Pass<float>> passes = test::effect_passes<float>("gravity");
    for (const Shape& shape : obstacles) add_effect(passes, shape.name, rest, shape.settings);
    if (!obstacles.empty()) add_effect(passes, "friction", rest, {});
    const auto simulation = make_simulation<float>(input, std::move(passes));
    for (int s = 0; s < 60; ++s) REQUIRE(simulation->step());
    for (const PassStatistics& pass : simulation->passes())
      if (pass.name != "gravity") CHECK(pass.acted == 0);
    return simulation->positions();
  };
  CHECK(swing(shapes(cube)) == swing({}));
}

TEST_CASE("obstacles that touch different vertices may be listed in any order", "[effects][obstacles]") {
  const RestMesh rest(grid(1, 1, 24, 24));
  const Settings left = {{"centre", list({-0.3, 0, -0.15})}, {"radius", 0.1}};
  const Settings right = {{"centre", list({0.3, 0, -0.15})}, {"radius", 0.1}};
  const auto fall = [&](const Settings& first, const Settings& second) {
    std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
    add_effect(passes, "sphere", rest, first);
    add_effect(passes, "sphere", rest, second);
    add_effect(passes, "friction", rest, {});
    const auto simulation =
        make_simulation<double>(test::sheet(rest, make_pins(rest, {}, 0), "crossover"), std::move(passes));
    for (int s = 0; s < 60; ++s) REQUIRE(simulation->step());
    return simulation->positions();
  };
  CHECK(fall(left, right) == fall(right, left));
}

TEST_CASE("a vertex slides off a sphere as in the textbook", "[effects][obstacles]") {
  // The vertex starts at rest near the top and slides without friction: v² = 2 g R (cos θ₀ - cos θ). It
  // leaves the sphere at cos θ = 2/3 cos θ₀.
  const RestMesh rest = test::vertices(200);
  const double radius = 1, g = 9.81, start = 0.3;
  const auto energy_error = [&](double dt) {
    SimulationInput input = test::loose(rest);
    const double reach = radius + thickness;
    for (int v = 0; v < rest.vertex_count(); ++v) {
      const double around = v;
      input.positions.row(v) << reach * std::sin(start) * std::cos(around),
          reach * std::sin(start) * std::sin(around), reach * std::cos(start);
    }
    input.settings.dt = dt, input.settings.iterations = 2;
    std::vector<Pass<double>> passes = test::effect_passes<double>("gravity");
    add_effect(passes, "sphere", rest, {{"radius", radius}, {"thickness", thickness}});
    const auto simulation = make_simulation<double>(input, std::move(passes));
    double worst = 0;
    while (simulation->time() < 0.5) {  // the vertex leaves the sphere at 0.63 s
      REQUIRE(simulation->step());
      const Positions x = simulation->positions(), v = simulation->velocities();
      for (Eigen::Index i = 0; i < x.rows(); ++i) {
        CHECK_THAT(x.row(i).norm(), WithinAbs(reach, 1e-9));
        const double gained = 0.5 * v.row(i).squaredNorm(), lost = g * (reach * std::cos(start) - x(i, 2));
        worst = std::max(worst, std::abs(gained - lost));
      }
    }
    return worst;
  };
  const double coarse = energy_error(1.0 / 100), fine_error = energy_error(1.0 / 400);
  CHECK_THAT(coarse / fine_error, WithinRel(4.0, 0.15));  // first order, as symplectic Euler is
  CHECK(fine_error < 0.02 * g * radius);
}

TEST_CASE("a moving obstacle takes the cloth along, and its contacts know the motion of the surface",
          "[effects][obstacles]") {
  const RestMesh rest = test::vertices(200);
  // A plane that rises at 3 m/s under a sheet at rest.
  std::vector<Pass<double>> passes;
  add_effect(passes, "plane", rest, {{"velocity", list({0, 0, 3})}, {"thickness", thickness}}, false);
  const Positions still = Positions::Zero(rest.vertex_count(), 3);
  const auto [after, velocities] = step_of<double>(rest, rest.positions(), still, std::move(passes), 0.01);
  CHECK_THAT(after.col(2).minCoeff(), WithinAbs(0.03 + thickness, 1e-12));
  CHECK_THAT(after.col(2).maxCoeff(), WithinAbs(0.03 + thickness, 1e-12));

  // A turntable that also moves: a point at x goes to R(ωh) x plus the shift.
  passes.clear();
  add_effect(passes, "disc", rest, {{"spin", 20.0}, {"velocity", list({1, 0, 0})}});
  State<double> state;
  state.vertex_count = rest.vertex_count();
  for (int v = 0; v < rest.vertex_count(); ++v) {
    state.position.push_back({0.3 * std::cos(v), 0.2 * std::sin(v), 0.021, 1});
    state.mass.push_back(1);
  }
  state.previous = state.position;
  const Constraints<double> none;
  PassContext<double> context{state, none, 0.01};
  for (const Pass<double>& pass : passes) pass.run(context);
  REQUIRE(state.contacts.size() == static_cast<std::size_t>(rest.vertex_count()));
  for (const Contact<double>& contact : state.contacts) {
    const Vector3 was = state.previous[contact.vertex].vector();
    const Vector3 is = Eigen::AngleAxisd(0.2, Vector3::UnitZ()) * was + Vector3(0.01, 0, 0);
    CHECK((contact.carried - (is - was)).norm() < 1e-14);  // rounding
  }
}

TEST_CASE("a mesh of a cube has the inside, ridges and crossings of a cube", "[mesh]") {
  const MeshSurface cube(box({1, 1, 1}));
  CHECK(cube.closed());
  CHECK(cube.ridges().size() == 12);  // diagonals of the faces are flat, so they are no ridges
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const Vector3 x = test::random_vector(random, 1.5), out = x.cwiseAbs().array() - 1;
    const MeshSurface::Nearest nearest = cube.nearest(x);
    CHECK(nearest.inside == (out.maxCoeff() < 0));
    const double distance = nearest.inside ? -out.maxCoeff() : out.cwiseMax(0.0).norm();
    CHECK_THAT(nearest.distance, WithinAbs(distance, 1e-12));  // rounding
  }
  const auto crossing = cube.first_crossing({0.3, 0.4, 9}, {0.3, 0.4, -9});
  REQUIRE(crossing);
  CHECK((crossing->point - Vector3(0.3, 0.4, 1)).norm() < 1e-12);
  CHECK(crossing->normal == Vector3(0, 0, 1));
  CHECK(crossing->from_front);
  CHECK_FALSE(cube.first_crossing({2, 0, 9}, {2, 0, -9}));
  CHECK_FALSE(MeshSurface(grid(1, 1, 2, 2)).closed());
  TriangleMesh inside_out = box({1, 1, 1});
  inside_out.triangles.col(0).swap(inside_out.triangles.col(1));
  CHECK(MeshSurface(inside_out).nearest({0, 0, 0.5}).inside);
}

TEST_CASE("settings that define no valid obstacle are refused", "[effects][obstacles]") {
  const RestMesh rest = test::vertices(200);
  std::vector<Pass<float>> passes;
  CHECK_THROWS_AS(add_effect(passes, "plane", rest, {{"normal", list({0, 0, 0})}}), std::invalid_argument);
  CHECK_THROWS_AS(add_effect(passes, "capsule", rest, {{"a", list({1, 0, 0})}, {"b", list({1, 0, 0})}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(add_effect(passes, "disc", rest, {{"radius", 0.1}, {"height", 0.3}}),
                  std::invalid_argument);
  CHECK_THROWS_AS(add_effect(passes, "mesh_obstacle", rest, {{"file", std::string("missing.obj")}}),
                  MeshFileError);
}

}  // namespace bendlab::obstacles_test
