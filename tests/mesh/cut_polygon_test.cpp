// Polygons of known area are cut into triangles, which keep the area and face the same side.
#include "bendlab/mesh/cut_polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "tests/catch.hpp"

namespace bendlab::cut_polygon_test {
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinRel;

namespace {

using Corners = std::vector<Vector3>;
using Numbers = std::vector<std::array<std::size_t, 3>>;

constexpr double thickness = 1e-7;  // for polygons of a size of about 1

Corners flat(std::initializer_list<std::array<double, 2>> list) {
  Corners corners;
  for (const auto& [x, y] : list) corners.emplace_back(x, y, 0);
  return corners;
}

const Corners dart = flat({{0, 0}, {2, 1}, {0, 2}, {0.5, 1}});
const Corners ell = flat({{2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}, {0, 0}});

Numbers fan(std::size_t corners) {
  Numbers triangles;
  for (std::size_t c = 2; c < corners; ++c) triangles.push_back({0, c - 1, c});
  return triangles;
}

Numbers cut(const Corners& corners) {
  Numbers triangles;
  cut_polygon(corners, thickness, triangles);
  return triangles.empty() ? fan(corners.size()) : triangles;
}

Vector3 area_vector(const Corners& p, const std::array<std::size_t, 3>& t) {
  return 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
}

// Cuts a flat polygon with the normal `up`. Checks that all triangles face upwards, are larger than `least`
// m², use every corner, and together have the area of the polygon.
void check_cut(const Corners& corners, double area, const Vector3& up = Vector3::UnitZ(), double least = 0) {
  const Numbers triangles = cut(corners);
  REQUIRE(triangles.size() == corners.size() - 2);
  double sum = 0;
  std::vector<char> used(corners.size(), 0);
  for (const auto& t : triangles) {
    CHECK(area_vector(corners, t).dot(up) > least);
    sum += area_vector(corners, t).norm();
    for (const std::size_t c : t) used[c] = 1;
  }
  CHECK_THAT(sum, WithinRel(area, 1e-12));  // rounding of a few hundred additions
  CHECK(std::ranges::count(used, 0) == 0);
}

// The area of a simple polygon in the plane z = 0.
double shoelace(const Corners& p) {
  double sum = 0;
  for (std::size_t c = 0; c < p.size(); ++c) {
    const Vector3 &a = p[c], &b = p[(c + 1) % p.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(sum) / 2;
}

// Checks the polygon with every corner as its first, in both directions.
void check_all_turns(Corners corners, double area, double least = 0) {
  for (std::size_t turn = 0; turn < corners.size(); ++turn) {
    INFO("first corner " << turn);
    check_cut(corners, area, Vector3::UnitZ(), least);
    const Corners reversed(corners.rbegin(), corners.rend());
    check_cut(reversed, area, -Vector3::UnitZ(), least);
    std::ranges::rotate(corners, corners.begin() + 1);
  }
}

}  // namespace

TEST_CASE("concave polygons keep their area for every first corner", "[mesh][polygons]") {
  check_all_turns(dart, 1.5);
  check_all_turns(ell, 3);
  check_all_turns(flat({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}), 7);  // a U
  Corners comb = {{0, -1, 0}};  // ten teeth of area 1/2 on a bar of 10 × 1
  comb.emplace_back(10, -1, 0);
  for (int tooth = 10; tooth > 0; --tooth)
    comb.emplace_back(tooth, 0, 0), comb.emplace_back(tooth - 0.5, 1, 0);
  comb.emplace_back(0, 0, 0);
  check_all_turns(comb, 15);
}

TEST_CASE("a convex polygon is a fan around its first corner", "[mesh][polygons]") {
  Corners corners;
  for (int c = 0; c < 300; ++c) corners.emplace_back(std::cos(c * 0.02), std::sin(c * 0.02), 0);
  CHECK(cut(corners) == fan(300));
  CHECK(cut(flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}})) == fan(4));
  // Concave, but all of it is visible from its first corner.
  CHECK(cut({dart[3], dart[0], dart[1], dart[2]}) == fan(4));
  // The number of corners has no limit if the polygon is a fan, although these triangles are thin.
  corners.clear();
  for (int c = 0; c < 20000; ++c) corners.emplace_back(std::cos(c * 3e-4), std::sin(c * 3e-4), 0);
  CHECK_NOTHROW(cut(corners));
}

