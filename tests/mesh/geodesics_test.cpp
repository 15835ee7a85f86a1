#include "bendlab/mesh/geodesics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::geodesics_test {
namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

}  // namespace

TEST_CASE("on a flat convex sheet geodesics are straight lines", "[mesh]") {
  for (const TriangleMesh& mesh :
       {grid(2, 1, 20, 10), grid(1, 1, 9, 9, Diagonal::both), delaunay(1, 1, 20, 3), disc(0.5, 8)}) {
    const RestMesh rest(mesh);
    for (const int source : {0, rest.vertex_count() / 2}) {
      const GeodesicDistances geodesic = geodesic_distances(rest, std::array{source});
      for (int v = 0; v < rest.vertex_count(); ++v) {
        // About twenty unfoldings, each a difference of squares. At worst half of the digits are lost.
        CHECK_THAT(geodesic.distance[static_cast<std::size_t>(v)],
                   WithinAbs((rest.position(v) - rest.position(source)).norm(), 1e-9));
        CHECK(geodesic.source[static_cast<std::size_t>(v)] == source);
      }
    }
  }
}

TEST_CASE("with a row of sources the geodesic is the straight line to the nearest source", "[mesh]") {
  // Vertices in the middle between two sources are equally near to both. Below a row of pins there are many.
  for (const TriangleMesh& mesh :
       {equilateral(1, 1, 16), grid(1, 1, 12, 12, Diagonal::both), delaunay(1, 1, 20, 3)}) {
    const RestMesh rest(mesh);
    std::vector<int> sources;
    for (int v = 0; v < rest.vertex_count(); ++v)
      if (rest.position(v).y() > rest.box_max().y() - 1e-9) sources.push_back(v);
    REQUIRE(sources.size() > 10);
    const GeodesicDistances geodesic = geodesic_distances(rest, sources);
    for (int v = 0; v < rest.vertex_count(); ++v) {
      // The sides of a lattice zigzag, so ways are longer there.
      if (std::abs(rest.position(v).x()) > 0.35) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (const int source : sources)
        nearest = std::min(nearest, (rest.position(v) - rest.position(source)).norm());
      // A vertex keeps only eight sources. A straight path may need further sources of a vertex beside it.
      CHECK_THAT(geodesic.distance[static_cast<std::size_t>(v)], WithinAbs(nearest, 1e-4));
    }
  }
}

TEST_CASE("far from a full row of sources, geodesics are too long by at most two thousandths", "[mesh]") {
  const RestMesh rest(delaunay(1, 1, 128, 3));
  std::vector<int> sources;
  for (int v = 0; v < rest.vertex_count(); ++v)
    if (rest.position(v).y() > rest.box_max().y() - 1e-9) sources.push_back(v);
  REQUIRE(sources.size() > 100);
  const GeodesicDistances geodesic = geodesic_distances(rest, sources);
  for (int v = 0; v < rest.vertex_count(); ++v) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const int source : sources)
      nearest = std::min(nearest, (rest.position(v) - rest.position(source)).norm());
    CHECK(geodesic.distance[static_cast<std::size_t>(v)] >= nearest * (1 - 1e-12));
    CHECK(geodesic.distance[static_cast<std::size_t>(v)] <= nearest * 1.002);
  }
}

TEST_CASE("geodesics do not change when the sheet is rolled up", "[mesh]") {
  // Folds at the lines between cells do not change triangles, nor the lengths of ways across them.
  TriangleMesh mesh = grid(1, 1, 16, 16);
  const RestMesh flat(mesh);
  const double turn = 0.4, step = 1.0 / 16;
  std::vector<Vector2> profile{{0, 0}};
  for (int i = 0; i < 16; ++i)
    profile.push_back(profile.back() + step * Vector2(std::cos(turn * i), std::sin(turn * i)));
  for (int v = 0; v < flat.vertex_count(); ++v) {
    const auto column =
        static_cast<std::size_t>(std::lround((flat.position(v).x() - flat.box_min().x()) / step));
    mesh.positions.row(v) << profile[column].x(), flat.position(v).y(), profile[column].y();
  }
  const RestMesh rolled(mesh);
  const GeodesicDistances geodesic = geodesic_distances(rolled, std::array{0});
  for (int v = 0; v < flat.vertex_count(); ++v)
    CHECK_THAT(geodesic.distance[static_cast<std::size_t>(v)],
               WithinAbs((flat.position(v) - flat.position(0)).norm(), 1e-9));
}

TEST_CASE("geodesics on a sphere approach great circles", "[mesh]") {
  // A disc of radius π/2 is wrapped over a half sphere. Geodesics from the pole run along meridians, and are
  // π/2 long at the rim.
  double last = 1;
  for (const int rings : {6, 12, 24}) {
    TriangleMesh mesh = disc(std::numbers::pi / 2, rings);
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
      const double from_pole = mesh.positions.row(v).norm(),
                   turn = std::atan2(mesh.positions(v, 1), mesh.positions(v, 0));
      mesh.positions.row(v) << std::sin(from_pole) * std::cos(turn), std::sin(from_pole) * std::sin(turn),
          std::cos(from_pole);
    }
    const RestMesh rest(mesh);
    const GeodesicDistances geodesic = geodesic_distances(rest, std::array{0});
    double worst = 0;
    for (int v = 1; v < rest.vertex_count(); ++v)
      worst = std::max(
          worst,
          std::abs(geodesic.distance[static_cast<std::size_t>(v)] / std::acos(rest.position(v).z()) - 1));
    CHECK(worst < last / 1.9);  // of first order: half the error with edges half as long
    last = worst;
  }
  CHECK(last < 0.003);
}

