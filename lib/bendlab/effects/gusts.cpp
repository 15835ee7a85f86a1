#include "bendlab/effects/gusts.hpp"
#include "bendlab/settings/random_numbers.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace bendlab {
namespace {

// The n-th number of a seed's sequence, uniform in [-1, 1).
double noise(std::uint64_t seed, std::uint64_t n) {
  return 2 * unit_interval(split_mix(seed, n)) - 1;
}

}  // namespace

Vector3 Gusts::at(double seconds) const {
  const double cell = std::floor(seconds / time), x = seconds / time - cell, s = x * x * (3 - 2 * x);
  // For a vertex that flew far away, `seconds` may be so large that `cell` is no 64-bit integer.
  if (!(std::abs(cell) < 0x1p62)) return Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  const auto first = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell)) * 3;
  // The variance of a uniform value is 1/3. The variance of (1 - s) a + s b, averaged over x, is 26/35 · 1/3.
  const double scale = deviation * std::numbers::sqrt3 * std::sqrt(35.0 / 26.0);
  Vector3 gust;
  for (std::uint64_t axis = 0; axis < 3; ++axis)
    gust(static_cast<Eigen::Index>(axis)) =
        scale * ((1 - s) * noise(seed, first + axis) + s * noise(seed, first + 3 + axis));
  return gust;
}

}  // namespace bendlab
