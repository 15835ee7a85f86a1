#include "bendlab/mesh/generators.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/mesh/soup.hpp"
#include "tests/catch.hpp"

using namespace bendlab;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

Vector2 point(const TriangleMesh& mesh, int vertex) {
  return mesh.positions.row(vertex).head<2>().transpose();
}

double signed_area(const TriangleMesh& mesh, Eigen::Index t) {
  const Vector2 a = point(mesh, mesh.triangles(t, 0));
  const Vector2 u = point(mesh, mesh.triangles(t, 1)) - a, v = point(mesh, mesh.triangles(t, 2)) - a;
  return 0.5 * (u.x() * v.y() - u.y() * v.x());
}

// What every generated mesh has to be: flat, centred, counter-clockwise, one disc, nothing wrong. Returns its
// area.
double check_sheet(const TriangleMesh& mesh) {
  CHECK(diagnose(mesh).empty());
  CHECK(mesh.positions.col(2).isZero(0));
  const RestMesh rest(mesh);
  CHECK(rest.vertex_count() - rest.edges().rows() + rest.triangle_count() == 1);  // Euler number of a disc
  CHECK_THAT(rest.centre().norm(),
             WithinAbs(0, 1e-15 * rest.size()));  // rounding of the two halves of the box
  double area = 0;
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t) {
    REQUIRE(signed_area(mesh, t) > 0);
    area += signed_area(mesh, t);
  }
  return area;
}

std::array<int, 3> triangle(const TriangleMesh& mesh, Eigen::Index t) {
  return {mesh.triangles(t, 0), mesh.triangles(t, 1), mesh.triangles(t, 2)};
}

}  // namespace

TEST_CASE("a grid fills its rectangle, row by row", "[mesh][generators]") {
  for (const Diagonal diagonal : {Diagonal::same, Diagonal::alternating, Diagonal::both}) {
    const TriangleMesh mesh = grid(3, 2, 6, 5, diagonal);
    CHECK_THAT(check_sheet(mesh), WithinRel(6.0, 1e-13));  // at most 120 additions
    CHECK(mesh.vertex_count() == 42 + (diagonal == Diagonal::both ? 30 : 0));
    CHECK(mesh.triangle_count() == (diagonal == Diagonal::both ? 120 : 60));
    CHECK(point(mesh, 0) == Vector2(-1.5, -1));
    CHECK(point(mesh, 6) == Vector2(1.5, -1));
    CHECK(point(mesh, static_cast<int>(mesh.vertex_count()) - 1) == Vector2(1.5, 1));
  }
}

TEST_CASE("the diagonals of a grid", "[mesh][generators]") {
  // 6 7 8
  // 3 4 5
  // 0 1 2
  const TriangleMesh same = grid(2, 2, 2, 2, Diagonal::same);
  CHECK(triangle(same, 0) == std::array{0, 1, 4});
  CHECK(triangle(same, 1) == std::array{0, 4, 3});
  CHECK((same.triangles.array() == 8).count() == 2);  // the upper right corner
  CHECK((same.triangles.array() == 6).count() == 1);

  const TriangleMesh alternating = grid(2, 2, 2, 2, Diagonal::alternating);
  CHECK((alternating.triangles.array() == 4).count() == 8);  // all four diagonals meet in the middle
  for (const int corner : {0, 2, 6, 8}) CHECK((alternating.triangles.array() == corner).count() == 2);

  // 5 6 7 with the centres 3, 4 between the rows, and 0 1 2
  const TriangleMesh both = grid(2, 1, 2, 1, Diagonal::both);
  CHECK(point(both, 3) == Vector2(-0.5, 0));
  CHECK(point(both, 4) == Vector2(0.5, 0));
  for (const int centre : {3, 4}) CHECK((both.triangles.array() == centre).count() == 4);
  CHECK(triangle(both, 0) == std::array{0, 1, 3});
}

TEST_CASE("every triangle of an equilateral lattice is equilateral", "[mesh][generators]") {
  struct Case {
    double width, height;
    Rows rows;
  };
  for (const auto& [width, height, rows] :
       {Case{1, 1, Rows::parallel}, Case{1, 1, Rows::perpendicular}, Case{2, 0.7, Rows::parallel},
        Case{2, 0.7, Rows::perpendicular}, Case{0.7, 2, Rows::parallel}, Case{0.7, 2, Rows::perpendicular}}) {
    const int cells = 10;
    const TriangleMesh mesh = equilateral(width, height, cells, rows);
    check_sheet(mesh);
    const RestMesh rest(mesh);
    const double edge = std::max(width, height) / cells, strip = edge * std::sqrt(3.0) / 2;
    for (Eigen::Index e = 0; e < rest.edges().rows(); ++e)  // coordinates of size 1 are rounded by 10⁻¹⁶
      CHECK_THAT((point(mesh, rest.edges()(e, 0)) - point(mesh, rest.edges()(e, 1))).norm(),
                 WithinAbs(edge, 1e-15));

    // Along the rows the nearest number of edges, across them the nearest number of strips.
    const Vector3 size = rest.box_max() - rest.box_min();
    const bool along_x = (width >= height) == (rows == Rows::parallel);
    CHECK(std::abs(size.x() - width) <= (along_x ? edge : strip) / 2 + 1e-15);
    CHECK(std::abs(size.y() - height) <= (along_x ? strip : edge) / 2 + 1e-15);
    if (rows == Rows::parallel) CHECK_THAT(size[along_x ? 0 : 1], WithinRel(std::max(width, height), 1e-15));
  }
}

