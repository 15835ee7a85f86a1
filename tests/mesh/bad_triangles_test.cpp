// The mesh that each policy makes of each kind of bad mesh, counted by hand.
#include "bendlab/mesh/bad_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "bendlab/constraints/build.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/material_coordinates.hpp"
#include "bendlab/metrics/stretch.hpp"
#include "tests/catch.hpp"

namespace bendlab::bad_triangles_test {
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

//  3 --- 2
//  |   / |
//  | /   |
//  0 --- 1
PolygonSoup square() {
  return {.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
          .triangles = {{0, 1, 2}, {0, 2, 3}},
          .texture_coordinates = {}};
}

double area_of(const TriangleMesh& mesh) {
  const RestMesh rest(mesh);
  double sum = 0;
  for (const double area : rest.areas()) sum += area;
  return sum;
}

struct Case {
  const char* name;
  PolygonSoup soup;
  int kept_vertices, kept_triangles;          // under regularise and membrane_off
  int repaired_vertices, repaired_triangles;  // under repair
};

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](const char* name, std::array<int, 4> counts, const auto& change) {
    PolygonSoup soup = square();
    change(soup);
    all.push_back({name, soup, counts[0], counts[1], counts[2], counts[3]});
  };
  add("a vertex that is not finite", {4, 2, 4, 2}, [](PolygonSoup& s) {
    s.points.push_back({0, nan_value, 0});
    s.triangles.push_back({1, 2, 4});
  });
  add("an index out of range", {4, 2, 4, 2}, [](PolygonSoup& s) {
    s.triangles.push_back({1, 2, 4});
    s.triangles.push_back({-1, 2, 1});
  });
  add("a repeated vertex", {4, 2, 4, 2}, [](PolygonSoup& s) { s.triangles.push_back({1, 2, 1}); });
  add("a duplicate triangle", {4, 2, 4, 2}, [](PolygonSoup& s) { s.triangles.push_back({1, 0, 2}); });
  add("an isolated vertex", {4, 2, 4, 2}, [](PolygonSoup& s) { s.points.push_back({5, 5, 5}); });
  // A cap on the diagonal. Both triangles at the diagonal are split at the third vertex of the cap.
  add("a cap without height", {5, 3, 5, 4}, [](PolygonSoup& s) {
    s.points.push_back({0.5, 0.5, 0});
    s.triangles = {{0, 1, 2}, {0, 4, 2}, {0, 2, 3}};
  });
  // Its third vertex becomes a vertex of the boundary.
  add("a cap beyond the boundary", {5, 3, 5, 3}, [](PolygonSoup& s) {
    s.points.push_back({1, 0.25, 0});
    s.triangles.push_back({1, 4, 2});
  });
  // No triangle lies beyond its longest edge. The cap is removed, and the two triangles beside it touch in a
  // point.
  add("a cap whose long edge is free", {5, 3, 6, 2}, [](PolygonSoup& s) {
    s.points[2] = {1, 0.5, 0}, s.points[1] = {2, 0.5, 0};
    s.points[0] = {0, 0.5, 0}, s.points[3] = {1, 1, 0};
    s.points.push_back({2, 1, 0});
    s.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 4}};
  });
  // Vertex 4 is at the place of vertex 2.
  add("a needle without width", {5, 3, 4, 2}, [](PolygonSoup& s) {
    s.points.push_back({1, 1, 0});
    s.triangles = {{0, 1, 2}, {0, 2, 4}, {0, 4, 3}};
  });
  add("a triangle at a point", {6, 3, 4, 2}, [](PolygonSoup& s) {
    s.points.push_back({1, 1, 0});
    s.points.push_back({1, 1, 0});
    s.triangles.push_back({2, 4, 5});
  });
  add("equal points of two pieces", {6, 2, 4, 2}, [](PolygonSoup& s) {
    s.points.push_back({0, 0, 0});
    s.points.push_back({1, 1, 0});
    s.triangles = {{0, 1, 2}, {4, 5, 3}};
  });
  // Cut into three single triangles.
  add("three triangles at an edge", {5, 3, 9, 3}, [](PolygonSoup& s) {
    s.points.push_back({0.5, 0.5, 1});
    s.triangles.push_back({0, 2, 4});
  });
  add("a bow tie", {6, 3, 7, 3}, [](PolygonSoup& s) {
    s.points.insert(s.points.end(), {{2, 1, 0}, {2, 2, 0}});
    s.triangles.push_back({2, 4, 5});
  });
  add("mixed orientation", {4, 2, 4, 2}, [](PolygonSoup& s) { s.triangles[1] = {0, 3, 2}; });
  return all;
}

}  // namespace

