#include <algorithm>
#include <cmath>
#include <vector>

#include "bendlab/bending/levels.hpp"
#include "bendlab/mesh/flaws.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/pins.hpp"
#include "bendlab/mesh/rest_mesh.hpp"
#include "bendlab/mesh/rings.hpp"
#include "tests/catch.hpp"

namespace bendlab::rings_and_pins_test {
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

std::vector<int> list(std::span<const int> vertices) {
  return {vertices.begin(), vertices.end()};
}

//   3 --- 4 --- 5
//   | b / | d / |
//   | / a | / c |
//   0 --- 1 --- 2
RestMesh two_cells() {
  return RestMesh(grid(2, 1, 2, 1));
}

Levels default_levels(const RestMesh& rest) {
  return adaptive_levels(rest.size(), rest.mean_edge_length(), LevelSettings{});
}

}  // namespace

TEST_CASE("the edges and neighbours of two cells agree with a list by hand", "[mesh]") {
  const RestMesh rest = two_cells();
  Edges edges(9, 2);
  edges << 0, 1, 0, 3, 0, 4, 1, 2, 1, 4, 1, 5, 2, 5, 3, 4, 4, 5;
  CHECK(rest.edges() == edges);
  const std::vector<std::vector<int>> neighbours = {{1, 3, 4}, {0, 2, 4, 5}, {1, 5},
                                                    {0, 4},    {0, 1, 3, 5}, {1, 2, 4}};
  for (int v = 0; v < 6; ++v) CHECK(list(rest.one_ring()[v]) == neighbours[static_cast<std::size_t>(v)]);
  for (const double area : rest.areas()) CHECK(area == 0.5);
  // Seven edges of length 1 and two diagonals, with one rounding per addition.
  CHECK_THAT(rest.mean_edge_length(), WithinRel((7 + 2 * std::sqrt(2.0)) / 9, 1e-15));
  CHECK_THAT(rest.size(), WithinRel(std::sqrt(5.0), 1e-15));
}

TEST_CASE("every interior edge is a hinge with its two opposite vertices", "[mesh]") {
  const RestMesh rest = two_cells();
  REQUIRE(rest.hinges().size() == 3);
  const std::array<std::array<int, 4>, 3> expected = {
      {{0, 4, 1, 3}, {1, 4, 0, 5}, {1, 5, 2, 4}}};  // edge, opposite vertices
  for (std::size_t h = 0; h < 3; ++h) {
    auto [edge, opposite] = rest.hinges()[h];
    std::sort(opposite.begin(), opposite.end());
    CHECK(std::array{edge[0], edge[1], opposite[0], opposite[1]} == expected[h]);
  }

  for (const TriangleMesh& mesh :
       {grid(1, 1, 7, 5), grid(1, 1, 4, 6, Diagonal::both), disc(1, 5), equilateral(2, 1, 6)}) {
    const RestMesh any(mesh);
    const auto boundary = 2 * any.edges().rows() - 3 * any.triangle_count();  // 3 T = 2 E - E_boundary
    CHECK(static_cast<Eigen::Index>(any.hinges().size()) == any.edges().rows() - boundary);
  }
}

TEST_CASE("ring r of an interior vertex of a triangular lattice has 6 r vertices", "[mesh]") {
  struct Case {
    TriangleMesh mesh;
    int centre;
  };
  const int cells = 16, middle = cells / 2 * (cells + 1) + cells / 2;
  const std::vector<Case> cases = {
      {grid(1, 1, cells, cells), middle},
      {disc(1, 8), 0},
      {equilateral(1, 1, 16), select_vertices(RestMesh(equilateral(1, 1, 16)), Place::centre)[0]}};
  for (const auto& [mesh, centre] : cases) {
    const RestMesh rest(mesh);
    RingWalker walker(rest.one_ring());
    walker.walk(centre, 8);
    CHECK(list(walker.ring(0)) == std::vector{centre});
    for (int r = 1; r <= 7; ++r) CHECK(walker.ring(r).size() == static_cast<std::size_t>(6 * r));
  }
}

