#include "bendlab/mesh/quality.hpp"
#include "bendlab/io/without_traps.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "bendlab/mesh/generators.hpp"
#include "tests/catch.hpp"

namespace bendlab::quality_test {
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

MeshQuality quality_of(const Vector3& a, const Vector3& b, const Vector3& c,
                       const QualityThresholds& thresholds = {}) {
  Positions positions(3, 3);
  positions << a.transpose(), b.transpose(), c.transpose();
  return measure_quality(positions, Triangles{{0, 1, 2}}, thresholds);
}

// The value of a measure for a mesh with one triangle.
double value(const MeshQuality& quality, std::string_view name) {
  const auto measures = quality_measures();
  const auto at =
      std::find_if(measures.begin(), measures.end(), [&](const auto& m) { return m.name == name; });
  REQUIRE(at != measures.end());
  const MeasureSummary& summary = quality.measures[static_cast<std::size_t>(at - measures.begin())];
  CHECK(summary.minimum == summary.maximum);
  CHECK(summary.minimum == summary.median);
  return summary.median;
}

// A mesh of triangles that share no vertices.
struct Heap {
  Positions positions;
  Triangles triangles;

  void add(const Vector3& a, const Vector3& b, const Vector3& c) {
    const auto v = positions.rows(), t = triangles.rows();
    positions.conservativeResize(v + 3, 3);
    positions.bottomRows(3) << a.transpose(), b.transpose(), c.transpose();
    triangles.conservativeResize(t + 1, 3);
    triangles.row(t) << static_cast<int>(v), static_cast<int>(v + 1), static_cast<int>(v + 2);
  }
};

constexpr double rounding = 1e-14;  // relative: a dozen operations

}  // namespace

TEST_CASE("an equilateral triangle has the best value of every measure", "[mesh][quality]") {
  const MeshQuality q = quality_of({0, 0, 5}, {2, 0, 5}, {1, std::sqrt(3.0), 5});
  for (const char* name : {"edge_ratio", "aspect_ratio", "radius_ratio", "shape", "condition"})
    CHECK_THAT(value(q, name), WithinRel(1.0, rounding));
  CHECK_THAT(value(q, "minimum_angle"), WithinRel(60.0, rounding));
  CHECK_THAT(value(q, "maximum_angle"), WithinRel(60.0, rounding));
  CHECK(q.degenerate_triangles == 0);
  CHECK(q.small_angles == 0);
}

TEST_CASE("the measures of a 3-4-5 triangle agree with values by hand", "[mesh][quality]") {
  const MeshQuality q = quality_of({1, 1, 1}, {1, 4, 1}, {1, 1, 5});  // area 6, circumradius 5/2, inradius 1
  CHECK_THAT(value(q, "edge_ratio"), WithinRel(5.0 / 3, rounding));
  CHECK_THAT(value(q, "aspect_ratio"),
             WithinRel(5 / (2 * std::sqrt(3.0) * 1), rounding));  // longest / (2√3 inradius)
  CHECK_THAT(value(q, "radius_ratio"), WithinRel(1.25, rounding));
  CHECK_THAT(value(q, "shape"), WithinRel(24 * std::sqrt(3.0) / 50, rounding));
  CHECK_THAT(value(q, "minimum_angle"), WithinRel(36.86989764584402, rounding));  // atan(3/4)
  CHECK_THAT(value(q, "maximum_angle"), WithinRel(90.0, rounding));
}

TEST_CASE("condition is the condition number of Q weighted by the equilateral triangle", "[mesh][quality]") {
  std::mt19937_64 random(2);
  const auto coordinate = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  Eigen::Matrix2d equilateral;
  equilateral << 1, 0.5, 0, std::sqrt(3.0) / 2;
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::Matrix2d edges;
    edges << coordinate(), coordinate(), coordinate(), coordinate();
    const MeshQuality q = quality_of({0, 0, 0}, {edges(0, 0), edges(1, 0), 0}, {edges(0, 1), edges(1, 1), 0});
    const Eigen::Vector2d s =
        Eigen::JacobiSVD<Eigen::Matrix2d>(edges * equilateral.inverse()).singularValues();
    // The smaller singular value loses as many digits as the condition number has.
    CHECK_THAT(value(q, "condition"), WithinRel(s[0] / s[1], rounding * s[0] / s[1]));
    const double x = 1 / value(q, "shape");
    CHECK_THAT(x, WithinRel(0.5 * (s[0] / s[1] + s[1] / s[0]), rounding * s[0] / s[1]));
  }
}