TEST_CASE("a corner on a straight edge gives no triangle without area", "[mesh][polygons]") {
  check_all_turns(flat({{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}}), 1, 0.01);
  check_all_turns(flat({{0, 0}, {0.25, 0}, {0.5, 0}, {0.75, 0}, {1, 0}, {1, 1}, {0, 1}}), 1, 0.01);
  check_all_turns(flat({{0, 0}, {0.5, 0}, {1, 0}, {0.5, 0.5}, {0, 1}, {0, 0.5}}), 0.5, 0.01);
}

TEST_CASE("polygons of any shape and direction keep their area", "[mesh][polygons]") {
  std::mt19937_64 random(1);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int trial = 0; trial < 200; ++trial) {
    INFO("trial " << trial);
    const std::size_t count = 4 + random() % 40;
    Corners corners;  // a star around the origin
    for (std::size_t c = 0; c < count; ++c) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(c) / static_cast<double>(count),
                   radius = 0.05 + uniform();
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    const double area = shoelace(corners);
    std::ranges::rotate(corners, corners.begin() + static_cast<std::ptrdiff_t>(random() % count));
    const Eigen::Quaterniond turn = Eigen::Quaterniond(uniform(), uniform(), uniform(), 1).normalized();
    for (Vector3& p : corners) p = turn * p + Vector3(7, -8, 9);
    check_cut(corners, area, turn * Vector3::UnitZ());
  }
}

TEST_CASE("a spiral of two turns keeps its area", "[mesh][polygons]") {
  Corners out, in;
  for (int c = 0; c <= 80; ++c) {
    const double angle = 4 * std::numbers::pi * c / 80, radius = 1 + 0.1 * angle;
    out.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    in.emplace_back((radius - 0.3) * std::cos(angle), (radius - 0.3) * std::sin(angle), 0);
  }
  Corners spiral = out;
  spiral.insert(spiral.end(), in.rbegin(), in.rend());
  check_all_turns(spiral, shoelace(spiral));
}

TEST_CASE("a face with a hole that a bridge joins to the rim keeps its area", "[mesh][polygons]") {
  check_all_turns(flat({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}}), 8);
}

TEST_CASE("a polygon that is not flat is cut like its projection along the normal", "[mesh][polygons]") {
  // A dart with two tips bent up. Its projection is the flat dart.
  Corners bent = dart;
  bent[0].z() = bent[2].z() = 0.5;
  for (int turn = 0; turn < 4; ++turn) {
    double shadow = 0;
    for (const auto& t : cut(bent)) {
      CHECK(area_vector(bent, t).z() > 0);
      shadow += area_vector(bent, t).z();
    }
    CHECK_THAT(shadow, WithinRel(1.5, 1e-14));
    std::ranges::rotate(bent, bent.begin() + 1);
  }
  CHECK(cut({{0, 0, 0}, {1, 0, 0.2}, {1, 1, 0}, {0, 1, 0.2}}) == fan(4));  // a saddle
}

TEST_CASE("a polygon without area stays a fan, whose bad triangles are found later", "[mesh][polygons]") {
  CHECK(cut(flat({{0, 0}, {1, 0}, {2, 0}, {3, 0}})) == fan(4));
  CHECK(cut(flat({{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}})) == fan(5));
  // A repeated corner: one triangle has no area, and the other triangles have the whole area.
  const Numbers triangles = cut(flat({{0, 0}, {2, 1}, {2, 1}, {0, 2}, {0.5, 1}}));
  double area = 0;
  for (const auto& t : triangles)
    area += area_vector(flat({{0, 0}, {2, 1}, {2, 1}, {0, 2}, {0.5, 1}}), t).z();
  CHECK_THAT(area, WithinRel(1.5, 1e-14));
}

TEST_CASE("a polygon that cannot be cut is refused", "[mesh][polygons]") {
  const auto refused = [](const Corners& corners, const std::string& part) {
    CHECK_THROWS_WITH(cut(corners), ContainsSubstring(part));
  };
  refused(flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), "crosses itself");  // two equal halves, so no normal
  refused(flat({{0, 0}, {3, 3}, {3, 0}, {0, 1}}), "crosses itself");
  Corners pentagram;
  for (int c = 0; c < 5; ++c)
    pentagram.emplace_back(std::cos(0.8 * std::numbers::pi * c), std::sin(0.8 * std::numbers::pi * c), 0);
  refused(pentagram, "crosses itself");
  Corners zigzag = {{0, -1, 0}};
  for (int c = 0; c < 10000; ++c) zigzag.emplace_back(-c, c % 2, 0);
  refused(zigzag, "10001 corners");
}

}  // namespace bendlab::cut_polygon_test
