#include "bendlab/mesh/quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "bendlab/mesh/collinear.hpp"

namespace bendlab {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr std::array<QualityMeasure, 7> measures = {{
    {"edge_ratio", "1", "Longest to shortest edge"},
    {"aspect_ratio", "1", "Longest edge times perimeter over 4√3 area"},
    {"radius_ratio", "1", "Circumradius over twice the inradius"},
    {"shape", "1", "4√3 area over the sum of squared edges (1: equilateral, 0: no area)"},
    {"minimum_angle", "degrees", "Smallest angle"},
    {"maximum_angle", "degrees", "Largest angle"},
    {"condition", "1", "Condition number of Q, weighted by the equilateral triangle"},
}};

// A triangle's squared edge lengths, ascending, twice its area, and the scalar products of the two edges at
// the corners with the smallest and the largest angle; scaled so that nothing over- or underflows.
struct ScaledTriangle {
  std::array<double, 3> squared;
  double twice_area, dot_at_smallest, dot_at_largest;
  bool finite;

  ScaledTriangle(const Vector3& a, const Vector3& b, const Vector3& c) {
    Vector3 ab = b - a, bc = c - b, ca = a - c;  // all three from the corners: no cancellation in a short one
    const double scale = (ab.cwiseAbs() + bc.cwiseAbs() + ca.cwiseAbs()).sum();
    finite = std::isfinite(scale);
    if (finite && scale > 0) ab /= scale, bc /= scale, ca /= scale;
    squared = {ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()};
    twice_area = ab.cross(bc).norm();
    std::tie(dot_at_largest, dot_at_smallest) = std::minmax({-ca.dot(ab), -ab.dot(bc), -bc.dot(ca)});
    if (squared[0] > squared[1]) std::swap(squared[0], squared[1]);
    if (squared[1] > squared[2]) std::swap(squared[1], squared[2]);
    if (squared[0] > squared[1]) std::swap(squared[0], squared[1]);
  }

  bool has_area() const { return finite && squared[0] > 0 && twice_area > 0; }
};

double cotangent(double degrees) {
  return 1 / std::tan(degrees * std::numbers::pi / 180);
}

// What percentiles are taken of, in the order of `measures`: monotone in the measure and cheaper. The edge
// ratio is squared; an angle is its negative cotangent.
using Keys = std::array<double, 7>;

Keys keys_of(const ScaledTriangle& t) {
  if (!t.finite) return {infinity, infinity, infinity, 0, -infinity, infinity, infinity};
  const double edge_ratio = t.squared[0] > 0 ? t.squared[2] / t.squared[0] : infinity;
  if (!t.has_area()) return {edge_ratio, infinity, infinity, 0, -infinity, infinity, infinity};

  const auto& [a, b, c] = t.squared;
  const double perimeter = std::sqrt(a) + std::sqrt(b) + std::sqrt(c), sum = a + b + c;
  const double equilateral = 2 * std::numbers::sqrt3 * t.twice_area;  // 4√3 A
  // √((a + b + c)² - 48 A²), the difference written as squares: it loses no digits near the equilateral
  // triangle.
  const double distortion = std::sqrt(2 * ((a - b) * (a - b) + (b - c) * (b - c) + (c - a) * (c - a)));
  return {edge_ratio,
          std::sqrt(c) * perimeter / equilateral,
          std::sqrt(a * b * c) * perimeter / (4 * t.twice_area * t.twice_area),
          equilateral / sum,
          -t.dot_at_smallest / t.twice_area,
          -t.dot_at_largest / t.twice_area,
          (sum + distortion) / equilateral};
}

double measure_from_key(std::size_t measure, double key) {
  switch (measure) {
    case 0:
      return std::sqrt(key);
    case 4:
    case 5:
      return std::atan2(1.0, -key) * 180 / std::numbers::pi;
    default:
      return key;
  }
}

MeasureSummary summarise(std::size_t measure, std::vector<double>& keys) {
  const std::size_t last = keys.size() - 1;
  const auto low = static_cast<std::size_t>(std::llround(0.01 * static_cast<double>(last)));
  const std::size_t high = last - low;
  const auto [minimum, maximum] = std::minmax_element(keys.begin(), keys.end());
  MeasureSummary summary{*minimum, 0, 0, 0, *maximum};
  const auto select = [&](std::size_t from, std::size_t rank, std::size_t to) {  // in keys[from .. to]
    const auto at = [&](std::size_t r) { return keys.begin() + static_cast<std::ptrdiff_t>(r); };
    std::nth_element(at(from), at(rank), at(to + 1));
    return keys[rank];
  };
  summary.percentile_1 = select(0, low, last);
  summary.percentile_99 = select(low, high, last);
  summary.median = select(low, last / 2, high);
  for (double* value :
       {&summary.minimum, &summary.percentile_1, &summary.median, &summary.percentile_99, &summary.maximum})
    *value = measure_from_key(measure, *value);
  return summary;
}

}  // namespace

std::span<const QualityMeasure> quality_measures() {
  return measures;
}

MeshQuality measure_quality(const Positions& positions, const Triangles& triangles,
                            const QualityThresholds& thresholds) {
  MeshQuality quality;
  if (triangles.rows() == 0) return quality;

  // Rounding moves the scaled area of collinear points by a few 10⁻¹⁶; only below this the exact predicate is
  // asked.
  constexpr double surely_not_collinear = 1e-14;
  const double cap_key = -cotangent(thresholds.cap_angle), small_key = -cotangent(thresholds.small_angle);
  std::array<std::vector<double>, 7> keys;
  for (auto& column : keys) column.resize(static_cast<std::size_t>(triangles.rows()));

  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const Vector3 p = positions.row(triangles(t, 0)), q = positions.row(triangles(t, 1)),
                  r = positions.row(triangles(t, 2));
    const ScaledTriangle scaled(p, q, r);
    const Keys key = keys_of(scaled);
    for (std::size_t m = 0; m < key.size(); ++m) keys[m][static_cast<std::size_t>(t)] = key[m];

    const auto& [shortest, middle, longest] = scaled.squared;
    const bool needle =
        scaled.finite && longest >= thresholds.needle_ratio * thresholds.needle_ratio * shortest;
    const bool cap = scaled.finite && shortest > 0 && key[5] >= cap_key;
    const bool collinear =
        scaled.finite && !(scaled.twice_area > surely_not_collinear * longest) && exactly_collinear(p, q, r);
    quality.needles += needle;
    quality.caps += cap;
    quality.collinear += collinear;
    quality.non_finite += !scaled.finite;
    quality.small_angles += key[4] < small_key;
    quality.degenerate_triangles += needle || cap || collinear || !scaled.finite;
  }
  for (std::size_t m = 0; m < keys.size(); ++m) quality.measures[m] = summarise(m, keys[m]);
  return quality;
}

}  // namespace bendlab