TEST_CASE("every policy except refuse accepts meshes that can be simulated", "[mesh][bad]") {
  for (const Case& c : cases())
    for (const BadTriangles policy :
         {BadTriangles::regularise, BadTriangles::membrane_off, BadTriangles::repair}) {
      INFO(c.name << ", " << bad_triangles_names[static_cast<std::size_t>(policy)]);
      const bool repairs = policy == BadTriangles::repair;
      const AcceptedMesh accepted = accept(c.soup, policy);
      for (const std::string& note : accepted.notes) UNSCOPED_INFO(note);
      CHECK(accepted.mesh.vertex_count() == (repairs ? c.repaired_vertices : c.kept_vertices));
      CHECK(accepted.mesh.triangle_count() == (repairs ? c.repaired_triangles : c.kept_triangles));
      CHECK((repairs ? diagnose(accepted.mesh).empty() : true));
      CHECK((std::string(c.name).starts_with("equal points") && !repairs) == accepted.notes.empty());
    }
}

TEST_CASE("the policy refuse accepts only a sound mesh", "[mesh][bad]") {
  for (const Case& c : cases()) {
    INFO(c.name);
    bool harmful = false;
    for (const MeshProblem& problem : diagnose(c.soup)) harmful |= !problem.harmless();
    if (harmful)
      CHECK_THROWS_AS(accept(c.soup, BadTriangles::refuse), std::invalid_argument);
    else
      CHECK(accept(c.soup, BadTriangles::refuse).mesh.triangle_count() == 2);
  }
}

TEST_CASE("a sound mesh is the same under every policy", "[mesh][bad]") {
  const TriangleMesh mesh = delaunay(1, 1, 8, 3);
  PolygonSoup soup;
  for (const auto& p : mesh.positions.rowwise()) soup.points.push_back({p(0), p(1), p(2)});
  for (const auto& t : mesh.triangles.rowwise()) soup.triangles.push_back({t(0), t(1), t(2)});
  for (const BadTriangles policy :
       {BadTriangles::refuse, BadTriangles::regularise, BadTriangles::membrane_off, BadTriangles::repair}) {
    const AcceptedMesh accepted = accept(soup, policy);
    CHECK(accepted.mesh.positions == mesh.positions);
    CHECK(accepted.mesh.triangles == mesh.triangles);
    CHECK(accepted.notes.empty());
    CHECK_FALSE(accepted.renumbered);
  }
}

namespace {

// 4 by 4 unit cells with two triangles each. Triangle 12, in the interior, is turned over. Then follow
// triangles that every policy leaves out: two duplicates, one with a repeated vertex, three with indices out
// of range. The last triangle is a cap on the edge of triangle 0 at the boundary.
//
//  5 ------ 6
//  |  1   / |
//  |   /  0 |
//  0 - 25 - 1
constexpr int turned = 12, cap = 32;

PolygonSoup lattice() {
  PolygonSoup soup;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) soup.points.push_back({1.0 * x, 1.0 * y, 0});
  for (std::int64_t y = 0; y < 4; ++y)
    for (std::int64_t x = 0; x < 4; ++x) {
      const std::int64_t a = 5 * y + x;
      soup.triangles.push_back({a, a + 1, a + 6});
      soup.triangles.push_back({a, a + 6, a + 5});
    }
  return soup;
}