TEST_CASE("percentiles are values at the nearest rank", "[mesh][quality]") {
  std::vector<int> ratios(201);
  for (int i = 0; i < 201; ++i) ratios[static_cast<std::size_t>(i)] = i + 1;
  std::shuffle(ratios.begin(), ratios.end(), std::mt19937(5));
  Heap heap;
  for (const int ratio : ratios)  // legs of `ratio` on a base of 1
    heap.add({-0.5, 0, 0}, {0.5, 0, 0}, {0, std::sqrt(ratio * ratio - 0.25), 0});
  const MeshQuality q = measure_quality(heap.positions, heap.triangles);
  const auto& [edge_ratio, aspect, radius, shape, smallest, largest, condition] = q.measures;
  CHECK_THAT(edge_ratio.minimum, WithinRel(1.0, rounding));
  CHECK_THAT(edge_ratio.percentile_1, WithinRel(3.0, rounding));  // rank 0.01 · 200 = 2, counted from 0
  CHECK_THAT(edge_ratio.median, WithinRel(101.0, rounding));
  CHECK_THAT(edge_ratio.percentile_99, WithinRel(199.0, rounding));
  CHECK_THAT(edge_ratio.maximum, WithinRel(201.0, rounding));
  const auto apex = [](double ratio) { return 2 * std::asin(0.5 / ratio) * 180 / std::acos(-1.0); };
  CHECK_THAT(smallest.minimum, WithinRel(apex(201), rounding));
  CHECK_THAT(smallest.percentile_1, WithinRel(apex(199), rounding));
  CHECK_THAT(smallest.percentile_99, WithinRel(apex(3), rounding));
  CHECK_THAT(smallest.maximum, WithinRel(60.0, rounding));
  CHECK_THAT(largest.maximum, WithinRel(90 - apex(201) / 2, rounding));
  CHECK(q.needles == 198);       // ratios 4 … 201
  CHECK(q.small_angles == 196);  // apex(5) = 11.5°, apex(6) = 9.6°
}

TEST_CASE("needles, caps and collinear triangles are counted", "[mesh][quality]") {
  struct Case {
    Vector3 apex;
    int needle, cap, collinear, small_angle;
  };
  const double flat = std::nextafter(2.0, 3.0) - 2;  // one unit in the last place
  for (const auto& [apex, needle, cap, collinear, small_angle] : {
           Case{{0.5, 0.8, 0}, 0, 0, 0, 0}, Case{{0, 0.24, 0}, 1, 0, 0, 0},  // right-angled, 13.5°
           Case{{0, 0.1, 0}, 1, 0, 0, 1}, Case{{0.5, 0.05, 0}, 0, 1, 0, 1},  // 168.6° at the apex, equal legs
           Case{{0.1, 0.01, 0}, 1, 1, 0, 1},                                 // needle and cap
           Case{{0.5, 0, 0}, 0, 1, 1, 1}, Case{{0.1, 0, 0}, 1, 1, 1, 1},
           Case{{0.5, flat, 0}, 0, 1, 0, 1},  // nearly collinear is not collinear
           Case{{0, 0, 0}, 1, 0, 1, 1},       // a zero edge makes a needle, not a cap
       }) {
    const MeshQuality q = quality_of({0, 0, 0}, {1, 0, 0}, apex);
    INFO("apex " << apex.transpose());
    CHECK(q.needles == needle);
    CHECK(q.caps == cap);
    CHECK(q.collinear == collinear);
    CHECK(q.small_angles == small_angle);
    CHECK(q.degenerate_triangles == (needle + cap + collinear > 0 ? 1 : 0));
    CHECK(q.non_finite == 0);
  }
  // Collinear, but along no axis. The result is exact although no difference of coordinates is a power of
  // two.
  CHECK(quality_of({0.1, 0.3, 0.7}, {0.2, 0.6, 1.4}, {0.4, 1.2, 2.8}).collinear == 1);
  CHECK(quality_of({0.1, 0.3, 0.7}, {0.2, 0.6, std::nextafter(1.4, 2.0)}, {0.4, 1.2, 2.8}).collinear == 0);
}

