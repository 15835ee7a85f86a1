#include "bendlab/mesh/soup.hpp"

#include <cmath>
#include <limits>

#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::soup_test {
using Kind = MeshProblemKind;
using Strings = std::vector<std::string>;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

//  3 --- 2
//  |   / |
//  | /   |
//  0 --- 1
PolygonSoup square() {
  return {.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .texture_coordinates = {}};
}

// The soup's only problem.
MeshProblem single_problem(const PolygonSoup& soup) {
  const std::vector<MeshProblem> problems = diagnose(soup);
  for (const MeshProblem& problem : problems) UNSCOPED_INFO(describe(problem));
  REQUIRE(problems.size() == 1);
  return problems[0];
}

void check_single(const PolygonSoup& soup, Kind kind, std::size_t count, const Strings& offenders) {
  const MeshProblem problem = single_problem(soup);
  CHECK(problem.kind == kind);
  CHECK(problem.count == count);
  CHECK(problem.offenders == offenders);
}

}  // namespace

TEST_CASE("a sound soup has no problems", "[mesh][soup]") {
  CHECK(diagnose(square()).empty());
}

TEST_CASE("each kind of problem is found and located", "[mesh][soup]") {
  PolygonSoup soup = square();
  SECTION("empty") {
    check_single({}, Kind::empty, 1, {});
  }
  SECTION("not finite") {
    soup.points[3][1] = not_a_number;
    check_single(soup, Kind::non_finite_vertex, 1, {"vertex 3 (0, nan, 0)"});
  }
  SECTION("index out of range") {
    soup.triangles.push_back({1, 2, 4});
    soup.triangles.push_back({-1, 2, 1});
    check_single(soup, Kind::index_out_of_range, 2, {"triangle 2 (1, 2, 4)", "triangle 3 (-1, 2, 1)"});
  }
  SECTION("repeated vertex") {
    soup.triangles.push_back({1, 2, 1});
    check_single(soup, Kind::repeated_vertex, 1, {"triangle 2 (1, 2, 1)"});
  }
  SECTION("zero area") {
    soup.points.push_back({1, 0.5, 0});
    soup.triangles.push_back({1, 4, 2});
    check_single(soup, Kind::zero_area, 1, {"triangle 2 (1, 4, 2)"});
  }
  SECTION("duplicate triangle, in any order of its corners") {
    soup.triangles.push_back({1, 0, 2});
    check_single(soup, Kind::duplicate_triangle, 1, {"triangle 2 (1, 0, 2)"});
  }
  SECTION("three triangles at an edge") {
    soup.points.push_back({0.5, 0.5, 1});
    soup.triangles.push_back({0, 2, 4});
    check_single(soup, Kind::non_manifold_edge, 1, {"edge 0-2 (3 triangles)"});
  }
  SECTION("bow tie") {
    soup.points.insert(soup.points.end(), {{2, 1, 0}, {2, 2, 0}});
    soup.triangles.push_back({2, 4, 5});
    check_single(soup, Kind::non_manifold_vertex, 1, {"vertex 2 (2 fans)"});
  }
  SECTION("inconsistent orientation") {
    std::swap(soup.triangles[1][0], soup.triangles[1][1]);
    check_single(soup, Kind::inconsistent_orientation, 1, {"edge 0-2 (triangles 0 and 1)"});
  }
  SECTION("isolated vertex") {
    soup.points.push_back({9, 9, 9});
    check_single(soup, Kind::isolated_vertex, 1, {"vertex 4"});
    CHECK(single_problem(soup).harmless());
  }
}

TEST_CASE("only the first five offenders are listed, and all are counted", "[mesh][soup]") {
  PolygonSoup soup = square();
  for (int i = 0; i < 8; ++i) soup.triangles.push_back({0, 7 + i, 1});
  const MeshProblem problem = single_problem(soup);
  CHECK(problem.count == 8);
  CHECK(problem.offenders.size() == 5);
  CHECK(describe(problem) ==
        "8 triangles with a vertex index out of range: triangle 2 (0, 7, 1), triangle 3 (0, 8, 1), "
        "triangle 4 (0, 9, 1), triangle 5 (0, 10, 1), triangle 6 (0, 11, 1), …");
}

TEST_CASE("all problems of a soup are reported at once", "[mesh][soup]") {
  PolygonSoup soup = square();
  soup.points.push_back({0, 0, not_a_number});
  soup.triangles.push_back({3, 3, 0});
  soup.triangles.push_back({0, 1, 99});
  std::vector<Kind> kinds;
  for (const MeshProblem& problem : diagnose(soup)) kinds.push_back(problem.kind);
  CHECK(kinds == std::vector{Kind::non_finite_vertex, Kind::index_out_of_range, Kind::repeated_vertex,
                             Kind::isolated_vertex});
}

TEST_CASE("zero area is relative to the mesh's size", "[mesh][soup]") {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    for (const double thickness : {0.5e-7, 2e-7}) {  // below and above the bound for the diagonal √2
      PolygonSoup soup = square();
      soup.points.push_back({1 + thickness * std::sqrt(2.0), 0.5, 0});
      soup.triangles.push_back({1, 4, 2});
      for (auto& point : soup.points)
        for (double& x : point) x *= unit;
      CHECK(diagnose(soup).empty() == (thickness > zero_area_thickness));
    }
  }
}

TEST_CASE("a Möbius strip cannot be oriented", "[mesh][soup]") {
  // The smallest Möbius strip: five vertices in a circle, and triangles of three successive vertices.
  for (unsigned flipped = 0; flipped < 32; ++flipped) {  // any of its triangles may be turned over
    PolygonSoup soup;
    for (int i = 0; i < 5; ++i) {
      soup.points.push_back({std::cos(i), std::sin(i), 0.3 * i});
      soup.triangles.push_back({i, (i + 1) % 5, (i + 2) % 5});
      if ((flipped >> i & 1U) != 0) std::swap(soup.triangles.back()[0], soup.triangles.back()[1]);
    }
    CHECK(single_problem(soup).kind == Kind::inconsistent_orientation);
  }
}

TEST_CASE("isolated vertices are left out and the remaining vertices renumbered", "[mesh][soup]") {
  PolygonSoup soup = square();
  soup.points.insert(soup.points.begin() + 1, {9, 9, 9});
  soup.triangles = {{0, 2, 3}, {0, 3, 4}};
  soup.texture_coordinates.assign(6, {0.25, 0.5});
  const TriangleMesh mesh = to_mesh(soup);
  Positions positions(4, 3);
  positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  CHECK(mesh.positions == positions);
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 0, 2, 3;
  CHECK(mesh.triangles == triangles);
  CHECK(mesh.texture_coordinates.rows() == 6);
  CHECK(diagnose(mesh).empty());
}

}  // namespace bendlab::soup_test
