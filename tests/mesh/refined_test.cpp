// Refined and jittered meshes have the counts that Euler's formula gives, and keep area, vertex numbers and
// border.
#include "bendlab/mesh/refined.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/quality.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/mesh/soup.hpp"
#include "tests/catch.hpp"

namespace bendlab::refined_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

// Twice the smallest signed area of a triangle. It is negative if a triangle is turned over.
double least_facing_up(const TriangleMesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles.rowwise()) {
    const Vector3 a = mesh.positions.row(t(0)), b = mesh.positions.row(t(1)), c = mesh.positions.row(t(2));
    least = std::min(least, (b - a).cross(c - a).z());
  }
  return least;
}

double area_of(const TriangleMesh& mesh) {
  double sum = 0;
  const RestMesh rest(mesh);
  for (const double area : rest.areas()) sum += area;
  return sum;
}

}  // namespace

TEST_CASE("refining: a triangle becomes four, and new vertices come after old vertices", "[mesh]") {
  TriangleMesh mesh{.positions = Positions(3, 3), .triangles = Triangles(1, 3), .texture_coordinates = {}};
  mesh.positions << 0, 0, 0, 4, 0, 0, 0, 2, 0;
  mesh.triangles << 0, 1, 2;
  mesh.texture_coordinates = TextureCoordinates(3, 2);
  mesh.texture_coordinates << 0, 0, 1, 0, 0, 1;
  const TriangleMesh fine = refined(mesh, 1);
  REQUIRE(fine.vertex_count() == 6);
  REQUIRE(fine.triangle_count() == 4);
  CHECK(fine.positions.topRows(3) == mesh.positions);
  Positions middles(3, 3);
  middles << 2, 0, 0, 2, 1, 0, 0, 1, 0;
  CHECK(fine.positions.bottomRows(3) == middles);
  // Texture coordinates are x/4 and y/2 at the three corners, so they are everywhere.
  for (Eigen::Index t = 0; t < 4; ++t)
    for (Eigen::Index c = 0; c < 3; ++c) {
      const auto place = fine.positions.row(fine.triangles(t, c));
      CHECK(fine.texture_coordinates(3 * t + c, 0) == place(0) / 4);
      CHECK(fine.texture_coordinates(3 * t + c, 1) == place(1) / 2);
    }
  CHECK(least_facing_up(fine) == 2);  // a quarter of 8
}

TEST_CASE("refining gives the expected counts and a sound mesh, and keeps area and border", "[mesh]") {
  const TriangleMesh coarse = disc(1, 3);
  const TriangleMesh fine = refined(coarse, 2);
  // V' = V + E and E' = 2 E + 3 T: 37, 90, 54 become 127, 342, 216 and then 469, …
  CHECK(coarse.vertex_count() == 37);
  CHECK(fine.vertex_count() == 469);
  CHECK(fine.triangle_count() == 16 * 54);
  CHECK(diagnose(fine).empty());
  CHECK_THAT(area_of(fine), WithinRel(area_of(coarse), 1e-12));  // a sum of hundreds of roundings
  CHECK(fine.positions.topRows(37) == coarse.positions);
  // The border stays a polygon of 18 sides: no vertex leaves the coarse border.
  CHECK(RestMesh(fine).box_max() == RestMesh(coarse).box_max());
}

TEST_CASE("refining a grid gives the grid with twice as many cells", "[mesh]") {
  const RestMesh fine(refined(grid(2, 1, 4, 2), 1)), same(grid(2, 1, 8, 4));
  CHECK(fine.vertex_count() == same.vertex_count());
  CHECK(fine.edges().rows() == same.edges().rows());
  CHECK_THAT(fine.mean_edge_length(), WithinRel(same.mean_edge_length(), 1e-12));
  for (int v = 0; v < same.vertex_count(); ++v)
    CHECK((fine.positions().rowwise() - same.positions().row(v)).rowwise().norm().minCoeff() == 0);
}

TEST_CASE("refining 0 times changes nothing, and refining too often is refused", "[mesh]") {
  const TriangleMesh mesh = grid(1, 1, 2, 2);
  CHECK(refined(mesh, 0).positions == mesh.positions);
  // 8 · 4¹¹ = 2²⁵ triangles is the largest allowed number.
  CHECK(most_refinements(8) == 11);
  CHECK(most_refinements(most_refined_triangles) == 0);
  CHECK_THROWS_AS(refined(mesh, 12), std::invalid_argument);
}

TEST_CASE("jitter moves only interior vertices, by less than its share, and depends on its seed", "[mesh]") {
  const TriangleMesh mesh = grid(1, 1, 10, 10);
  const double height = 0.1 / std::sqrt(2.0);  // the smallest height of a right triangle
  const TriangleMesh moved = jittered(mesh, 0.4, 7);
  int still = 0;
  for (Eigen::Index v = 0; v < mesh.vertex_count(); ++v) {
    const double distance = (moved.positions.row(v) - mesh.positions.row(v)).norm();
    CHECK(distance <= 0.4 * height * (1 + 1e-12));
    still += distance == 0;
    CHECK(moved.positions(v, 2) == mesh.positions(v, 2));
  }
  CHECK(still == 40);  // the border
  CHECK(least_facing_up(moved) > 0);
  CHECK_THAT(area_of(moved), WithinAbs(1, 1e-12));  // the border does not move
  CHECK(jittered(mesh, 0.4, 7).positions == moved.positions);
  CHECK(jittered(mesh, 0.4, 8).positions != moved.positions);
  CHECK(jittered(mesh, 0, 7).positions == mesh.positions);
}

TEST_CASE("jitter refuses a mesh with texture coordinates, which would no longer fit", "[mesh]") {
  TriangleMesh mesh = grid(1, 1, 2, 2);
  mesh.texture_coordinates = TextureCoordinates::Zero(3 * mesh.triangle_count(), 2);
  CHECK_THROWS_AS(jittered(mesh, 0.1, 1), std::invalid_argument);
}

}  // namespace bendlab::refined_test