TEST_CASE("an equilateral lattice, counted by hand", "[mesh][generators]") {
  // Two strips (0.9 / (√3/6) = 3.1, so three) of 2 · 3 - 1 triangles between rows of 4 and 3 vertices.
  const TriangleMesh mesh = equilateral(1, 0.9, 3);
  CHECK(mesh.vertex_count() == 4 + 3 + 4 + 3);
  CHECK(mesh.triangle_count() == 15);
  CHECK(triangle(mesh, 0) == std::array{0, 1, 4});
}

TEST_CASE("a Delaunay mesh fills its rectangle with points at their distances", "[mesh][generators]") {
  struct Case {
    double width, height;
    int cells;
  };
  for (const auto& [width, height, cells] :
       {Case{1, 1, 24}, Case{3, 1, 30}, Case{1, 0.01, 8}, Case{1, 1, 1}}) {
    const TriangleMesh mesh = delaunay(width, height, cells, 7);
    CHECK_THAT(check_sheet(mesh), WithinRel(width * height, 1e-12));  // some thousand additions
    const double spacing = width / cells;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const Vector2 p = point(mesh, v);
      const bool inside = std::abs(p.x()) < width / 2 && std::abs(p.y()) < height / 2;
      for (int other = 0; inside && other < mesh.vertex_count(); ++other)
        if (other != v) REQUIRE((p - point(mesh, other)).norm() >= 0.79 * spacing);
    }
  }
  // About one point per spacing², within 10 %.
  CHECK(std::abs(static_cast<double>(delaunay(1, 1, 64, 1).vertex_count()) / (65 * 65) - 1) < 0.1);
}

TEST_CASE("no point of a Delaunay mesh lies in a triangle's circumcircle", "[mesh][generators]") {
  const TriangleMesh mesh = delaunay(1.5, 1, 12, 3);
  for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t)
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      Eigen::Matrix3d rows;  // the in-circle determinant of points relative to v
      for (int c = 0; c < 3; ++c) {
        const Vector2 d = point(mesh, mesh.triangles(t, c)) - point(mesh, v);
        rows.row(c) << d.x(), d.y(), d.squaredNorm();
      }
      REQUIRE(rows.determinant() <=
              1e-14);  // lengths of size 1; the triangle's own corners give 0 and rounding
    }
}

TEST_CASE("equal seeds give equal Delaunay meshes, and only those", "[mesh][generators]") {
  const TriangleMesh first = delaunay(1, 1, 16, 1), again = delaunay(1, 1, 16, 1),
                     other = delaunay(1, 1, 16, 2);
  CHECK(first.positions == again.positions);
  CHECK(first.triangles == again.triangles);
  CHECK((first.positions.rows() != other.positions.rows() || first.positions != other.positions));
  // Neighbours in space are neighbours in number: nearly all edges span at most two rows of ~ 17 vertices.
  const RestMesh rest(first);
  const Eigen::VectorXi span = rest.edges().col(1) - rest.edges().col(0);
  CHECK(span.maxCoeff() < 4 * 17);
}

TEST_CASE("a disc has 6 r vertices on ring r", "[mesh][generators]") {
  const int rings = 7;
  const TriangleMesh mesh = disc(2, rings);
  // The outline is a regular polygon with 6 · 7 corners.
  const double sides = 6 * rings, area = 0.5 * sides * 4 * std::sin(2 * std::numbers::pi / sides);
  CHECK_THAT(check_sheet(mesh), WithinRel(area, 1e-13));  // 294 additions
  CHECK(mesh.vertex_count() == 1 + 3 * rings * (rings + 1));
  CHECK(mesh.triangle_count() == 6 * rings * rings);
  int vertex = 1;
  for (int r = 1; r <= rings; ++r)
    for (int k = 0; k < 6 * r; ++k)
      CHECK_THAT(point(mesh, vertex++).norm(), WithinRel(2.0 * r / rings, 1e-15));
}

TEST_CASE("generators refuse sizes and counts that make no mesh", "[mesh][generators]") {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, nan, infinity}) {
    CHECK_THROWS_AS(grid(bad, 1, 2, 2), std::invalid_argument);
    CHECK_THROWS_AS(grid(1, bad, 2, 2), std::invalid_argument);
    CHECK_THROWS_AS(equilateral(bad, 1, 4), std::invalid_argument);
    CHECK_THROWS_AS(equilateral(1, bad, 4), std::invalid_argument);
    CHECK_THROWS_AS(delaunay(bad, 1, 4, 1), std::invalid_argument);
    CHECK_THROWS_AS(delaunay(1, bad, 4, 1), std::invalid_argument);
    CHECK_THROWS_AS(disc(bad, 3), std::invalid_argument);
  }
  for (const int bad : {0, -3, 1 << 20}) {
    CHECK_THROWS_AS(grid(1, 1, bad, 2), std::invalid_argument);
    CHECK_THROWS_AS(grid(1, 1, 2, bad), std::invalid_argument);
    CHECK_THROWS_AS(equilateral(1, 1, bad), std::invalid_argument);
    CHECK_THROWS_AS(delaunay(1, 1, bad, 1), std::invalid_argument);
    CHECK_THROWS_AS(disc(1, bad), std::invalid_argument);
  }
  CHECK_THROWS_AS(equilateral(1, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(delaunay(1e-9, 1, 10, 1), std::invalid_argument);  // ten billion rows
}
