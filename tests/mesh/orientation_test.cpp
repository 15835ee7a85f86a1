// In meshes with randomly turned triangles, all triangles are turned to the same side again.
#include "bendlab/mesh/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::orientation_test {
namespace {

// A band with half a turn in it, `across` cells wide.
PolygonSoup moebius(int around, int across, double width) {
  PolygonSoup soup;
  const int row = across + 1;
  for (int i = 0; i < around; ++i) {
    const double turn = 2 * std::numbers::pi * i / around;
    for (int j = 0; j < row; ++j) {
      const double side = width * (1.0 * j / across - 0.5), radius = 0.5 + side * std::cos(turn / 2);
      soup.points.push_back({radius * std::cos(turn), radius * std::sin(turn), side * std::sin(turn / 2)});
    }
  }
  const auto vertex = [&](int i, int j) { return i < around ? row * i + j : across - j; };
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const std::int64_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                         d = vertex(i, j + 1);
      soup.triangles.push_back({a, b, c});
      soup.triangles.push_back({a, c, d});
    }
  return soup;
}

}  // namespace

TEST_CASE("exactly the triangles that were turned over are turned back", "[mesh][orientation]") {
  std::mt19937_64 random(3);
  for (const TriangleMesh& mesh : {delaunay(1, 1, 12, 5), tube(0.3, 0.3, 1, 14), sphere(1, 3)}) {
    PolygonSoup soup = to_soup(mesh);
    CHECK(std::ranges::count(orientation_of(soup).turned, 1) == 0);
    std::vector<char> turned(soup.triangles.size(), 0);
    for (std::size_t t = 0; t < turned.size(); ++t)
      if (random() % 3 == 0) turned[t] = 1, std::swap(soup.triangles[t][1], soup.triangles[t][2]);
    const Orientation orientation = orientation_of(soup);
    CHECK(orientation.turned == turned);
    CHECK(orientation.seams == 0);
    CHECK(std::ranges::all_of(orientation.edges, &SharedEdge::alike));
  }
}

TEST_CASE(
    "pieces are turned independently, and if both sides have equally many triangles the first one stays",
    "[mesh][orientation]") {
  const PolygonSoup soup{
      .points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}},
      .triangles = {{0, 1, 2}, {0, 3, 2}, {4, 6, 5}}};
  CHECK(orientation_of(soup).turned == std::vector<char>{0, 1, 0});
}

TEST_CASE("the seam of a Möbius band runs across the band", "[mesh][orientation]") {
  for (const int across : {1, 3, 6})
    for (const int around : {20, 60}) {
      INFO(across << " by " << around);
      const Orientation orientation = orientation_of(moebius(around, across, 0.3));
      CHECK(orientation.seams >= static_cast<std::size_t>(across));
      // A seam along the band would have as many edges as cells around. Where shortest paths in both
      // directions meet, the seam may follow a row.
      CHECK(orientation.seams <= static_cast<std::size_t>(2 * across + 1));
    }
}

}  // namespace bendlab::orientation_test
