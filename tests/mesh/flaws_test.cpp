#include "bendlab/mesh/flaws.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/quality.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/mesh/soup.hpp"
#include "tests/catch.hpp"

namespace bendlab::flaws_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TriangleMesh sheet() {
  return grid(1, 1, 16, 16);
}

// The kinds of problems that the diagnosis finds, with their counts.
std::map<MeshProblemKind, std::size_t> problems_of(const TriangleMesh& mesh) {
  std::map<MeshProblemKind, std::size_t> counts;
  for (const MeshProblem& problem : diagnose(mesh)) counts[problem.kind] = problem.count;
  return counts;
}

double area_of(const TriangleMesh& mesh) {
  const RestMesh rest(mesh);
  double sum = 0;
  for (const double area : rest.areas()) sum += area;
  return sum;
}

// A signed area: triangles turned over count as negative.
double area_facing_up(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Vector3 a = mesh.positions.row(t(0)), b = mesh.positions.row(t(1)), c = mesh.positions.row(t(2));
    sum += 0.5 * (b - a).cross(c - a).z();
  }
  return sum;
}

}  // namespace

TEST_CASE("flaws: each has exactly the problem that its name states", "[mesh]") {
  using enum MeshProblemKind;
  CHECK(problems_of(with_flaw(sheet(), "none")).empty());
  const auto only = [](const char* flaw, MeshProblemKind kind) {
    const auto counts = problems_of(with_flaw(sheet(), flaw));
    INFO(flaw);
    CHECK(counts.size() == 1);
    return counts.count(kind) == 1 ? counts.at(kind) : 0;
  };
  // Scattered stars on 16² cells are at least two edges apart. So they are at most 1/9 and at least 1/49 of
  // the 15² interior vertices.
  const std::size_t fewest = 225 / 49, most = 225 / 9;
  const auto in_range = [&](std::size_t count) { return count >= fewest && count <= most; };
  CHECK(in_range(only("degenerate", zero_area)));
  const std::size_t at_short_edges = only("duplicate_vertices", zero_area);
  CHECK(at_short_edges % 2 == 0);  // both triangles at each edge
  CHECK(in_range(at_short_edges / 2));
  CHECK(only("duplicate_faces", duplicate_triangle) == (512 + 10) / 20);
  CHECK(only("non_manifold_edge", non_manifold_edge) ==
        (3 * 256 - 32 + 10) / 20);  // 3 N² - 2 N interior edges
  CHECK(in_range(only("bow_tie", non_manifold_vertex)));
  CHECK(only("isolated_vertices", isolated_vertex) == 5);
  CHECK(only("mixed_orientation", inconsistent_orientation) > 256);
  for (const char* sound : {"needles", "caps", "pieces", "hole"}) {
    INFO(sound);
    CHECK(problems_of(with_flaw(sheet(), sound)).empty());
  }
}

TEST_CASE("flaws: needles and caps have the documented shape and cover the sheet once", "[mesh]") {
  const TriangleMesh needles = with_flaw(sheet(), "needles"), caps = with_flaw(sheet(), "caps");
  CHECK_THAT(area_facing_up(needles), WithinRel(1.0, 1e-12));
  CHECK_THAT(area_facing_up(caps), WithinRel(1.0, 1e-12));
  CHECK_THAT(area_of(caps), WithinRel(1.0, 1e-12));
  const MeshQuality thin = measure_quality(needles.positions, needles.triangles),
                    flat = measure_quality(caps.positions, caps.triangles);
  // The short edge of a needle is 10⁻³ edges long, the long edges are 1 to √2 edges.
  CHECK(thin.measures[0].maximum >= 999);
  CHECK(thin.measures[0].maximum <= 1.5e3);
  CHECK_THAT(flat.measures[5].maximum, WithinAbs(179.9, 1e-6));
}