PolygonSoup damaged_lattice() {
  PolygonSoup soup = lattice();
  std::swap(soup.triangles[turned][1], soup.triangles[turned][2]);
  soup.triangles.insert(soup.triangles.begin() + 7, {{0, 1, 6}, {3, 3, 9}, {1, 2, 99}});
  soup.triangles.insert(soup.triangles.end(), {{24, 18, 23}, {-1, 2, 3}, {25, 26, 27}});
  soup.points.push_back({0.5, 0, 0});
  soup.triangles.push_back({1, 0, 25});
  return soup;
}

// The sum of the counts in the notes that begin with this remedy, such as "left out: 2 triangles with …". A
// remedy has no digits.
int reported(const AcceptedMesh& accepted, const std::string& remedy) {
  int count = 0;
  for (const std::string& note : accepted.notes)
    if (note.starts_with(remedy)) count += std::stoi(note.substr(note.find_first_of("0123456789")));
  return count;
}

// The triangles in any order. Each starts with its lowest corner, so equal triangles compare as equal.
std::multiset<std::array<int, 3>> oriented_triangles(const TriangleMesh& mesh) {
  std::multiset<std::array<int, 3>> all;
  for (const auto& t : mesh.triangles.rowwise()) {
    std::array<int, 3> corners = {t(0), t(1), t(2)};
    std::ranges::rotate(corners, std::ranges::min_element(corners));
    all.insert(corners);
  }
  return all;
}

}  // namespace

TEST_CASE("regularise and membrane_off change exactly the triangles that they report", "[mesh][bad]") {
  PolygonSoup kept = lattice();
  std::swap(kept.triangles[turned][1], kept.triangles[turned][2]);
  const auto inverse_of_kept = inverse_rest_from_warp(to_mesh(kept), Vector3::UnitX());
  for (const BadTriangles policy : {BadTriangles::regularise, BadTriangles::membrane_off}) {
    const PolygonSoup soup = damaged_lattice();
    const AcceptedMesh accepted = accept(soup, policy);
    const int left_out =
        static_cast<int>(soup.triangles.size()) - static_cast<int>(accepted.mesh.triangle_count());
    CHECK(left_out == 6);
    CHECK(reported(accepted, "left out") == left_out);
    CHECK(accepted.mesh.positions.topRows(25) == to_mesh(kept).positions);
    CHECK(accepted.mesh.triangles.topRows(cap) == to_mesh(kept).triangles);
    CHECK(accepted.mesh.triangles.row(cap) == Eigen::RowVector3i(1, 0, 25));

    const auto inverse = inverse_rest_from_warp(accepted.mesh, Vector3::UnitX());
    int changed = 0;
    for (std::size_t t = 0; t < inverse.size(); ++t)
      changed += t >= inverse_of_kept.size() || inverse[t] != inverse_of_kept[t];
    CHECK(changed == 1);  // the cap
    CHECK(reported(accepted, policy == BadTriangles::regularise ? "simulated with a small rest height"
                                                                : "simulated without strain") == changed);
    CHECK(reported(accepted, "kept") == 3);  // the edges of the turned triangle
    CHECK(accepted.notes.size() == 5);
  }
}

TEST_CASE("repair changes exactly the triangles that it reports", "[mesh][bad]") {
  const AcceptedMesh accepted = accept(damaged_lattice(), BadTriangles::repair);
  CHECK(reported(accepted, "left out") == 6);
  CHECK(reported(accepted, "collapsed to an edge, or removed") == 1);
  CHECK(reported(accepted, "turned to face the same side") == 3);  // edges
  CHECK(accepted.notes.size() == 5);
  // The cap is removed, the triangle beyond its longest edge becomes two, and triangle 12 is turned back.
  PolygonSoup expected = lattice();
  expected.points.push_back({0.5, 0, 0});
  expected.triangles[0] = {0, 25, 6};
  expected.triangles.push_back({25, 1, 6});
  CHECK(accepted.mesh.positions == to_mesh(expected).positions);
  CHECK(oriented_triangles(accepted.mesh) == oriented_triangles(to_mesh(expected)));
}