TEST_CASE("rings end at the border of the mesh and hold every vertex once", "[mesh]") {
  const RestMesh rest(grid(1, 1, 3, 3));
  RingWalker walker(rest.one_ring());
  // All walks use the same walker, so its marks must stay valid.
  for (int centre = 0; centre < rest.vertex_count(); ++centre) {
    walker.walk(centre, 100);
    std::vector<int> seen;
    for (int r = 0; r <= 101; ++r)
      for (const int v : walker.ring(r)) seen.push_back(v);
    std::sort(seen.begin(), seen.end());
    REQUIRE(seen.size() == 16);
    for (int v = 0; v < 16; ++v) CHECK(seen[static_cast<std::size_t>(v)] == v);
  }
  walker.walk(0, 3);  // along the diagonals (0, 5, 10, 15) the far corner is 3 edges away
  CHECK(list(walker.ring(1)) == std::vector{1, 4, 5});
  CHECK(walker.ring(3).size() == 7);  // top and right side
}

TEST_CASE("a clamp has the same width at every resolution", "[mesh]") {
  for (const int cells : {8, 16, 40}) {
    const RestMesh rest(grid(1, 1, cells, cells));
    // The columns at 0, 1/8 and 1/4 are pinned completely: their vertices are as near to a seed as to the
    // side.
    const Pins pins = make_pins(rest, select_vertices(rest, Place::left), 0, 0.25);
    CHECK(pins.all.size() == static_cast<std::size_t>((cells / 4 + 1) * (cells + 1)));
    CHECK(pins.seeds.size() == static_cast<std::size_t>(cells + 1));
  }
  // A single seed, with six vertices around it at 0.1.
  const RestMesh rest(equilateral(1, 1, 10));
  CHECK(make_pins(rest, select_vertices(rest, Place::centre), 0, 0.1).all.size() == 7);
}

TEST_CASE("the grid's upper right corner and its 1-ring are pinned", "[mesh]") {
  const RestMesh rest(grid(1, 1, 4, 4));
  const std::vector<int> corner = select_vertices(rest, Place::upper_right);
  REQUIRE(corner == std::vector{24});
  CHECK(make_pins(rest, corner, 0).all == std::vector{24});
  // Two triangles meet at the corner: its neighbours are to the left, below and along the diagonal.
  const Pins pins = make_pins(rest, corner, 1);
  CHECK(pins.seeds == std::vector{24});
  CHECK(pins.all == std::vector{18, 19, 23, 24});
  for (int v = 0; v < rest.vertex_count(); ++v)
    CHECK(pins.pinned(v) == std::binary_search(pins.all.begin(), pins.all.end(), v));
  CHECK(make_pins(rest, select_vertices(rest, Place::lower_right), 1).all ==
        std::vector{3, 4, 9});  // in one triangle

  CHECK(make_pins(rest, {6, 2, 6}, 0).seeds == std::vector{2, 6});
  CHECK_THROWS_AS(make_pins(rest, {25}, 1), std::out_of_range);
  CHECK_THROWS_AS(make_pins(rest, {-1}, 1), std::out_of_range);
}

TEST_CASE("vertices are selected by their place in the box around the rest shape", "[mesh]") {
  const RestMesh rest(grid(3, 2, 3, 2));  // rows 0 … 3, 4 … 7, 8 … 11
  CHECK(select_vertices(rest, Place::lower_left) == std::vector{0});
  CHECK(select_vertices(rest, Place::upper_left) == std::vector{8});
  CHECK(select_vertices(rest, Place::bottom) == std::vector{0, 1, 2, 3});
  CHECK(select_vertices(rest, Place::top) == std::vector{8, 9, 10, 11});
  CHECK(select_vertices(rest, Place::left) == std::vector{0, 4, 8});
  CHECK(select_vertices(rest, Place::right) == std::vector{3, 7, 11});
  CHECK(select_vertices(RestMesh(disc(1, 3)), Place::centre) == std::vector{0});
  CHECK_THROWS_AS(select_vertices(rest, Place::top_rim),
                  std::invalid_argument);  // in a flat mesh the rim would be every vertex

  const RestMesh sleeve(tube(0.3, 0.2, 1, 5));
  CHECK(select_vertices(sleeve, Place::bottom_rim) == std::vector{0, 1, 2, 3, 4});
  const int last = sleeve.vertex_count() - 1;
  CHECK(select_vertices(sleeve, Place::top_rim) == std::vector{last - 4, last - 3, last - 2, last - 1, last});
}

