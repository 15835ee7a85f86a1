#include "bendlab/mesh/single_precision.hpp"

#include <cmath>

namespace bendlab {

bool needs_double(const Positions& positions, const Triangles& triangles) {
  if (positions.rows() == 0 || triangles.rows() == 0) return false;
  double length = 0;  // of all sides; an inner edge counts twice
  for (const auto& corner : triangles.rowwise())
    for (int c = 0; c < 3; ++c)
      length += (positions.row(corner(c)) - positions.row(corner((c + 1) % 3))).norm();
  const double mean = length / static_cast<double>(triangles.size());
  return positions.cwiseAbs().maxCoeff() * 0x1p-24 > tolerated_rounding * mean;
}

Vector3 round_centre(const Positions& positions) {
  const Vector3 low = positions.colwise().minCoeff(), high = positions.colwise().maxCoeff();
  const double longest = (high - low).maxCoeff();
  if (!(longest > 0)) return Vector3::Zero();
  const int power = static_cast<int>(std::floor(std::log10(longest)));
  const double unit = std::pow(10, std::abs(power));  // exact for small powers, unlike its inverse
  const auto rounded = [&](double x) {
    return (power >= 0 ? std::round(x / unit) * unit : std::round(x * unit) / unit) + 0.0;  // no -0
  };
  return (0.5 * (low + high)).unaryExpr(rounded);
}

}  // namespace bendlab