TEST_CASE("every policy refuses a mesh without a valid triangle", "[mesh][bad]") {
  const PolygonSoup nothing,
      only_bad{.points = {{0, 0, 0}, {1, 0, 0}, {nan_value, 0, 0}},
               .triangles = {{0, 1, 2}, {0, 0, 1}},
               .texture_coordinates = {}},
      a_point{
          .points = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, .triangles = {{0, 1, 2}}, .texture_coordinates = {}};
  for (const BadTriangles policy :
       {BadTriangles::refuse, BadTriangles::regularise, BadTriangles::membrane_off, BadTriangles::repair})
    for (const PolygonSoup& soup : {nothing, only_bad, a_point})
      CHECK_THROWS_AS(accept(soup, policy), std::invalid_argument);
}

TEST_CASE("repair splits the neighbours of a cap, and keeps area and texture", "[mesh][bad]") {
  PolygonSoup soup = square();
  soup.points.push_back({0.5, 0.5, 0});
  soup.triangles = {{0, 1, 2}, {0, 4, 2}, {0, 2, 3}};
  for (const auto& t : soup.triangles)
    for (const std::int64_t v : t) {
      const auto& p = soup.points[static_cast<std::size_t>(v)];
      soup.texture_coordinates.push_back({2 * p[0], 3 * p[1]});
    }
  const TriangleMesh mesh = accept(soup, BadTriangles::repair).mesh;
  CHECK_THAT(area_of(mesh), WithinRel(1, 1e-15));
  REQUIRE(mesh.texture_coordinates.rows() == 12);
  for (int t = 0; t < 4; ++t)
    for (int c = 0; c < 3; ++c) {
      const auto p = mesh.positions.row(mesh.triangles(t, c));
      CHECK(mesh.texture_coordinates(3 * t + c, 0) == 2 * p(0));
      CHECK(mesh.texture_coordinates(3 * t + c, 1) == 3 * p(1));
    }
}

namespace {

// Vertices - edges + triangles: 1 for a disc, 0 for a ring and for a Möbius band.
Eigen::Index euler_number(const TriangleMesh& mesh) {
  return mesh.vertex_count() - RestMesh(mesh).edges().rows() + mesh.triangle_count();
}

}  // namespace

// Cut across, the band is a strip (a disc). Cut lengthwise it would be a ring, twice as long.
TEST_CASE("repair cuts a Möbius band across, and reports this", "[mesh][bad]") {
  constexpr int around = 40, across = 3;
  constexpr double width = 0.3;
  PolygonSoup soup;
  for (int i = 0; i < around; ++i) {
    const double turn = 2 * 3.14159265358979 * i / around;
    for (int j = 0; j <= across; ++j) {
      const double side = width * (1.0 * j / across - 0.5), radius = 0.5 + side * std::cos(turn / 2);
      soup.points.push_back({radius * std::cos(turn), radius * std::sin(turn), side * std::sin(turn / 2)});
    }
  }
  const auto vertex = [&](int i, int j) { return i < around ? 4 * i + j : across - j; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const std::int64_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                         d = vertex(i, j + 1);
      soup.triangles.push_back({a, b, c});
      soup.triangles.push_back({a, c, d});
    }
  REQUIRE(euler_number(to_mesh(soup)) == 0);
  const AcceptedMesh accepted = accept(soup, BadTriangles::repair);
  CHECK(diagnose(accepted.mesh).empty());
  CHECK(accepted.mesh.triangle_count() == 2 * around * across);
  CHECK(euler_number(accepted.mesh) == 1);
  // The cut runs along n edges, so n + 1 vertices are doubled.
  const auto doubled = accepted.mesh.vertex_count() - 4 * around;
  CHECK(reported(accepted, "cut along") == doubled - 1);
  const auto cut =
      std::ranges::find_if(accepted.notes, [](auto& note) { return note.starts_with("cut along"); });
  REQUIRE(cut != accepted.notes.end());
  const double length = std::stod(cut->substr(cut->find(", ") + 2));
  CHECK(length > 0.999 * width);  // the report has three digits
  CHECK(length < 2 * width);
}

