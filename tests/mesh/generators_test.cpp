#include "bendlab/mesh/generators.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <vector>

#include "bendlab/mesh/quality.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/mesh/soup.hpp"
#include "tests/catch.hpp"

namespace bendlab::generators_test {
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

// Checks that a generated mesh is a flat, centred, counter-clockwise disc without problems. Returns its area.
double check_sheet(const TriangleMesh& mesh) {
  CHECK(diagnose(mesh).empty());
  CHECK(mesh.positions.col(2).isZero(0));
  const RestMesh rest(mesh);
  CHECK(rest.vertex_count() - rest.edges().rows() + rest.triangle_count() == 1);  // Euler number of a disc
  CHECK_THAT(rest.centre().norm(), WithinAbs(0, 1e-15 * rest.size()));            // rounding
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

TEST_CASE("a grid fills its rectangle with rows of vertices", "[mesh][generators]") {
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

TEST_CASE("the diagonals of a grid run as stated", "[mesh][generators]") {
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

  // Upper row 5 6 7, lower row 0 1 2, with the centres 3 and 4 between them.
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
    for (Eigen::Index e = 0; e < rest.edges().rows(); ++e)  // coordinates of size 1 have a rounding of 10⁻¹⁶
      CHECK_THAT((point(mesh, rest.edges()(e, 0)) - point(mesh, rest.edges()(e, 1))).norm(),
                 WithinAbs(edge, 1e-15));

    // The size along the rows is rounded to a whole number of edges, across the rows to a whole number of
    // strips.
    const Vector3 size = rest.box_max() - rest.box_min();
    const bool along_x = (width >= height) == (rows == Rows::parallel);
    CHECK(std::abs(size.x() - width) <= (along_x ? edge : strip) / 2 + 1e-15);
    CHECK(std::abs(size.y() - height) <= (along_x ? strip : edge) / 2 + 1e-15);
    if (rows == Rows::parallel) CHECK_THAT(size[along_x ? 0 : 1], WithinRel(std::max(width, height), 1e-15));
  }
}

TEST_CASE("the counts of an equilateral lattice agree with counts by hand", "[mesh][generators]") {
  // 0.9 / (√3/6) = 3.1, so three strips of 2 · 3 - 1 triangles between rows of 4 and 3 vertices.
  const TriangleMesh mesh = equilateral(1, 0.9, 3);
  CHECK(mesh.vertex_count() == 4 + 3 + 4 + 3);
  CHECK(mesh.triangle_count() == 15);
  CHECK(triangle(mesh, 0) == std::array{0, 1, 4});
}

TEST_CASE("a Delaunay mesh fills its rectangle with points at the stated distances", "[mesh][generators]") {
  struct Case {
    double width, height;
    int cells;
  };
  for (const auto& [width, height, cells] :
       {Case{1, 1, 24}, Case{3, 1, 30}, Case{1, 0.01, 8}, Case{1, 1, 1}, Case{0.23335, 0.125, 24}}) {
    const TriangleMesh mesh = delaunay(width, height, cells, 7);
    // If a point on a side were off by one ulp, three points on the side could form a triangle. No proper
    // triangle is thinner than 1e-3.
    for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t)
      REQUIRE(signed_area(mesh, t) > 1e-3 * width * height / static_cast<double>(mesh.triangle_count()));
    CHECK_THAT(check_sheet(mesh), WithinRel(width * height, 1e-12));  // a few thousand additions
    const double spacing = width / cells;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const Vector2 p = point(mesh, v);
      const bool inside = std::abs(p.x()) < width / 2 && std::abs(p.y()) < height / 2;
      for (int other = 0; inside && other < mesh.vertex_count(); ++other)
        if (other != v) REQUIRE((p - point(mesh, other)).norm() >= 0.79 * spacing);
    }
  }
  // About one point per squared spacing, within 10 %.
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
      REQUIRE(rows.determinant() <= 1e-14);  // lengths of size 1; rounding at the triangle's own corners
    }
}

