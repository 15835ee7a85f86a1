#include "bendlab/effects/gusts.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace bendlab {
namespace {

// The n-th number of the SplitMix64 generator (Steele, Lea and Flood 2014) of that seed, uniform in [-1, 1).
double uniform(std::uint64_t seed, std::uint64_t n) {
  std::uint64_t z = seed + (n + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return 2 * (static_cast<double>(z >> 11) * 0x1p-53) - 1;
}

}  // namespace

Vector3 Gusts::at(double seconds) const {
  const double cell = std::floor(seconds / time), x = seconds / time - cell, s = x * x * (3 - 2 * x);
  // Of a vertex that flew apart; no integer has its cell.
  if (!(std::abs(cell) < 0x1p62)) return Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
  const auto first = static_cast<std::uint64_t>(static_cast<std::int64_t>(cell)) * 3;
  // The variance of a uniform value is 1/3; that of (1 - s) a + s b, averaged over x, is 26/35 of it.
  const double scale = deviation * std::numbers::sqrt3 * std::sqrt(35.0 / 26.0);
  Vector3 gust;
  for (std::uint64_t axis = 0; axis < 3; ++axis)
    gust(static_cast<Eigen::Index>(axis)) =
        scale * ((1 - s) * uniform(seed, first + axis) + s * uniform(seed, first + 3 + axis));
  return gust;
}

}  // namespace bendlab