TEST_CASE("in a standing sheet, names of places use z as up", "[mesh]") {
  const TriangleMesh flat = grid(3, 2, 12, 8);  // 13 vertices in a row, 9 rows
  const RestMesh lying(flat);
  const auto standing = [&](int right, double waves) {
    TriangleMesh mesh = flat;
    mesh.positions.setZero();
    mesh.positions.col(right) = flat.positions.col(0);
    mesh.positions.col(2) = flat.positions.col(1);
    mesh.positions.col(1 - right) = waves * (4 * flat.positions.col(0)).array().sin();
    return mesh;
  };
  // In the planes y = 0 and x = 0, and with folds like a curtain, the same vertices have the names as in a
  // lying sheet.
  for (const int right : {0, 1})
    for (const double waves : {0.0, 0.08}) {
      INFO("right is axis " << right << ", folds of " << waves);
      const RestMesh rest(standing(right, waves));
      for (const Place place :
           {Place::upper_right, Place::upper_left, Place::lower_right, Place::lower_left, Place::top,
            Place::bottom, Place::left, Place::right, Place::centre, Place::interior})
        CHECK(select_vertices(rest, place) == select_vertices(lying, place));
      CHECK(select_vertices(rest, Place::upper_left) == std::vector{8 * 13});
      CHECK(select_vertices(rest, Place::top_rim) == select_vertices(lying, Place::top));
    }
  // A leaning sheet and a tube have their names in x and y.
  TriangleMesh leaning = flat;
  leaning.positions.col(2) = 5 * flat.positions.col(1);
  CHECK(select_vertices(RestMesh(leaning), Place::upper_left) == std::vector{8 * 13});
  CHECK(named_axes(RestMesh(tube(0.05, 0.05, 3, 12))).up == 1);
}

TEST_CASE("if vertices are equally near, their place decides and not their number", "[mesh]") {
  // The middle of 3 × 3 cells is between four vertices. A corner of a tube's box is above every second row.
  const auto place = [](const TriangleMesh& mesh, Place name) -> Vector3 {
    const RestMesh rest(mesh);
    return rest.position(select_vertices(rest, name).front());
  };
  const TriangleMesh square = grid(3, 3, 3, 3), sleeve = tube(1, 1, 4, 8), ball = sphere(1, 4);
  CHECK((place(square, Place::centre) - Vector3(-0.5, -0.5, 0)).norm() < 1e-12);
  CHECK((place(ball, Place::centre) - Vector3(0, 0, 1)).norm() < 1e-12);  // seen from above
  const double top = sleeve.positions.col(2).maxCoeff();
  CHECK(place(sleeve, Place::upper_right).z() > top - 2 * 4.0 / 5);  // in the upper two of at least five rows
  for (const unsigned seed : {1U, 2U, 3U})
    for (const TriangleMesh& mesh : {square, sleeve, ball})
      for (const Place name : {Place::centre, Place::upper_right, Place::lower_left})
        CHECK((place(shuffled(mesh, seed), name) - place(mesh, name)).norm() < 1e-12);
}

