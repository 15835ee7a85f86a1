#include "bendlab/metrics/stretch.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "bendlab/mesh/bad_triangles.hpp"

namespace bendlab {
namespace {

constexpr double pin_region = 0.1;  // in mesh sizes: radius of the region around a pin

PrincipalStretches principal_stretches(const Vector3& f1, const Vector3& f2) {
  // σ₁² is the larger eigenvalue of FᵀF. σ₂ follows from σ₁ σ₂ = |f1 × f2|, accurately even if σ₂ is small.
  const double s11 = f1.squaredNorm(), s22 = f2.squaredNorm(), s12 = f1.dot(f2);
  const double difference = s11 - s22;
  const double largest = std::sqrt(0.5 * (s11 + s22 + std::sqrt(difference * difference + 4 * s12 * s12)));
  return {largest, largest > 0 ? f1.cross(f2).norm() / largest : largest};
}

double largest_of(std::span<const PrincipalStretches> stretches, const std::vector<char>& counted) {
  double largest = -1;
  for (std::size_t t = 0; t < stretches.size(); ++t)
    if (counted[t] && !(stretches[t].largest <= largest)) largest = stretches[t].largest;
  return largest < 0 ? std::numeric_limits<double>::quiet_NaN() : largest;
}

}  // namespace

StretchMeter::StretchMeter(const RestMesh& rest, const Pins& pins)
    : triangles_(rest.triangles()),
      inverse_rest_(inverse_rest_from_warp(rest.mesh(), Vector3::UnitX())),
      degenerate_(triangles_without_area(rest.mesh())) {
  for (int t = 0; t < rest.triangle_count(); ++t) {
    const auto corner = triangles_.row(t);
    at_pin_.push_back(pins.pinned(corner(0)) || pins.pinned(corner(1)) || pins.pinned(corner(2)));
    const Vector3 centroid =
        (rest.position(corner(0)) + rest.position(corner(1)) + rest.position(corner(2))) / 3;
    near_pin_.push_back(std::any_of(pins.seeds.begin(), pins.seeds.end(), [&](int seed) {
      return (rest.position(seed) - centroid).norm() <= pin_region * rest.size();
    }));
  }
}

std::vector<PrincipalStretches> StretchMeter::measure(const Positions& positions) const {
  std::vector<PrincipalStretches> stretches;
  stretches.reserve(inverse_rest_.size());
  for (std::size_t t = 0; t < inverse_rest_.size(); ++t) {
    if (degenerate_[t] != 0) {
      stretches.emplace_back();
      continue;
    }
    const auto corner = triangles_.row(static_cast<Eigen::Index>(t));
    const Vector3 p0 = positions.row(corner(0)).transpose();
    const Vector3 e1 = positions.row(corner(1)).transpose() - p0,
                  e2 = positions.row(corner(2)).transpose() - p0;
    const InverseRest& q = inverse_rest_[t];
    stretches.push_back(principal_stretches(e1 * q[0] + e2 * q[2], e1 * q[1] + e2 * q[3]));
  }
  return stretches;
}

StretchSummary StretchMeter::summarise(std::span<const PrincipalStretches> stretches) const {
  StretchSummary summary;
  for (const PrincipalStretches& s : stretches)
    summary.mean_strain += std::max(std::abs(s.largest - 1), std::abs(s.smallest - 1));
  summary.mean_strain /= static_cast<double>(stretches.size());
  summary.max_stretch = largest_of(stretches, std::vector<char>(stretches.size(), 1));
  summary.pin_max_stretch = largest_of(stretches, at_pin_);
  summary.pin_region_stretch = largest_of(stretches, near_pin_);
  return summary;
}

}  // namespace bendlab
