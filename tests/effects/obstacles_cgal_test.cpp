// Sheets are dropped on obstacles, and CGAL compares frames with the triangles of the obstacle: no vertex is
// nearer than 95 % of the thickness, and no edge passes through the surface.
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#if __has_include(<CGAL/AABB_traits_3.h>)  // CGAL 6 renamed these headers
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <numbers>

#include "bendlab/mesh/files.hpp"
#include "tests/catch.hpp"
#include "tests/effects/obstacles.hpp"

namespace bendlab::obstacles_cgal_test {
namespace {

using test::add_effect, test::list, test::Settings;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_3;
using Iterator = std::vector<Triangle>::const_iterator;
#if __has_include(<CGAL/AABB_traits_3.h>)
using Traits = CGAL::AABB_traits_3<Kernel, CGAL::AABB_triangle_primitive_3<Kernel, Iterator>>;
#else
using Traits = CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Iterator>>;
#endif

constexpr double pi = std::numbers::pi, thickness = 0.005;

Kernel::Point_3 point_of(const Positions& x, Eigen::Index row) {
  return {x(row, 0), x(row, 1), x(row, 2)};
}

// The surface that arises when a closed ring of points (ρ, z) turns about z: triangles in a grid like on a
// torus. Normals point outwards if the ring runs counter-clockwise in (ρ, z).
TriangleMesh revolved(const std::vector<Vector2>& ring, int sectors) {
  const int count = static_cast<int>(ring.size());
  TriangleMesh mesh;
  mesh.positions.resize(count * sectors, 3);
  mesh.triangles.resize(2 * count * sectors, 3);
  for (int s = 0; s < sectors; ++s)
    for (int i = 0; i < count; ++i) {
      const Vector2& p = ring[static_cast<std::size_t>(i)];
      const double turn = 2 * pi * s / sectors;
      mesh.positions.row(s * count + i) << p.x() * std::cos(turn), p.x() * std::sin(turn), p.y();
      const int a = s * count + i, b = s * count + (i + 1) % count;
      const int c = (s + 1) % sectors * count + i, d = (s + 1) % sectors * count + (i + 1) % count;
      mesh.triangles.row(2 * a) << a, c, d;
      mesh.triangles.row(2 * a + 1) << a, d, b;
    }
  return mesh;
}

// The outline of all points within `radius` of a segment: half circles joined by lines. The segment goes from
// 0 to `core` on the ρ axis, or (upright) from -core to core on the z axis. Its points are on the shape, so
// lines between them are inside.
std::vector<Vector2> outline(double radius, double core, bool upright) {
  constexpr int steps = 48;
  std::vector<Vector2> points;
  for (int i = 0; i <= steps; ++i) {
    const double angle = pi * i / steps - pi / 2;
    const double z = upright ? std::copysign(core, angle) : 0;
    points.emplace_back((upright ? 0 : core) + radius * std::cos(angle), radius * std::sin(angle) + z);
  }
  if (!upright && core > 0) points.emplace_back(0, radius), points.emplace_back(0, -radius);
  return points;
}

std::vector<Vector2> circle(double centre, double radius) {
  std::vector<Vector2> points;
  for (int i = 0; i < 24; ++i)
    points.emplace_back(centre + radius * std::cos(2 * pi * i / 24), radius * std::sin(2 * pi * i / 24));
  return points;
}

// A cube turned by `turn`, so that it can stand on an edge or a corner.
TriangleMesh cube(double half, const Eigen::Matrix3d& turn) {
  TriangleMesh mesh;
  mesh.positions.resize(8, 3);
  for (int i = 0; i < 8; ++i)
    mesh.positions.row(i) =
        (turn * Vector3(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half)).transpose();
  mesh.triangles.resize(12, 3);
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2,
      1, 3, 7, 1, 7, 5;
  return mesh;
}

struct Obstacle {
  std::string label, effect;
  Settings settings;
  TriangleMesh surface;
  double top;  // m
  bool from_file = false;
};

std::vector<Obstacle> obstacles() {
  TriangleMesh lying = revolved(outline(0.08, 0.15, true), 96);
  lying.positions =
      lying.positions * Eigen::AngleAxisd(pi / 2, Vector3::UnitY()).toRotationMatrix().transpose();
  TriangleMesh thin = revolved(outline(0.01, 0.2, true), 48);
  thin.positions =
      thin.positions * Eigen::AngleAxisd(pi / 2, Vector3::UnitY()).toRotationMatrix().transpose();
  const Eigen::Matrix3d on_edge = Eigen::AngleAxisd(pi / 4, Vector3::UnitX()).toRotationMatrix();
  const Eigen::Matrix3d on_corner = Eigen::AngleAxisd(std::atan(std::sqrt(0.5)), Vector3::UnitY()) * on_edge;
  TriangleMesh floor = grid(4, 4, 1, 1);
  return {
      {"plane", "plane", {}, floor, 0},
      {"sphere", "sphere", {{"radius", 0.15}}, revolved(outline(0.15, 0, false), 96), 0.15},
      {"ball finer than the cloth",
       "sphere",
       {{"radius", 0.02}},
       revolved(outline(0.02, 0, false), 48),
       0.02},
      {"capsule",
       "capsule",
       {{"a", list({-0.15, 0, 0})}, {"b", list({0.15, 0, 0})}, {"radius", 0.08}},
       lying,
       0.08},
      {"rod", "capsule", {{"a", list({-0.2, 0, 0})}, {"b", list({0.2, 0, 0})}, {"radius", 0.01}}, thin, 0.01},
      {"disc", "disc", {{"radius", 0.2}, {"height", 0.02}}, revolved(outline(0.01, 0.19, false), 96), 0.01},
      {"cube", "mesh_obstacle", {}, cube(0.12, Eigen::Matrix3d::Identity()), 0.12, true},
      {"cube on an edge", "mesh_obstacle", {}, cube(0.1, on_edge), 0.1 * std::sqrt(2.0), true},
      {"cube on a corner", "mesh_obstacle", {}, cube(0.1, on_corner), 0.1 * std::sqrt(3.0), true},
      {"torus", "mesh_obstacle", {}, revolved(circle(0.15, 0.04), 48), 0.04, true}};
}

struct Contacts {
  double nearest = 1e9;  // m, of a vertex to the surface
  int edges_through = 0;
  int touched = 0;
};

template <class Real>
Contacts dropped(const Obstacle& obstacle, const RestMesh& rest, double friction) {
  const auto file = std::filesystem::temp_directory_path() /
                    fmt::format("bendlab-dropped-{}-{}.obj", obstacle.label, getpid());
  Settings settings = obstacle.settings;
  settings.emplace_back("thickness", thickness);
  if (obstacle.from_file) {
    write_mesh(file, obstacle.surface);
    settings.emplace_back("file", file.string());
  }
  SimulationInput input = test::sheet(rest, make_pins(rest, {}, 0), "crossover");
  input.positions.rowwise() += Eigen::RowVector3d(0.011, 0.007, obstacle.top + 0.03);
  // The solver does not follow edges through a substep. At the final speed of 4 m/s edges move by 17 mm,
  // which is less than the smallest obstacle and its thickness, 20 mm + 5 mm.
  input.settings.iterations = 8, input.settings.substeps = 4;
  input.bending_stiffness.k = 0.1;
  std::vector<Pass<Real>> passes = test::effect_passes<Real>("gravity");
  add_effect(passes, obstacle.effect, rest, settings);
  if (friction > 0) add_effect(passes, "friction", rest, {{"static", friction}, {"kinetic", friction}});
  const auto simulation = make_simulation<Real>(input, std::move(passes));

  std::vector<Triangle> triangles;
  for (const auto& t : obstacle.surface.triangles.rowwise()) {
    const Triangle triangle(point_of(obstacle.surface.positions, t(0)),
                            point_of(obstacle.surface.positions, t(1)),
                            point_of(obstacle.surface.positions, t(2)));
    if (!triangle.is_degenerate()) triangles.push_back(triangle);
  }
  const CGAL::AABB_tree<Traits> tree(triangles.cbegin(), triangles.cend());
  Contacts contacts;
  for (int frame = 0; frame < 75; ++frame) {
    REQUIRE(simulation->step());
    const Positions x = simulation->positions();
    if (frame % 3 != 0) continue;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
      contacts.nearest =
          std::min(contacts.nearest, std::sqrt(CGAL::to_double(tree.squared_distance(point_of(x, v)))));
    for (const auto& e : rest.edges().rowwise())
      contacts.edges_through += tree.do_intersect(Kernel::Segment_3(point_of(x, e(0)), point_of(x, e(1))));
  }
  for (const PassStatistics& pass : simulation->passes())
    if (pass.name == obstacle.effect) contacts.touched += static_cast<int>(pass.acted);
  if (obstacle.from_file) std::filesystem::remove(file);
  return contacts;
}

}  // namespace

TEMPLATE_TEST_CASE("a sheet dropped on an obstacle stays out of it", "[effects][obstacles]", float, double) {
  const RestMesh rest(delaunay(0.5, 0.5, 20, 6));
  // Every pair of precision, obstacle and friction occurs.
  bool rubs = std::is_same_v<TestType, double>;
  for (const Obstacle& obstacle : obstacles()) {
    const double friction = (rubs = !rubs) ? 0.5 : 0;
    INFO(obstacle.label << ", friction " << friction);
    const Contacts contacts = dropped<TestType>(obstacle, rest, friction);
    CHECK(contacts.touched > 0);
    CHECK(contacts.nearest >= 0.95 * thickness);
    CHECK(contacts.edges_through == 0);
  }
}

}  // namespace bendlab::obstacles_cgal_test
