#include "bendlab/mesh/quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "bendlab/mesh/collinear.hpp"

namespace bendlab {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

constexpr std::array<QualityMeasure, 7> measures = {{
    {"edge_ratio", "1", "Longest edge divided by shortest edge"},
    {"aspect_ratio", "1", "Longest edge times perimeter, divided by 4√3 times the area"},
    {"radius_ratio", "1", "Circumradius divided by twice the inradius"},
    {"shape", "1",
     "4√3 times the area, divided by the sum of the squared edge lengths (1: equilateral, 0: "
     "no area)"},
    {"minimum_angle", "degrees", "Smallest angle"},
    {"maximum_angle", "degrees", "Largest angle"},
    {"condition", "1", "Condition number of the map from an equilateral triangle to this triangle"},
}};

// Squared edge lengths of a triangle in ascending order, twice the area, and the scalar product of the two
// edges at the smallest and at the largest angle. Scaled, so that no number overflows or underflows.
struct ScaledTriangle {
  std::array<double, 3> squared;
  double twice_area, dot_at_smallest, dot_at_largest;
  bool finite;

  ScaledTriangle(const Vector3& a, const Vector3& b, const Vector3& c) {
    Vector3 ab = b - a, bc = c - b, ca = a - c;  // differences of corners, so that short edges are exact
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
  return degrees > 0 ? 1 / std::tan(degrees * std::numbers::pi / 180) : unbounded;
}

// Numbers to sort by, in the order of `measures`. A key grows with the metric and is cheaper to compute: the
// squared ratio for the edge ratio, the negative cotangent for an angle.
using Keys = std::array<double, 7>;

Keys keys_of(const ScaledTriangle& t) {
  if (!t.finite) return {unbounded, unbounded, unbounded, 0, -unbounded, unbounded, unbounded};
  const double edge_ratio = t.squared[0] > 0 ? t.squared[2] / t.squared[0] : unbounded;
  if (!t.has_area()) return {edge_ratio, unbounded, unbounded, 0, -unbounded, unbounded, unbounded};

  const auto& [a, b, c] = t.squared;
  const double shortest = std::sqrt(a), middle = std::sqrt(b), longest = std::sqrt(c), sum = a + b + c;
  const double perimeter = shortest + middle + longest;
  const double equilateral = 2 * std::numbers::sqrt3 * t.twice_area;  // 4√3 A
  const double per_area = 1 / t.twice_area, per_equilateral = 1 / equilateral;
  // √((a + b + c)² - 48 A²), written as a sum of squares: accurate also for nearly equilateral triangles.
  const double distortion = std::sqrt(2 * ((a - b) * (a - b) + (b - c) * (b - c) + (c - a) * (c - a)));
  return {edge_ratio,
          longest * perimeter * per_equilateral,
          0.25 * (shortest * per_area) * (middle * per_area) * longest * perimeter,
          equilateral / sum,
          -t.dot_at_smallest * per_area,
          -t.dot_at_largest * per_area,
          (sum + distortion) * per_equilateral};
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

// Finds the keys with given ranks without sorting all keys. A first pass counts the keys in buckets, by their
// leading bits. A second pass collects only the keys of the buckets that contain one of the ranks.
class RankFinder {
 public:
  /// The keys with these ranks. The smallest key has rank 0; ranks ascend and are below keys.size(). No key
  /// is NaN.
  template <std::size_t N>
  std::array<double, N> find(const std::vector<double>& keys, const std::array<std::size_t, N>& ranks) {
    std::fill(counts_.begin(), counts_.end(), 0);
    std::fill(wanted_.begin(), wanted_.end(), 0);
    bucket_of_.resize(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) ++counts_[bucket_of_[i] = bucket(keys[i])];

    std::array<std::size_t, N> rank_inside{};  // the rank among the collected keys
    std::size_t passed = 0, left_out = 0, at = 0;
    for (std::size_t n = 0; n < N; ++n) {
      for (; passed + counts_[at] <= ranks[n]; ++at) {
        passed += counts_[at];
        if (!wanted_[at]) left_out += counts_[at];
      }
      wanted_[at] = 1;
      rank_inside[n] = ranks[n] - left_out;
    }
    inside_.resize(keys.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {  // no branch here, because the CPU could not predict it
      inside_[count] = keys[i];
      count += wanted_[bucket_of_[i]];
    }
    std::array<double, N> values{};
    auto begin = inside_.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    for (std::size_t n = 0; n < N; ++n) {
      const auto nth = inside_.begin() + static_cast<std::ptrdiff_t>(rank_inside[n]);
      std::nth_element(begin, nth, end);
      values[n] = *nth;
      begin = nth;
    }
    return values;
  }

 private:
  static constexpr int bucket_bits = 13;  // 16 buckets an octave

  // The number of a key's bucket: sign, exponent and leading digits of the nearest float. The bits of
  // negative keys are inverted, so that the number grows with the key.
  static std::uint16_t bucket(double key) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(key));
    const std::uint32_t ascending = bits >> 31 ? ~bits : bits | 0x80000000u;
    return static_cast<std::uint16_t>(ascending >> (32 - bucket_bits));
  }

  std::array<std::uint32_t, std::size_t{1} << bucket_bits> counts_;
  std::array<std::uint8_t, std::size_t{1} << bucket_bits> wanted_;
  std::vector<std::uint16_t> bucket_of_;
  std::vector<double> inside_;
};

MeasureSummary summarise(std::size_t measure, const std::vector<double>& keys, RankFinder& finder) {
  const std::size_t last = keys.size() - 1;
  const auto low = static_cast<std::size_t>(std::llround(0.01 * static_cast<double>(last)));
  auto values = finder.find(keys, std::array<std::size_t, 5>{0, low, last / 2, last - low, last});
  for (double& value : values) value = measure_from_key(measure, value);
  return {values[0], values[1], values[2], values[3], values[4]};
}

}  // namespace

std::span<const QualityMeasure> quality_measures() {
  return measures;
}

MeshQuality measure_quality(const Positions& positions, const Triangles& triangles,
                            const QualityThresholds& thresholds) {
  MeshQuality quality;
  if (triangles.rows() == 0) return quality;

  // By rounding, the scaled area of collinear points is up to a few 10⁻¹⁶, less than this limit.
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
  RankFinder finder;
  for (std::size_t m = 0; m < keys.size(); ++m) quality.measures[m] = summarise(m, keys[m], finder);
  return quality;
}

}  // namespace bendlab