TEST_CASE("the place circle is a closed ring around the centre, and the place interior has four vertices",
          "[mesh]") {
  // Rings at 1/16, 2/16, …; a quarter of the width, 1/4, is ring 4 with 24 vertices.
  const RestMesh round(disc(0.5, 8));
  const std::vector<int> circle = select_vertices(round, Place::circle);
  CHECK(circle.size() == 24);
  for (const int v : circle) CHECK_THAT(round.position(v).norm(), WithinAbs(0.25, 1e-12));

  // Four cells around the centre, whose corners are farther away: √2/4.
  const RestMesh four(grid(1, 1, 4, 4, Diagonal::both));
  for (const int v : select_vertices(four, Place::circle)) CHECK(four.position(v).norm() <= 0.25 + 1e-12);
  CHECK(select_vertices(four, Place::circle).size() == 8);  // 4 neighbours at 1/4, 4 cell centres at √2/8

  const RestMesh round_about(tube(0.25, 0.25, 2, 24));
  const std::vector<int> patch = select_vertices(round_about, Place::circle);
  CHECK(patch.size() > 3);
  CHECK(static_cast<int>(patch.size()) < round_about.vertex_count() / 4);

  const RestMesh ten(grid(2, 1, 10, 10));
  const std::vector<int> interior = select_vertices(ten, Place::interior);
  REQUIRE(interior.size() == 4);
  for (const int v : interior) {
    CHECK_THAT(std::abs(ten.position(v).x()), WithinAbs(0.4, 1e-12));  // at 0.3 and 0.7 of the width 2
    CHECK_THAT(std::abs(ten.position(v).y()), WithinAbs(0.2, 1e-12));
  }
  CHECK(select_vertices(RestMesh(grid(1, 1, 2, 2)), Place::interior) ==
        std::vector<int>(4, 4));  // the only interior vertex
}

TEST_CASE("the paper's m and n agree with values by hand for three meshes", "[mesh][levels]") {
  SECTION("unit square grid") {
    struct Case {
      int cells;
      double unrounded;
      int m;
    };
    for (const auto& [cells, unrounded, m] :
         {Case{16, 1.50, 1}, Case{32, 2.00, 1}, Case{64, 2.99, 2}, Case{128, 4.98, 4}}) {
      const Levels levels = default_levels(RestMesh(grid(1, 1, cells, cells)));
      CHECK_THAT(levels.m_unrounded, WithinAbs(unrounded, 0.005));  // known to two decimals
      // 2 N (N + 1) sides of length 1 / N and N² diagonals. The rounding of a few thousand additions is less
      // than 10⁻¹².
      const double n = cells, mean_edge = (2 * (n + 1) + std::sqrt(2.0) * n) / (3 * n * n + 2 * n);
      CHECK_THAT(levels.m_unrounded, WithinRel(std::sqrt(2.0) / 4 / mean_edge * 0.1 + 1, 1e-12));
      CHECK(levels.m == m);
      CHECK(levels.n == 2 * m + 1);
    }
  }
  SECTION("equilateral lattice: every edge 1/32, 37 strips of height √3/64") {
    const Levels levels = default_levels(RestMesh(equilateral(1, 1, 32)));
    const double height = 37 * std::sqrt(3.0) / 64;
    CHECK_THAT(levels.m_unrounded, WithinRel(std::hypot(1, height) / 4 * 32 * 0.1 + 1, 1e-12));
    CHECK(levels.m == 2);
    CHECK(levels.n == 5);
  }
  SECTION("a 3-4-5 triangle: box diagonal 5, mean edge 4") {
    TriangleMesh mesh;
    mesh.positions.resize(3, 3);
    mesh.positions << 0, 0, 0, 3, 0, 0, 0, 4, 0;
    mesh.triangles.resize(1, 3);
    mesh.triangles << 0, 1, 2;
    const Levels levels = default_levels(RestMesh(mesh));
    CHECK_THAT(levels.m_unrounded, WithinRel(1.25 / 4 * 0.1 + 1, 1e-15));
    CHECK(levels.m == 1);
    CHECK(levels.n == 3);
  }
}

}  // namespace bendlab::rings_and_pins_test