TEST_CASE("equal seeds give equal Delaunay meshes, and other seeds give other meshes", "[mesh][generators]") {
  const TriangleMesh first = delaunay(1, 1, 16, 1), again = delaunay(1, 1, 16, 1),
                     other = delaunay(1, 1, 16, 2);
  CHECK(first.positions == again.positions);
  CHECK(first.triangles == again.triangles);
  CHECK((first.positions.rows() != other.positions.rows() || first.positions != other.positions));
  // Neighbouring vertices have close numbers: nearly all edges span at most two rows of about 17 vertices.
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

namespace {

constexpr double pi = std::numbers::pi;

struct Frustum {
  double radius, radius_top, height;

  double slant() const { return std::hypot(radius_top - radius, height); }
  double area() const { return pi * (radius + radius_top) * slant(); }
};

const std::vector<Frustum> frustums = {{0.5, 0.5, 1.5}, {0.2, 0.6, 0.8}, {3, 0.4, 1}, {1, 0.999999, 2}};

double area_of(const RestMesh& rest) {
  double sum = 0;
  for (const double area : rest.areas()) sum += area;
  return sum;
}

double tube_area(const Frustum& f, int cells) {
  return area_of(RestMesh(tube(f.radius, f.radius_top, f.height, cells)));
}

// Edges in only one triangle, as a list of neighbours per vertex.
std::vector<std::vector<int>> boundary_of(const RestMesh& rest) {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(rest.vertex_count()));
  Eigen::SparseMatrix<int> uses(rest.vertex_count(), rest.vertex_count());
  for (Eigen::Index t = 0; t < rest.triangle_count(); ++t)
    for (int c = 0; c < 3; ++c) {
      const int a = rest.triangles()(t, c), b = rest.triangles()(t, (c + 1) % 3);
      uses.coeffRef(std::min(a, b), std::max(a, b)) += 1;
    }
  for (Eigen::Index e = 0; e < rest.edges().rows(); ++e) {
    const int a = rest.edges()(e, 0), b = rest.edges()(e, 1);
    if (uses.coeff(a, b) != 1) continue;
    neighbours[static_cast<std::size_t>(a)].push_back(b);
    neighbours[static_cast<std::size_t>(b)].push_back(a);
  }
  return neighbours;
}

}  // namespace

TEST_CASE("a tube is closed around its axis and open at two rims", "[mesh][generators]") {
  for (const Frustum& f : frustums)
    for (const int cells : {3, 8, 25}) {
      INFO(f.radius << ' ' << f.radius_top << ' ' << f.height << ", " << cells << " cells");
      const TriangleMesh mesh = tube(f.radius, f.radius_top, f.height, cells);
      CHECK(diagnose(mesh).empty());
      const RestMesh rest(mesh);
      CHECK(rest.vertex_count() - rest.edges().rows() + rest.triangle_count() ==
            0);  // Euler number of a ring
      const auto boundary = boundary_of(rest);
      const int last = rest.vertex_count() - cells;
      for (int v = 0; v < rest.vertex_count(); ++v) {
        auto neighbours = boundary[static_cast<std::size_t>(v)];
        std::sort(neighbours.begin(), neighbours.end());
        if (v >= cells && v < last) {
          CHECK(neighbours.empty());
          continue;
        }
        // The first and the last row are loops through `cells` vertices.
        const int first = v < cells ? 0 : last, at = v - first;
        std::vector<int> expected = {first + (at + 1) % cells, first + (at + cells - 1) % cells};
        std::sort(expected.begin(), expected.end());
        CHECK(neighbours == expected);
      }
    }
}

TEST_CASE("the vertices of a tube lie on circles of its cone, evenly spaced", "[mesh][generators]") {
  const int cells = 14;
  for (const Frustum& f : frustums) {
    const TriangleMesh mesh = tube(f.radius, f.radius_top, f.height, cells);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
      const double r = point(mesh, v).norm(), up = mesh.positions(v, 2) / f.height + 0.5;
      // On the straight side of the cone, up to the rounding of the logarithm that spaces the rows.
      CHECK_THAT(r, WithinRel(f.radius + up * (f.radius_top - f.radius), 1e-9));
      const int next = v % cells == cells - 1 ? v + 1 - cells : v + 1;
      CHECK_THAT((mesh.positions.row(next) - mesh.positions.row(v)).norm(),
                 WithinRel(2 * r * std::sin(pi / cells), 1e-13));
    }
    for (const auto& [end, radius, z] :
         {std::tuple(0, f.radius, -f.height / 2),
          std::tuple(static_cast<int>(mesh.vertex_count()) - 1, f.radius_top, f.height / 2)}) {
      CHECK_THAT(point(mesh, end).norm(), WithinRel(radius, 1e-14));
      CHECK(mesh.positions(end, 2) == z);
    }
  }
}