TEST_CASE("geodesics go around corners, start at the nearest source, and stay within a connected part",
          "[mesh]") {
  // An L of three cells. The way from the tip of one arm to the tip of the other arm goes around the inner
  // corner.
  TriangleMesh mesh;
  mesh.positions.resize(9, 3);
  mesh.positions << 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 0, 2, 0, 1, 2, 0, 5, 5, 0;
  mesh.triangles.resize(6, 3);
  mesh.triangles << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 7, 3, 7, 6;
  const RestMesh rest(mesh);
  const GeodesicDistances from_tip = geodesic_distances(rest, std::array{5});
  CHECK_THAT(from_tip.distance[7], WithinRel(2.0, 1e-12));    // (2,1) → (1,1) → (1,2)
  CHECK(from_tip.distance[6] >= 1 + std::sqrt(2.0) - 1e-12);  // (2,1) → (1,1) → (0,2), never too short;
  CHECK(from_tip.distance[6] <= 1.1 * (1 + std::sqrt(2.0)));  // the way along edges would be 3
  CHECK_THAT(from_tip.distance[0], WithinRel(std::sqrt(5.0), 1e-12));  // straight
  CHECK(from_tip.distance[8] == std::numeric_limits<double>::infinity());
  CHECK(from_tip.source[8] == -1);
  const GeodesicDistances from_tips = geodesic_distances(rest, std::array{5, 6});
  CHECK(from_tips.source[7] == 6);
  CHECK(from_tips.source[2] == 5);
}

TEST_CASE("the computation of geodesics ends on a mesh with a triangle without height", "[mesh]") {
  // Found by a fuzzer: the paths from 5 to 1, 2 and 3 went around 0, 5, 6 and got shorter without end.
  const RestMesh rest(
      {(Positions(7, 3) << 1, 0, 0, 0.5, 0.5, 0, 0, 0.5, 0, 0.5, 1, 0, 0.5, 0.5, 1, 1, 0.5, 0, 1, 1, 0)
           .finished(),
       (Triangles(6, 3) << 0, 1, 2, 0, 1, 3, 0, 3, 4, 0, 4, 5, 0, 5, 6, 1, 6, 3).finished(),
       {}});
  const GeodesicDistances geodesic = geodesic_distances(rest, std::array{0, 1, 2, 3, 4, 5, 6});
  for (const double distance : geodesic.distance) CHECK(distance == 0);
}

TEST_CASE("the computation of geodesics is quick on triangles without height", "[mesh]") {
  // Found by a fuzzer: paths around such triangles got shorter by a little, more than 10⁷ times.
  std::mt19937_64 random(1);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<std::uint64_t>(n)); };
  for (int sample = 0; sample < 200; ++sample) {
    constexpr int vertices = 10;
    Positions at(vertices, 3);
    for (int v = 0; v < vertices; ++v) at.row(v) << 0.37 * below(4), v < 7 ? 0 : 0.63 * below(3), 0;
    Triangles triangles(14, 3);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      const int a = below(vertices), b = (a + 1 + below(4)) % vertices, c = (b + 1 + below(4)) % vertices;
      triangles.row(t) << a, b, c;
    }
    const RestMesh rest({at, triangles, {}});
    // Ways along edges are never shorter.
    std::vector<double> along(vertices, std::numeric_limits<double>::infinity());
    along[0] = 0;
    for (int round = 0; round < vertices; ++round)
      for (int v = 0; v < vertices; ++v)
        for (const int w : rest.one_ring()[static_cast<std::size_t>(v)])
          along[static_cast<std::size_t>(w)] =
              std::min(along[static_cast<std::size_t>(w)],
                       along[static_cast<std::size_t>(v)] + (at.row(v) - at.row(w)).norm());
    const GeodesicDistances geodesic = geodesic_distances(rest, std::array{0});
    for (std::size_t v = 0; v < vertices; ++v)
      if (std::isfinite(along[v])) CHECK(geodesic.distance[v] <= along[v] * (1 + 1e-9));
  }
}

TEST_CASE("a geodesic disc holds the vertices nearer than its radius, also when discs follow each other",
          "[mesh]") {
  for (const TriangleMesh& mesh : {grid(1, 1, 9, 9, Diagonal::both), delaunay(1, 1, 20, 3)}) {
    const RestMesh rest(mesh);
    GeodesicDiscs discs(rest);
    for (const int centre : {0, rest.vertex_count() / 2, 3}) {
      const GeodesicDistances all = geodesic_distances(rest, std::array{centre});
      const std::vector<GeodesicDiscs::Member> disc = discs.around(centre, 0.3);
      CHECK(disc.front().vertex == centre);
      CHECK(disc.size() ==
            static_cast<std::size_t>(std::ranges::count_if(all.distance, [](double d) { return d < 0.3; })));
      for (const GeodesicDiscs::Member& member : disc)
        CHECK(member.distance == all.distance[static_cast<std::size_t>(member.vertex)]);
    }
  }
}

}  // namespace bendlab::geodesics_test