TEST_CASE("thresholds decide which triangles count as bad", "[mesh][quality]") {
  const Vector3 a(0, 0, 0), b(1, 0, 0), apex(0.5, 0.25, 0);  // 26.6° and 126.9°, edge ratio 1.79
  const auto counts = [&](const QualityThresholds& thresholds) {
    const MeshQuality q = quality_of(a, b, apex, thresholds);
    return std::array{q.needles, q.caps, q.small_angles};
  };
  CHECK(counts({}) == std::array{0, 0, 0});
  CHECK(counts({.needle_ratio = 1.78, .cap_angle = 126.8, .small_angle = 26.6}) == std::array{1, 1, 1});
  CHECK(counts({.needle_ratio = 1.80, .cap_angle = 127.0, .small_angle = 26.5}) == std::array{0, 0, 0});
  CHECK(counts({.needle_ratio = 1, .cap_angle = 180, .small_angle = 0}) == std::array{1, 0, 0});
}

TEST_CASE("triangles without area or finite positions have the worst values and no NaN", "[mesh][quality]") {
  const WithoutTraps infinities;  // on purpose
  const auto check_worst = [](const MeshQuality& q, double edge_ratio) {
    CHECK(value(q, "edge_ratio") == edge_ratio);
    for (const char* name : {"aspect_ratio", "radius_ratio", "condition"}) CHECK(value(q, name) == infinity);
    CHECK(value(q, "shape") == 0);
    CHECK(value(q, "minimum_angle") == 0);
    CHECK(value(q, "maximum_angle") == 180);
    CHECK(q.degenerate_triangles == 1);
  };
  check_worst(quality_of({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), 2);
  check_worst(quality_of({0, 0, 0}, {1, 0, 0}, {1, 0, 0}), infinity);
  check_worst(quality_of({3, 3, 3}, {3, 3, 3}, {3, 3, 3}), infinity);
  for (const double bad : {not_a_number, infinity, -infinity}) {
    const MeshQuality q = quality_of({0, 0, 0}, {1, 0, bad}, {0, 1, 0});
    check_worst(q, infinity);
    CHECK(q.non_finite == 1);
    CHECK(q.needles + q.caps + q.collinear == 0);
  }
  check_worst(quality_of({-1e308, 0, 0}, {1e308, 0, 0}, {0, 1e308, 0}),
              infinity);  // the difference overflows
  CHECK(measure_quality({}, {}).degenerate_triangles == 0);
}

TEST_CASE("quality does not depend on the unit of length", "[mesh][quality]") {
  const TriangleMesh mesh = delaunay(1, 1, 12, 3);
  const MeshQuality here = measure_quality(mesh.positions, mesh.triangles);
  for (const double unit :
       {0x1p-10, 0x1p10, 0x1p-900, 0x1p900}) {  // powers of two, so even rounding is the same
    const MeshQuality there = measure_quality(mesh.positions * unit, mesh.triangles);
    for (std::size_t m = 0; m < here.measures.size(); ++m) {
      CHECK(here.measures[m].minimum == there.measures[m].minimum);
      CHECK(here.measures[m].median == there.measures[m].median);
      CHECK(here.measures[m].maximum == there.measures[m].maximum);
    }
    CHECK(here.degenerate_triangles == there.degenerate_triangles);
  }
}

}  // namespace bendlab::quality_test
