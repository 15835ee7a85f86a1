// Gaps between vertices, triangles and edges, overlapping boxes, and self-intersections of a surface.
#include "bendlab/mesh/proximity.hpp"

#include <random>
#include <set>

#include "bendlab/mesh/box_tree.hpp"
#include "bendlab/mesh/generators.hpp"
#include "bendlab/mesh/self_intersections.hpp"
#include "tests/catch.hpp"

namespace bendlab::proximity_test {
namespace {

using Catch::Matchers::WithinAbs;

constexpr double rounding = 1e-12;  // for coordinates of size 1, after one or two quotients

double uniform(std::mt19937_64& random) {
  return 2 * static_cast<double>(random() >> 11) * 0x1p-53 - 1;
}

Vector3 anywhere(std::mt19937_64& random) {
  return {uniform(random), uniform(random), uniform(random)};
}

// The shortest gap between points of fine lattices on both elements.
double sampled_distance(Pairing pairing, const Corners& x, int parts) {
  double least = 1e300;
  for (int i = 0; i <= parts; ++i)
    for (int j = 0; j <= parts; ++j) {
      const double s = static_cast<double>(i) / parts, t = static_cast<double>(j) / parts;
      if (pairing == Pairing::edge_edge)
        least = std::min(least, (x[0] + s * (x[1] - x[0]) - x[2] - t * (x[3] - x[2])).norm());
      else if (s + t <= 1)
        least = std::min(least, (x[0] - x[1] - s * (x[2] - x[1]) - t * (x[3] - x[1])).norm());
    }
  return least;
}

}  // namespace

TEST_CASE("known gaps are right", "[mesh][proximity]") {
  using enum Pairing;
  const Vector3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0);
  const auto length = [](Pairing pairing, const Corners& corners) {
    return shortest_gap(pairing, corners).vector.norm();
  };
  // A vertex below the inside of the triangle, beside an edge, and beside a corner.
  CHECK_THAT(length(vertex_triangle, {Vector3(0.2, 0.3, -2), o, x, y}), WithinAbs(2, rounding));
  CHECK_THAT(length(vertex_triangle, {Vector3(0.5, -3, 4), o, x, y}), WithinAbs(5, rounding));
  CHECK_THAT(length(vertex_triangle, {Vector3(-2, -3, 6), o, x, y}), WithinAbs(7, rounding));
  CHECK_THAT(length(vertex_triangle, {Vector3(1, 1, 0), o, o, o}), WithinAbs(std::sqrt(2), rounding));
  CHECK_THAT(length(edge_edge, {o, x, Vector3(0.5, -1, 3), Vector3(0.5, 1, 3)}), WithinAbs(3, rounding));
  CHECK_THAT(length(edge_edge, {o, x, Vector3(4, 4, 0), Vector3(9, 4, 0)}),
             WithinAbs(5, rounding));  // parallel
  CHECK_THAT(length(edge_edge, {o, o, Vector3(-1, 2, 0), Vector3(1, 2, 0)}), WithinAbs(2, rounding));
}

TEST_CASE("no two points of the two elements are nearer than the gap", "[mesh][proximity]") {
  std::mt19937_64 random(3);
  constexpr int parts = 60;
  for (const Pairing pairing : {Pairing::vertex_triangle, Pairing::edge_edge})
    for (int trial = 0; trial < 300; ++trial) {
      Corners x;
      for (Vector3& corner : x) corner = anywhere(random);
      if (trial % 3 == 0) x[3] = x[2] + (trial % 2 == 0 ? 1e-9 : 0.0) * x[3] + 0.5 * (x[1] - x[0]);
      const Gap gap = shortest_gap(pairing, x);
      const double sampled = sampled_distance(pairing, x, parts);
      CHECK(gap.vector.norm() <= sampled + rounding);
      CHECK(gap.vector.norm() >=
            sampled - 4.0 / parts);  // the lattice is off by at most half a step of each edge (2√3 long)
      Vector3 vector = Vector3::Zero();
      double first = 0, second = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        vector += gap.weight[i] * x[i];
        (i < (pairing == Pairing::edge_edge ? 2u : 1u) ? first : second) += gap.weight[i];
      }
      CHECK((vector - gap.vector).norm() <= rounding);
      CHECK_THAT(first, WithinAbs(1, rounding));
      CHECK_THAT(second, WithinAbs(-1, rounding));
    }
}