TEST_CASE("repair merges points that rounding has moved apart", "[mesh][bad]") {
  for (const double size : {1e-3, 1.0, 1e3})
    for (const double apart : {0.0, 1e-7, 1e-6, 1e-5}) {
      INFO(size << " m, " << apart << " of it");
      // Two halves of a square without common vertices. The size of the square is √2.
      PolygonSoup soup{
          .points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {apart, 0, apart}, {1, 1 - apart, 0}, {0, 1, 0}},
          .triangles = {{0, 1, 2}, {3, 4, 5}}};
      for (auto& p : soup.points)
        for (double& x : p) x *= size;
      const AcceptedMesh accepted = accept(soup, BadTriangles::repair);
      const bool united = std::sqrt(2.0) * apart < std::sqrt(2.0) * united_within;
      CHECK(accepted.mesh.vertex_count() == (united ? 4 : 6));
      CHECK(reported(accepted, "united") == (united ? 2 : 0));
      if (!united) continue;
      CHECK(accepted.notes[0].find(apart > 0 ? "m away" : "at the same place") != std::string::npos);
      CHECK(accepted.notes[0].find("2e-06 of the mesh's size") != std::string::npos);
      // The first of the points stays where it is.
      CHECK(accepted.mesh.positions.row(0) == Eigen::RowVector3d(0, 0, 0));
      CHECK(accepted.mesh.positions.row(2) == Eigen::RowVector3d(size, size, 0));
    }
}

TEST_CASE("a triangle without area gets a rest height of a thousandth of its length", "[mesh][bad]") {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    PolygonSoup soup = square();
    soup.points.push_back({1, 0.25, 0});
    soup.triangles.push_back({1, 4, 2});
    for (auto& p : soup.points)
      for (double& x : p) x *= scale;
    const TriangleMesh mesh = accept(soup, BadTriangles::regularise).mesh;
    CHECK(triangles_without_area(mesh) == std::vector<char>{0, 0, 1});
    const InverseRest q = inverse_rest_from_warp(mesh, Vector3::UnitX())[2];
    // The base is 1 and the height 1/1000, so |det Q⁻¹| = 1 / 0.001. The foot of the height is at vertex 4.
    CHECK_THAT(std::abs(q[0] * q[3] - q[1] * q[2]), WithinRel(1000 / (scale * scale), 1e-9));
  }
}

TEST_CASE("triangles without area still have mass, and hold vertices in the membrane", "[mesh][bad]") {
  PolygonSoup soup = square();
  soup.points.push_back({1, 0.25, 0});   // only in the cap
  soup.points.push_back({0.5, 0.5, 0});  // on the diagonal, in two more triangles
  soup.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}, {0, 5, 2}, {0, 5, 3}};
  const TriangleMesh mesh = accept(soup, BadTriangles::membrane_off).mesh;
  const RestMesh rest(mesh);
  const std::vector<double> mass = lumped_masses(rest, 1);
  for (const double m : mass) CHECK(m > 0);
  // The areas are ½, ½ and ¼. Vertex 4 gets a hundredth of the mean mass, vertex 5 a third of its sound
  // triangle.
  const double mean = (0.5 + 0.5 + 0.25) / 6;
  CHECK_THAT(mass[4], WithinRel(0.01 * mean, 1e-12));
  CHECK_THAT(mass[5], WithinRel(0.25 / 3, 1e-12));

  // Without the cap at the boundary, vertex 4 would be in no constraint. The cap on the diagonal is
  // dispensable.
  CHECK(dispensable_triangles(rest) == std::vector<char>{0, 0, 0, 1, 0});
  const Pins none = make_pins(rest, {}, 0);
  const auto inverse = inverse_rest_from_warp(mesh, Vector3::UnitX());
  CHECK(strain_constraints(rest, none, inverse).size() == 5);
  CHECK(strain_constraints(rest, none, inverse, dispensable_triangles(rest)).size() == 4);
  for (const InverseRest& q : inverse)
    for (const double entry : q) CHECK(std::isfinite(entry));

  // The meter ignores its stretch, for any deformation.
  const StretchMeter meter(rest, none);
  Positions moved = mesh.positions;
  moved(4, 2) += 7;
  CHECK(meter.measure(moved)[2].largest == 1);
}

}  // namespace bendlab::bad_triangles_test