TEST_CASE("flaws: a cut gives two halves, and a hole gives a ring", "[mesh]") {
  const auto euler = [](const RestMesh& rest) {
    return rest.vertex_count() - static_cast<int>(rest.edges().rows()) + rest.triangle_count();
  };
  const RestMesh whole(sheet()), cut(with_flaw(sheet(), "pieces")), ring(with_flaw(sheet(), "hole"));
  CHECK(euler(whole) == 1);
  CHECK(euler(cut) == 2);
  CHECK(euler(ring) == 0);
  CHECK(cut.vertex_count() == 17 * 17 + 17);
  CHECK_THAT(area_of(cut.mesh()), WithinRel(1.0, 1e-12));
  // The hole is a disc of radius 0.15 √2, up to a ring of triangles: an edge of 1/16 inwards or outwards.
  const double hole = 1 - area_of(ring.mesh());
  CHECK(hole > std::numbers::pi * std::pow(0.15 * std::numbers::sqrt2 - 1.0 / 16, 2));
  CHECK(hole < std::numbers::pi * std::pow(0.15 * std::numbers::sqrt2 + 1.0 / 16, 2));
}

TEST_CASE("flaws: an unknown name and a mesh with texture are refused", "[mesh]") {
  CHECK_THROWS_AS(with_flaw(sheet(), "scratches"), std::invalid_argument);
  TriangleMesh textured = sheet();
  textured.texture_coordinates.setZero(3 * textured.triangle_count(), 2);
  CHECK_THROWS_AS(with_flaw(textured, "caps"), std::invalid_argument);
  CHECK_THROWS_AS(shuffled(textured, 1), std::invalid_argument);
}

TEST_CASE("shuffled: the same triangles have other vertex numbers", "[mesh]") {
  const TriangleMesh before = delaunay(1, 1, 8, 1), after = shuffled(before, 7);
  const auto corners = [](const TriangleMesh& mesh) {
    std::multiset<std::array<double, 9>> all;
    for (const auto& t : mesh.triangles.rowwise()) {
      std::array<double, 9> coordinates{};
      for (std::size_t i = 0; i < 9; ++i)
        coordinates[i] =
            mesh.positions(t(static_cast<Eigen::Index>(i / 3)), static_cast<Eigen::Index>(i % 3));
      all.insert(coordinates);
    }
    return all;
  };
  CHECK(corners(before) == corners(after));
  CHECK(before.positions != after.positions);
  CHECK(shuffled(before, 7).triangles == after.triangles);
  CHECK(shuffled(before, 8).triangles != after.triangles);
}

TEST_CASE("sphere: closed, the same along all axes, with normals outwards", "[mesh]") {
  const int cells = 7;
  const double radius = 2;
  const RestMesh ball(sphere(radius, cells));
  CHECK(diagnose(ball.mesh()).empty());
  CHECK(ball.vertex_count() == 4 * cells * cells + 2);
  CHECK(ball.triangle_count() == 8 * cells * cells);
  CHECK(static_cast<Eigen::Index>(ball.hinges().size()) == ball.edges().rows());  // no boundary
  double volume = 0;  // of tetrahedra with the centre; positive if the normal points outwards
  for (int t = 0; t < ball.triangle_count(); ++t) {
    const auto corner = ball.triangles().row(t);
    const double of_one =
        ball.position(corner(0)).dot(ball.position(corner(1)).cross(ball.position(corner(2)))) / 6;
    CHECK(of_one > 0);
    volume += of_one;
  }
  const double round = 4 * std::numbers::pi / 3 * radius * radius * radius;
  CHECK(volume < round);
  CHECK(volume > 0.9 * round);  // an inscribed polyhedron with edges e is about e²/(2 r²) = 5 % smaller
  CHECK_THAT(ball.positions().rowwise().norm().minCoeff(), WithinRel(radius, 1e-14));
  CHECK_THROWS_AS(sphere(1, 0), std::invalid_argument);
}

}  // namespace bendlab::flaws_test