TEST_CASE("a vertex or edge that passes through is detected, and one that passes by is not",
          "[mesh][proximity]") {
  const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), up(0, 0, 1);
  const auto met = [&](const Vector3& from, const Vector3& to) {
    return first_contact(Pairing::vertex_triangle, {from, a, b, c}, {to, a, b, c}, 1e-4);
  };
  const Vector3 inside(0.3, 0.3, 0), outside(0.6, 0.6, 0);
  const auto hit = met(inside + up, inside - up);
  REQUIRE(hit.has_value());
  CHECK(hit->vector.z() > 0);         // still on its own side
  CHECK(hit->vector.norm() <= 1e-4);  // as documented
  CHECK_FALSE(met(inside + up, inside + 0.01 * up).has_value());
  CHECK_FALSE(met(outside + up, outside - up).has_value());
  // No hit if both move together, even at high speed.
  const Vector3 far(1e3, -2e3, 5e2);
  CHECK_FALSE(first_contact(Pairing::vertex_triangle, {inside + up, a, b, c},
                            {inside + up + far, a + far, b + far, c + far}, 1e-4)
                  .has_value());
  // Edges that cross each other, and edges that pass beside each other.
  const Vector3 along(0.5, -1, 1), across(0.5, 1, 1), beside(1, 0, 0);
  const auto crossed = [&](const Vector3& shift) {
    return first_contact(Pairing::edge_edge, {a, b, along + shift, across + shift},
                         {a, b, along + shift - 2 * up, across + shift - 2 * up}, 1e-4)
        .has_value();
  };
  CHECK(crossed(Vector3::Zero()));
  CHECK_FALSE(crossed(beside));
}

TEST_CASE("the tree lists each overlapping pair of boxes once, and no other pair", "[mesh][proximity]") {
  std::mt19937_64 random(8);
  for (const int count : {0, 1, 2, 3, 17, 64, 200}) {
    Positions centres(count, 3);
    std::vector<Box> boxes(static_cast<std::size_t>(count));
    for (int b = 0; b < count; ++b) {
      centres.row(b) = anywhere(random).transpose();
      Box& box = boxes[static_cast<std::size_t>(b)];
      const Vector3 at = anywhere(random), half = 0.2 * anywhere(random).cwiseAbs();
      box.low << (at - half).cast<float>().array(), 0;
      box.high << (at + half).cast<float>().array(), 0;
    }
    BoxTree tree(centres);
    tree.renew(boxes);
    std::vector<std::pair<int, int>> overlaps, expected;
    tree.for_overlaps([&](int i, int j) { overlaps.emplace_back(std::min(i, j), std::max(i, j)); });
    std::ranges::sort(overlaps);
    for (int i = 0; i < count; ++i)
      for (int j = i + 1; j < count; ++j) {
        const Box &p = boxes[static_cast<std::size_t>(i)], &q = boxes[static_cast<std::size_t>(j)];
        bool overlap = true;
        for (Eigen::Index k = 0; k < 3; ++k) overlap &= p.low(k) <= q.high(k) && q.low(k) <= p.high(k);
        if (overlap) expected.emplace_back(i, j);
      }
    CHECK(overlaps == expected);
  }
}

TEST_CASE("self-intersections are pairs of triangles that cross", "[mesh][proximity]") {
  const TriangleMesh flat = grid(1, 1, 4, 4);
  CHECK(self_intersections(flat.positions, flat.triangles).empty());  // neighbouring triangles only touch
  Positions two(6, 3);
  two << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, -1, 0.2, 0.2, 1, 3, 3, 0;
  const Triangles triangles{{0, 1, 2}, {3, 4, 5}};
  CHECK(self_intersections(two, triangles) == std::vector<std::array<int, 2>>{{0, 1}});
  two.row(4) << 0.2, 0.2, -0.1;
  CHECK(self_intersections(two, triangles).empty());
  two(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(self_intersections(two, triangles), std::invalid_argument);
}

}  // namespace bendlab::proximity_test