TEST_CASE("the area of a tube agrees with its frustum to second order", "[mesh][generators]") {
  // A triangle of a cylinder has the base 2 r sin(π/m). Its apex is dz higher and r (1 - cos(π/m)) farther
  // outwards.
  const int cells = 40;
  const RestMesh cylinder(tube(0.5, 0.5, 1.5, cells));
  const int rows = cylinder.vertex_count() / cells - 1;
  const double height = std::hypot(1.5 / rows, 0.5 * (1 - std::cos(pi / cells)));
  CHECK_THAT(area_of(cylinder), WithinRel(2.0 * cells * rows * 0.5 * std::sin(pi / cells) * height, 1e-12));

  for (const Frustum& f : frustums) {
    const double coarse = f.area() - tube_area(f, 40), fine = f.area() - tube_area(f, 160);
    // 16, except that rounding about 30 rows to a whole number changes the height of triangles.
    CHECK(std::abs(coarse / fine - 16) < 1.6);
  }
}

TEST_CASE("the triangles of a tube face outwards and are nearly equilateral", "[mesh][generators]") {
  for (const Frustum& f : frustums) {
    const TriangleMesh mesh = tube(f.radius, f.radius_top, f.height, 32);
    for (Eigen::Index t = 0; t < mesh.triangle_count(); ++t) {
      const auto corner = [&](int c) -> Vector3 {
        return mesh.positions.row(mesh.triangles(t, c)).transpose();
      };
      const Vector3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
      Vector3 outward = corner(0) + corner(1) + corner(2);
      outward.z() = 0;
      REQUIRE(normal.dot(outward) > 0);
      CHECK_THAT(corner(1).z(), WithinAbs(corner(0).z(), 0));  // the first edge lies along the circle
    }
    // The number of rows is rounded and at least 6 (8 % of 60°). Rows of a cone taper by at most a sixth.
    const auto angles = measure_quality(mesh.positions, mesh.triangles).measures;
    CHECK(angles[4].minimum > 50);
    CHECK(angles[5].maximum < 70);
  }
}

TEST_CASE("generators refuse sizes and counts that give no valid mesh", "[mesh][generators]") {
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
    CHECK_THROWS_AS(tube(bad, 1, 1, 8), std::invalid_argument);
    CHECK_THROWS_AS(tube(1, bad, 1, 8), std::invalid_argument);
    CHECK_THROWS_AS(tube(1, 1, bad, 8), std::invalid_argument);
  }
  for (const int bad : {0, -3, 1 << 20}) {
    CHECK_THROWS_AS(grid(1, 1, bad, 2), std::invalid_argument);
    CHECK_THROWS_AS(grid(1, 1, 2, bad), std::invalid_argument);
    CHECK_THROWS_AS(equilateral(1, 1, bad), std::invalid_argument);
    CHECK_THROWS_AS(delaunay(1, 1, bad, 1), std::invalid_argument);
    CHECK_THROWS_AS(disc(1, bad), std::invalid_argument);
    CHECK_THROWS_AS(tube(1, 1, 1, bad), std::invalid_argument);
  }
  CHECK_THROWS_AS(equilateral(1, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS(tube(1, 1, 1, 2), std::invalid_argument);          // no ring
  CHECK_THROWS_AS(tube(1, 1, 1e9, 8), std::invalid_argument);        // a billion rows
  CHECK_THROWS_AS(delaunay(1e-9, 1, 10, 1), std::invalid_argument);  // ten billion rows
}

}  // namespace bendlab::generators_test
